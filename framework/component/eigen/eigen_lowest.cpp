#include "framework/component/eigen/eigen_lowest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/common/stop_point.h"
#include "framework/common/work_done.h"
#include "framework/component/eigen/factor.h"
#include "framework/component/eigen/pencil.h"
#include "framework/component/eigen/starting_loads.h"
#include "framework/component/eigen/subspace.h"
#include "framework/component/eigen/tall_products.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr Index small = 400;          // up to this size solved densely
constexpr Index dense_limit = 4000;   // up to this size solved densely if a quarter of all pairs is requested
constexpr double share = 1e-10;       // shift relative to ΣK_ii/ΣM_ii
constexpr double dense_share = 1e-6;  // the same if all pairs are computed
constexpr double cluster = 1e-6;      // relative gap; in smaller gaps no count is attempted

void validate(const Sparse& K, const Sparse& M, const EigenOptions& o) {
  if (K.rows() != K.cols() || M.rows() != M.cols() || K.rows() != M.rows()) {
    std::ostringstream text;
    text << "K is " << K.rows() << " by " << K.cols() << " and M " << M.rows() << " by " << M.cols()
         << ", but both must be square and of the same size";
    throw std::invalid_argument(text.str());
  }
  if (o.count < 1) throw std::invalid_argument(std::to_string(o.count) + " modes asked for, must be at least 1");
  if (!(o.shift <= 0))
    throw std::invalid_argument("shift = " + std::to_string(o.shift) + ", must be negative, or 0 to let the solver choose");
  if (!(o.tolerance > 0)) throw std::invalid_argument("tolerance = " + std::to_string(o.tolerance) + ", must be positive");
  const Index massive = (M.diagonal().array() > 0).count();
  if (o.count > massive) throw std::invalid_argument(too_many(o.count, massive));
}

// State of the search: the iterated vectors, and the number of pairs needed for a conclusive check.
struct Search {
  const Sparse &K, &M;
  const EigenOptions& options;
  double mu;
  Factor factor;
  Index block, wanted;
};

// Factors K − μM, with a larger shift if the smaller is lost in rounding.
void factor_shifted(Search& s) {
  const int attempts = s.options.shift < 0 ? 1 : 3;
  for (int i = 0; i < attempts; ++i) {
    if (s.factor.compute(shifted(s.K, s.M, s.mu))) return;
    if (i + 1 < attempts) s.mu *= 100;
  }
  throw std::runtime_error(not_definite(s.mu) + " (at degree of freedom " + std::to_string(s.factor.pivot()) + ")");
}

VectorXd residuals(const Subspace& space, const Search& s, Index count) {
  VectorXd r(count);
  for (Index j = 0; j < count; ++j) {
    const double sigma = 1 / space.theta()[j];
    r[j] = space.defect()[j] * sigma / std::max(std::abs(sigma + s.mu), -s.mu);
  }
  return r;
}

// Where to count, relative to μ: in the gap above the last wanted pair; 0 if there is no gap.
double place_of_check(const Subspace& space, const Search& s) {
  const double last = 1 / space.theta()[s.wanted - 1];
  const double next =
      space.old() > s.wanted && space.theta()[s.wanted] > 0 ? 1 / space.theta()[s.wanted] : std::numeric_limits<double>::infinity();
  const double offset = std::min(0.5 * (next - last), std::max(1e-3 * last, -0.3 * s.mu));
  return offset > cluster * last ? last + offset : 0;
}

// Number of eigenvalues below μ + `at`, which is lowered slightly if it is an eigenvalue of a part of the body.
int count_below(const Search& s, double at) {
  for (int i = 0;; ++i) {
    try {
      return negative_eigenvalues(shifted(s.K, s.M, s.mu + at), s.factor.supernodes());
    } catch (const std::runtime_error&) {
      if (i == 3) throw;
      at -= 1e-5 * at;
    }
  }
}

// @returns true  the iteration is over
bool check(const Subspace& space, Search& s, EigenPairs& out) {
  const double at = place_of_check(space, s);
  if (at == 0) {
    ++s.wanted;
    return false;
  }
  const int below = count_below(s, at);
  out.checked = true;
  out.missed = below - static_cast<int>(s.wanted);
  out.converged = out.missed == 0;
  if (out.missed >= 0) {
    s.wanted = below;
    return out.missed == 0;
  }
  out.reason = "the Sturm check counts " + std::to_string(below) + " eigenvalues where " + std::to_string(s.wanted) +
               " were found: K or M is not symmetric or not semidefinite";
  return true;
}

