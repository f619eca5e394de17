#include "framework/component/fe/assembly.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace pintle {

namespace {

// Elements of all blocks as one list, and the elements at each node.
struct Incidence {
  std::vector<int> begin{0}, node;  // element e has node[begin[e] … begin[e + 1])
  std::vector<int> at_begin, at;    // node i is in at[at_begin[i] … at_begin[i + 1])
};

Incidence incidence(const FeModel& model) {
  Incidence all;
  for (const AnyBlock& any : model.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          for (int i = 0; i < block.size(); ++i) all.begin.push_back(all.begin.back() + E::nodes);
          all.node.insert(all.node.end(), block.nodes.begin(), block.nodes.end());
        },
        any);
  all.at_begin.assign(static_cast<std::size_t>(model.x.cols()) + 1, 0);
  for (const int node : all.node) ++all.at_begin[static_cast<std::size_t>(node) + 1];
  for (std::size_t i = 1; i < all.at_begin.size(); ++i) all.at_begin[i] += all.at_begin[i - 1];
  all.at.resize(all.node.size());
  std::vector<int> next(all.at_begin.begin(), all.at_begin.end() - 1);
  for (std::size_t e = 0; e + 1 < all.begin.size(); ++e)
    for (int k = all.begin[e]; k < all.begin[e + 1]; ++k) {
      const auto node = static_cast<std::size_t>(all.node[static_cast<std::size_t>(k)]);
      all.at[static_cast<std::size_t>(next[node]++)] = static_cast<int>(e);
    }
  return all;
}

// Adds an element's matrix. In each column of a node, the rows of another node begin at the same offset.
template <class E>
void add(Sparse& A, const std::vector<int>& begin, const int* node, const Square<E>& a) {
  constexpr int d = E::dofs_per_node;
  const int* outer = A.outerIndexPtr();
  const int* inner = A.innerIndexPtr();
  double* value = A.valuePtr();
  for (int c = 0; c < E::nodes; ++c) {
    const int column = begin[static_cast<std::size_t>(node[c])];
    const int* first = inner + outer[column];
    const int* last = inner + outer[column + 1];
    for (int r = 0; r < E::nodes; ++r) {
      const int row = begin[static_cast<std::size_t>(node[r])];
      const auto deep = std::lower_bound(first, last, row) - first;
      for (int j = 0; j < d; ++j) {
        double* to = value + outer[column + j] + deep;
        for (int i = 0; i < d; ++i) to[i] += a(r * d + i, c * d + j);
      }
    }
  }
}

// Sums `of(element, coords, number in its block, nodes)` over all elements.
template <class Of>
void sum(const FeModel& model, Sparse& A, const Of& of) {
  for (const AnyBlock& any : model.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          for (int i = 0; i < block.size(); ++i) {
            const int* node = block.nodes_of(i);
            add<E>(A, model.begin, node, of(block.element(i), block.coords(i, model.x), node));
          }
        },
        any);
}

void add_lumps(const FeModel& model, Sparse& A, Eigen::Matrix3d (*of)(const PointMass&)) {
  for (const Lump& lump : model.lumps) {
    const Eigen::Matrix3d a = of(lump.mass);
    const int at = model.begin[static_cast<std::size_t>(lump.node)];
    const int size = model.begin[static_cast<std::size_t>(lump.node) + 1] - at;
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i)
        if (a(i, j) != 0) A.coeffRef(at + i, at + j) += a(i, j);
  }
}

