#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/component/eigen/factor.h"
#include "framework/common/lapack.h"

namespace pintle {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double plus_one = 1, minus_one = -1;
constexpr double singular = 1e-14;  // a pivot smaller than this relative to its original entries is rounding
constexpr int strip = 128;          // columns updated at once where the pivot block is indefinite

// Lower triangle of A in elimination order, by columns.
struct Ordered {
  std::vector<int> begin, row;
  std::vector<double> value;

  Ordered(const Sparse& A, const Supernodes& s) : begin(static_cast<std::size_t>(s.n) + 1), row(), value() {
    std::vector<int> at(static_cast<std::size_t>(s.n));
    for (int k = 0; k < s.n; ++k) at[static_cast<std::size_t>(s.order[k])] = k;
    const auto for_lower = [&](auto f) {
      for (int j = 0; j < s.n; ++j)
        for (Sparse::InnerIterator a(A, j); a; ++a) {
          const int i = static_cast<int>(a.row());
          if (i < j) continue;
          const int p = at[static_cast<std::size_t>(i)], q = at[static_cast<std::size_t>(j)];
          f(std::max(p, q), static_cast<std::size_t>(std::min(p, q)), a.value());
        }
    };
    for_lower([&](int, std::size_t c, double) { ++begin[c + 1]; });
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    row.resize(static_cast<std::size_t>(begin.back()));
    value.resize(row.size());
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for_lower([&](int r, std::size_t c, double x) {
      const std::size_t k = static_cast<std::size_t>(next[c]++);
      row[k] = r;
      value[k] = x;
    });
  }
};

// A dense matrix with `rows` rows, of which the first `columns` are to be eliminated; lower triangle.
class Front {
 public:
  // Leaves the Schur complement in the trailing block. @returns negative pivots
  int eliminate(double* F, int rows, int columns) {
    const int rest = rows - columns;
    kept_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(columns));
    for (int j = 0; j < columns; ++j) std::copy_n(F + at(j, j, rows), columns - j, kept_.data() + at(j, j, columns));
    int info = 0;
    dpotrf_("L", &columns, F, &rows, &info);
    bool definite = info == 0;
    for (int j = 0; definite && j < columns; ++j) {
      const double l = F[at(j, j, rows)];
      definite = l * l > 1e-8 * kept_[at(j, j, columns)];
    }
    if (!definite) return eliminate_indefinite(F, rows, columns);
    if (rest > 0) {
      dtrsm_("R", "L", "T", "N", &rest, &columns, &plus_one, F, &rows, F + columns, &rows);
      dsyrk_("L", "N", &rest, &columns, &minus_one, F + columns, &rows, &plus_one, F + at(columns, columns, rows), &rows);
    }
    return 0;
  }

 private:
  static std::size_t at(int i, int j, int rows) {
    return static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * static_cast<std::size_t>(rows);
  }

  // P = kept_ by Bunch and Kaufman; C − B P⁻¹ Bᵀ strip by strip.
  int eliminate_indefinite(double* F, int rows, int columns) {
    const int rest = rows - columns;
    const double largest = largest_entry(columns);
    pivots_.resize(static_cast<std::size_t>(columns));
    work_.resize(64 * static_cast<std::size_t>(columns));
    const int lwork = static_cast<int>(work_.size());
    int info = 0;
    dsytrf_("L", &columns, kept_.data(), &columns, pivots_.data(), work_.data(), &lwork, &info);
    const int negative = info == 0 ? count_negative(columns, largest) : -1;
    if (negative < 0) throw std::runtime_error("a supernode is singular to rounding: the matrix has an eigenvalue at zero");
    for (int first = 0; first < rest; first += strip) {
      const int width = std::min(strip, rest - first), below = rest - first;
      turned_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(width));
      for (int j = 0; j < width; ++j)
        for (int i = 0; i < columns; ++i) turned_[at(i, j, columns)] = F[at(columns + first + j, i, rows)];
      dsytrs_("L", &columns, &width, kept_.data(), &columns, pivots_.data(), turned_.data(), &columns, &info);
      dgemm_("N", "N", &below, &width, &columns, &minus_one, F + columns + first, &rows, turned_.data(), &columns, &plus_one,
             F + at(columns + first, columns + first, rows), &rows);
    }
    return negative;
  }

  double largest_entry(int columns) const {
    double largest = 0;
    for (int j = 0; j < columns; ++j)
      for (int i = j; i < columns; ++i) largest = std::max(largest, std::abs(kept_[at(i, j, columns)]));
    return largest;
  }

  // Negative signs of D's blocks of one and two; −1 where a block is singular to rounding.
  int count_negative(int columns, double largest) const {
    int negative = 0;
    for (int j = 0; j < columns; ++j) {
      const double a = kept_[at(j, j, columns)];
      if (pivots_[static_cast<std::size_t>(j)] > 0) {
        if (!(std::abs(a) > singular * largest)) return -1;
        negative += a < 0;
        continue;
      }
      const double b = kept_[at(j + 1, j, columns)], c = kept_[at(j + 1, j + 1, columns)];
      const double determinant = a * c - b * b;
      if (!(std::abs(determinant) > singular * largest * (std::abs(a) + std::abs(b) + std::abs(c)))) return -1;
      negative += determinant < 0 ? 1 : (a < 0 ? 2 : 0);
      ++j;
    }
    return negative;
  }

  std::vector<double> kept_, work_, turned_;
  std::vector<int> pivots_;
};