// Number of columns of Q; `width`: of the current block.
Index capacity_for(const Search& s, Index width) {
  return std::min(s.K.rows(), std::max(2 * s.wanted, s.wanted + 8 * std::max(s.block, width)));
}

// Adds random vectors when the subspace has become invariant under A⁻¹M, so that iteration gives nothing new.
void feed(Subspace& space, const Search& s, int iteration) {
  space.add_loads(random_loads(s.M, static_cast<int>(s.block), s.options.seed + static_cast<unsigned>(iteration)));
  if (space.width() == 0 && space.old() < s.options.count) throw std::invalid_argument(too_many(s.options.count, space.old()));
}

void iterate(Subspace& space, Search& s, EigenPairs& out) {
  space.add_loads(starting_loads(s.K, s.M, static_cast<int>(s.block), s.options.seed));
  double worst = 0;
  Index good = 0;
  while (out.iterations < s.options.max_iterations) {
    stop_point();
    ++out.iterations;
    space.reserve(capacity_for(s, space.width()));
    if (!space.room()) space.restart(std::min(space.old(), s.wanted + (space.capacity() - s.wanted) / 4));
    if (space.width() == 0) feed(space, s, out.iterations);
    space.step();
    space.project();
    if (space.old() < s.wanted) continue;
    const VectorXd r = residuals(space, s, s.wanted);
    good = (r.array() <= s.options.tolerance).count();
    worst = r.maxCoeff();
    work_done = static_cast<double>(good) / static_cast<double>(s.wanted);
    if (good < s.wanted) continue;
    if (!s.options.check) {
      out.converged = true;
      return;
    }
    if (check(space, s, out)) return;
    if (out.missed > 0) feed(space, s, out.iterations);
  }
  std::ostringstream text;
  text << good << " of " << s.wanted << " pairs were found in " << out.iterations << " iterations, the largest residual is " << worst;
  if (out.missed > 0) text << ", and " << out.missed << " more exist according to the Sturm check";
  out.reason = text.str();
}

// A plain iteration on the p vectors, which removes accumulated rounding from the shapes.
void last_iteration(const Subspace& space, const Search& s, EigenPairs& out) {
  const Index p = std::min<Index>(s.options.count, space.old());
  MatrixXd Z;
  s.factor.solve_into(product(s.M, space.iterated(p)), Z);
  out.solves = space.solves() + p;
  Z *= space.theta().head(p).cwiseInverse().asDiagonal();
  refine(s.K, s.M, std::move(Z), static_cast<int>(p), out);
}

}  // namespace

EigenPairs eigen_lowest(const Sparse& K, const Sparse& M, const EigenOptions& options) {
  validate(K, M, options);
  const Index n = K.rows(), p = options.count;
  const double scale = stiffness_over_mass(K, M);
  if (n <= small || (4 * p > n && n <= dense_limit) || 2 * p > n)
    return eigen_dense(K, M, options.count, options.shift < 0 ? options.shift : -dense_share * scale);

  const Sparse mass = M.pruned(1.0, 0.0);  // assembled with K's pattern, half of its entries are zero
  Search s{K, mass, options, options.shift < 0 ? options.shift : -share * scale, {}, 0, p};
  s.block = std::clamp<Index>(2 + p / 3, 4, 16);
  factor_shifted(s);
  Subspace space(s.factor, mass, capacity_for(s, s.block));
  EigenPairs out;
  iterate(space, s, out);
  last_iteration(space, s, out);
  return out;
}

EigenPairs eigen_below(const Sparse& K, const Sparse& M, double limit, const EigenOptions& options) {
  EigenOptions o = options;
  o.count = 1;
  validate(K, M, o);
  o.count = negative_eigenvalues(shifted(K, M, limit));
  EigenPairs out;
  if (o.count == 0) {
    out.shapes.resize(K.rows(), 0);
    out.converged = out.checked = true;
    return out;
  }
  out = eigen_lowest(K, M, o);
  const int found = static_cast<int>((out.lambda.array() < limit).count());
  if (found < o.count) {
    out.missed = std::max(out.missed, o.count - found);
    out.converged = false;
    out.reason = std::to_string(o.count) + " eigenvalues lie below the limit, " + std::to_string(found) + " were found there";
  }
  return out;
}

}  // namespace pintle