// B plus, in its leading rows and columns, the rows and columns of A in `keep`.
Sparse restricted_plus(const Sparse& A, const std::vector<int>& keep, const Sparse& B) {
  std::vector<int> place(static_cast<std::size_t>(A.rows()), -1);
  for (std::size_t k = 0; k < keep.size(); ++k) place[static_cast<std::size_t>(keep[k])] = static_cast<int>(k);
  Eigen::Index entries = B.nonZeros();
  for (const int j : keep)
    for (Sparse::InnerIterator a(A, j); a; ++a) entries += place[static_cast<std::size_t>(a.row())] >= 0;
  Sparse sum(B.rows(), B.cols());
  sum.reserve(entries);
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    sum.startVec(j);
    Sparse::InnerIterator b(B, j);
    const auto add_until = [&](Eigen::Index row) {
      for (; b && b.row() < row; ++b) sum.insertBackByOuterInner(j, b.row()) = b.value();
    };
    if (j < static_cast<Eigen::Index>(keep.size()))
      for (Sparse::InnerIterator a(A, keep[static_cast<std::size_t>(j)]); a; ++a) {
        const int i = place[static_cast<std::size_t>(a.row())];
        if (i < 0) continue;
        add_until(i);
        double& value = sum.insertBackByOuterInner(j, i);
        value = a.value();
        if (b && b.row() == i) {
          value += b.value();
          ++b;
        }
      }
    add_until(B.rows());
  }
  sum.finalize();
  return sum;
}

}  // namespace

Assembler::Assembler(const FeModel& model) : model_(model) {
  const Incidence all = incidence(model);
  const auto count = static_cast<std::size_t>(model.x.cols());
  std::vector<int> seen(count, -1);
  neighbour_begin_.reserve(count + 1);
  neighbour_begin_.push_back(0);
  long entries = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::ptrdiff_t>(neighbour_.size());
    for (int k = all.at_begin[i]; k < all.at_begin[i + 1]; ++k) {
      const auto e = static_cast<std::size_t>(all.at[static_cast<std::size_t>(k)]);
      for (int m = all.begin[e]; m < all.begin[e + 1]; ++m) {
        const int node = all.node[static_cast<std::size_t>(m)];
        if (seen[static_cast<std::size_t>(node)] == static_cast<int>(i)) continue;
        seen[static_cast<std::size_t>(node)] = static_cast<int>(i);
        neighbour_.push_back(node);
      }
    }
    std::sort(neighbour_.begin() + first, neighbour_.end());
    neighbour_begin_.push_back(static_cast<int>(neighbour_.size()));
    entries += 9L * (neighbour_begin_[i + 1] - neighbour_begin_[i]);
  }
  if (entries > std::numeric_limits<int>::max())
    throw std::invalid_argument("a body of " + std::to_string(model.N()) +
                                " degrees of freedom: its matrices have more than 2^31 entries; coarsen the mesh");
}

Sparse Assembler::zeros() const {
  const int N = model_.N();
  Sparse A(N, N);
  int* outer = A.outerIndexPtr();
  for (std::size_t node = 0; node + 1 < model_.begin.size(); ++node) {
    int rows = 0;
    for (int k = neighbour_begin_[node]; k < neighbour_begin_[node + 1]; ++k) {
      const auto other = static_cast<std::size_t>(neighbour_[static_cast<std::size_t>(k)]);
      rows += model_.begin[other + 1] - model_.begin[other];
    }
    for (int i = model_.begin[node]; i < model_.begin[node + 1]; ++i) outer[i + 1] = outer[i] + rows;
  }
  A.resizeNonZeros(outer[N]);
  int* inner = A.innerIndexPtr();
  for (std::size_t node = 0; node + 1 < model_.begin.size(); ++node)
    for (int i = model_.begin[node]; i < model_.begin[node + 1]; ++i)
      for (int k = neighbour_begin_[node]; k < neighbour_begin_[node + 1]; ++k) {
        const auto other = static_cast<std::size_t>(neighbour_[static_cast<std::size_t>(k)]);
        for (int row = model_.begin[other]; row < model_.begin[other + 1]; ++row) *inner++ = row;
      }
  std::fill_n(A.valuePtr(), A.nonZeros(), 0.0);
  return A;
}