// The fronts of one matrix, children before parents, and a stack of the Schur complements that wait for their parents.
class Elimination {
 public:
  Elimination(const Sparse& A, const Supernodes& super) : super_(super), lower_(A, super), place_(static_cast<std::size_t>(super.n), -1) {
    int tallest = 0;
    for (int s = 0; s < super.count; ++s) tallest = std::max(tallest, rows(s));
    F_.resize(static_cast<std::size_t>(tallest) * static_cast<std::size_t>(tallest));
  }

  // @returns negative pivots of supernode s
  int eliminate(int s) {
    open(s);
    while (!waiting_.empty() && first_below(waiting_.back()) < super_.first[s + 1]) add_child(s);
    const int negative = front_.eliminate(F_.data(), rows(s), columns(s));
    if (rows(s) > columns(s)) keep(s);
    return negative;
  }

 private:
  int rows(int s) const { return super_.row_begin[s + 1] - super_.row_begin[s]; }
  int columns(int s) const { return super_.first[s + 1] - super_.first[s]; }
  std::size_t below(int s) const { return static_cast<std::size_t>(rows(s) - columns(s)); }
  int first_below(int s) const { return super_.row[super_.row_begin[s] + columns(s)]; }
  double* column(int j, int height) { return F_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(height); }
  int place(int row) const { return place_[static_cast<std::size_t>(row)]; }

  // The front of s: zero except the entries of A in its columns.
  void open(int s) {
    const int height = rows(s);
    const int* row = super_.row + super_.row_begin[s];
    for (int i = 0; i < height; ++i) place_[static_cast<std::size_t>(row[i])] = i;
    for (int j = 0; j < height; ++j) std::fill(column(j, height) + j, column(j + 1, height), 0.0);
    for (int j = 0; j < columns(s); ++j) {
      const std::size_t c = static_cast<std::size_t>(row[j]);
      for (int k = lower_.begin[c]; k < lower_.begin[c + 1]; ++k)
        column(j, height)[place(lower_.row[static_cast<std::size_t>(k)])] += lower_.value[static_cast<std::size_t>(k)];
    }
  }

  // Adds the top of the stack to the front of s.
  void add_child(int s) {
    const int child = waiting_.back(), height = rows(s);
    const int* row = super_.row + super_.row_begin[child] + columns(child);
    const std::size_t size = below(child);
    const double* C = stack_.data() + stack_.size() - size * size;
    for (std::size_t j = 0; j < size; ++j, C += size) {
      assert(super_.row[super_.row_begin[s] + place(row[j])] == row[j]);
      double* into = column(place(row[j]), height);
      for (std::size_t i = j; i < size; ++i) into[place(row[i])] += C[i];
    }
    stack_.resize(stack_.size() - size * size);
    waiting_.pop_back();
  }

  void keep(int s) {
    const std::size_t size = below(s), top = stack_.size();
    stack_.resize(top + size * size);
    for (std::size_t j = 0; j < size; ++j) {
      const int at = columns(s) + static_cast<int>(j);
      std::copy_n(column(at, rows(s)) + at, size - j, stack_.data() + top + j * (size + 1));
    }
    waiting_.push_back(s);
  }

  const Supernodes& super_;
  Ordered lower_;
  std::vector<int> place_;  // of each row of the matrix in the present front
  std::vector<double> F_;   // the present front
  std::vector<double> stack_;
  std::vector<int> waiting_;  // supernodes on the stack
  Front front_;
};

}  // namespace

int negative_eigenvalues(const Sparse& A) {
  Factor order;
  order.analyse(A);
  return negative_eigenvalues(A, order.supernodes());
}

int negative_eigenvalues(const Sparse& A, const Supernodes& super) {
  Elimination elimination(A, super);
  int negative = 0;
  for (int s = 0; s < super.count; ++s) negative += elimination.eliminate(s);
  return negative;
}

}  // namespace pintle