Sparse Assembler::stiffness() const {
  Sparse K = zeros();
  sum(model_, K, [](const auto& e, const auto& x, const int*) { return pintle::stiffness(e, x); });
  return K;
}

Sparse Assembler::mass(MassKind kind) const {
  if (kind == MassKind::consistent) {
    Sparse M = zeros();
    sum(model_, M, [](const auto& e, const auto& x, const int*) { return pintle::mass(e, x); });
    add_lumps(model_, M, pintle::mass);
    return M;
  }
  Sparse M(model_.N(), model_.N());
  M.setIdentity();
  Eigen::Map<Eigen::VectorXd> diagonal(M.valuePtr(), M.nonZeros());
  diagonal.setZero();
  for (const AnyBlock& any : model_.blocks)
    std::visit(
        [&]<class E>(const Block<E>& block) {
          for (int i = 0; i < block.size(); ++i) {
            const NodalVector<E> m = lumped_mass(block.element(i), block.coords(i, model_.x));
            for (int k = 0; k < E::nodes; ++k) {
              const int node = block.nodes_of(i)[k];
              diagonal.segment<E::dofs_per_node>(model_.begin[static_cast<std::size_t>(node)]) +=
                  m.template segment<E::dofs_per_node>(k * E::dofs_per_node);
            }
          }
        },
        any);
  add_lumps(model_, M, pintle::mass);
  return M;
}

Sparse Assembler::skew_mass() const {
  Sparse G = zeros();
  sum(model_, G, [](const auto& e, const auto& x, const int*) { return pintle::skew_mass(e, x); });
  add_lumps(model_, G, pintle::skew_mass);
  return G;
}

Sparse Assembler::geometric_stiffness(const Eigen::VectorXd& u) const {
  Sparse K = zeros();
  sum(model_, K, [&]<class E>(const E& e, const Coords<E>& x, const int* node) {
    return pintle::geometric_stiffness(e, x, stress(e, x, gathered<E>(model_, node, u)));
  });
  return K;
}

Sparse restricted(const Sparse& A, const std::vector<int>& keep) {
  const auto n = static_cast<Eigen::Index>(keep.size());
  return restricted_plus(A, keep, Sparse(n, n));
}

// L = P + Q: the uncoupled part and the couplings. Q has few rows, so everything except PᵀAP is small: LᵀAL = PᵀAP + PᵀAQ + (QᵀA)L, where
// QᵀA needs only few rows of A.
Sparse independent(const FeModel& model, Sparse A) {  // NOLINT(performance-unnecessary-value-param): it may be the result
  if (model.L.size() == 0) return A;
  std::vector<int> stays;
  for (int i = 0; i < model.N(); ++i)
    if (model.independent_of(i) >= 0) stays.push_back(i);
  using Triplets = std::vector<Eigen::Triplet<double>>;
  const auto made_of = [&](int columns, const Triplets& t) {
    Sparse S(model.N(), columns);
    S.setFromTriplets(t.begin(), t.end());
    return S;
  };
  const auto given = [&](Eigen::Index i) { return model.independent_of(static_cast<int>(i)) < 0; };
  Triplets p, q, a_rows;
  for (Eigen::Index j = 0; j < model.L.outerSize(); ++j)
    for (Sparse::InnerIterator l(model.L, j); l; ++l) (given(l.row()) ? q : p).emplace_back(l.row(), j, l.value());
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (Sparse::InnerIterator a(A, j); a; ++a)
      if (given(a.row())) a_rows.emplace_back(a.row(), j, a.value());
  const Sparse Q = made_of(model.n(), q), Qt = Q.transpose(), AQ = A * Q;
  const Sparse Pt = made_of(model.n(), p).transpose();
  const Sparse QtA = Qt * made_of(model.N(), a_rows);
  const Sparse small = Sparse(Pt * AQ) + Sparse(QtA * model.L);
  return restricted_plus(A, stays, small);
}

}  // namespace pintle
