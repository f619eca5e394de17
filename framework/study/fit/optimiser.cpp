#include "framework/study/fit/optimiser.h"

#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>

namespace pintle {

namespace {

struct OptimiserFacts {
  Optimiser method;
  const char* name;
  nlopt_algorithm algorithm;
  bool everywhere, constraints;
};
constexpr std::array optimisers{OptimiserFacts{Optimiser::bobyqa, "bobyqa", NLOPT_LN_BOBYQA, false, false},
                                OptimiserFacts{Optimiser::cobyla, "cobyla", NLOPT_LN_COBYLA, false, true},
                                OptimiserFacts{Optimiser::nelder_mead, "nelder-mead", NLOPT_LN_NELDERMEAD, false, false},
                                OptimiserFacts{Optimiser::sbplx, "sbplx", NLOPT_LN_SBPLX, false, false},
                                OptimiserFacts{Optimiser::slsqp, "slsqp", NLOPT_LD_SLSQP, false, true},
                                OptimiserFacts{Optimiser::mma, "mma", NLOPT_LD_MMA, false, true},
                                OptimiserFacts{Optimiser::direct, "direct", NLOPT_GN_DIRECT_L, true, false},
                                OptimiserFacts{Optimiser::crs, "crs", NLOPT_GN_CRS2_LM, true, false},
                                OptimiserFacts{Optimiser::isres, "isres", NLOPT_GN_ISRES, true, true}};

const OptimiserFacts& facts(Optimiser m) { return *std::ranges::find(optimisers, m, &OptimiserFacts::method); }

/// A search as seen by NLopt: values and constraints, requested one by one, at the last evaluated point.
class Searching {
 public:
  Searching(const SearchSettings& settings, const WorthAt& worth)
      : settings_(settings), worth_(worth), opt_(nlopt_create(facts(settings.method).algorithm, n()), nlopt_destroy) {
    if (!opt_) throw std::bad_alloc();
    nlopt_set_lower_bounds1(opt_.get(), 0);
    nlopt_set_upper_bounds1(opt_.get(), 1);
    nlopt_set_xtol_abs1(opt_.get(), settings.precision);
    nlopt_set_initial_step1(opt_.get(), settings.first_step);
    nlopt_set_min_objective(opt_.get(), value, this);
    const std::vector<double> tolerances(settings.constraints, met_within);
    if (settings.constraints > 0)
      nlopt_add_inequality_mconstraint(opt_.get(), static_cast<unsigned>(settings.constraints), excesses, this, tolerances.data());
    nlopt_srand(static_cast<unsigned long>(settings.seed));
  }

  std::string go() {
    BoxPoint x = settings_.start;
    double least = 0;
    const nlopt_result end = nlopt_optimize(opt_.get(), x.data(), &least);
    if (trouble_) std::rethrow_exception(trouble_);
    switch (end) {
      case NLOPT_FORCED_STOP: return good_ ? "good enough" : "out of evaluations";
      case NLOPT_ROUNDOFF_LIMITED: return "limited by rounding";
      case NLOPT_OUT_OF_MEMORY: throw std::bad_alloc();
      default: return end > 0 ? "converged" : "could not continue";
    }
  }

 private:
  unsigned n() const { return static_cast<unsigned>(settings_.start.size()); }

  static double value(unsigned, const double* x, double* gradient, void* self) {
    auto& s = *static_cast<Searching*>(self);
    s.work_out(x, gradient != nullptr);
    if (gradient) std::ranges::copy(s.slope_.front(), gradient);
    for (unsigned j = 0; gradient && j < s.n(); ++j) gradient[j] /= s.unit_;
    return s.here_.value / s.unit_;
  }
  static void excesses(unsigned m, double* out, unsigned n, const double* x, double* gradient, void* self) {
    auto& s = *static_cast<Searching*>(self);
    s.work_out(x, gradient != nullptr);
    std::ranges::copy(s.here_.excess, out);
    for (unsigned i = 0; gradient && i < m; ++i) std::ranges::copy(s.slope_[i + 1], gradient + i * n);
  }

  /// The value of a point; a value worse than all so far if it is unknown or the search must end.
  Worth ask(const BoxPoint& x) {
    const Worth* found = trouble_ || ended_ ? nullptr : worth_(x);
    if (!found) {
      ended_ = true;
      nlopt_force_stop(opt_.get());
      return beyond();
    }
    if (!found->known) return beyond();
    const bool enough = settings_.good_enough >= 0 && found->value <= settings_.good_enough && found->worst() <= met_within;
    if (enough) good_ = ended_ = true, nlopt_force_stop(opt_.get());
    if (seen_.excess.empty() && !any_) seen_ = *found, least_ = found->value;
    if (!any_ && found->value != 0) unit_ = std::abs(found->value);
    any_ = true;
    seen_.value = std::max(seen_.value, found->value), least_ = std::min(least_, found->value);
    for (std::size_t i = 0; i < found->excess.size(); ++i) seen_.excess[i] = std::max(seen_.excess[i], found->excess[i]);
    return *found;
  }
  Worth beyond() const {
    Worth out = seen_;
    const double spread = seen_.value - least_;
    out.known = false;
    out.value += spread > 0 ? spread : std::max(std::abs(seen_.value), 1.0);
    out.excess.resize(settings_.constraints, 1);
    for (double& e : out.excess) e = std::max(e, 0.0) + 1;
    return out;
  }

  void work_out(const double* at, bool slopes) {
    const BoxPoint x(at, at + n());
    try {
      if (x != x_) x_ = x, here_ = ask(x), slope_.clear();
      if (slopes && slope_.empty()) find_slopes();
    } catch (...) {
      trouble_ = std::current_exception();
      here_ = beyond(), slope_.assign(settings_.constraints + 1, BoxPoint(n(), 0.0));
      nlopt_force_stop(opt_.get());
    }
  }

  /// Central differences, one-sided at the ends of the box or if a neighbour is unknown.
  void find_slopes() {
    slope_.assign(settings_.constraints + 1, BoxPoint(n(), 0.0));
    const auto part = [](const Worth& w, std::size_t row) { return row == 0 ? w.value : w.excess[row - 1]; };
    for (std::size_t j = 0; j < n() && here_.known; ++j) {
      const double h = settings_.difference;
      Worth side[2];
      double place[2];
      for (const int k : {0, 1}) {
        BoxPoint x = x_;
        x[j] = place[k] = x_[j] + (k == 0 ? -h : h);
        if (x[j] >= 0 && x[j] <= 1) side[k] = ask(x);
        if (!side[k].known) side[k] = here_, place[k] = x_[j];
      }
      for (std::size_t row = 0; place[1] > place[0] && row < slope_.size(); ++row)
        slope_[row][j] = (part(side[1], row) - part(side[0], row)) / (place[1] - place[0]);
    }
  }

  const SearchSettings& settings_;
  const WorthAt& worth_;
  std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> opt_;
  BoxPoint x_;
  Worth here_, seen_;  ///< at x_; the largest value and excesses so far
  double least_ = 0;
  double unit_ = 1;  ///< the first value, which scales the problem: the first step of gradient methods is about as long as the gradient
  bool any_ = false, ended_ = false, good_ = false;
  std::vector<BoxPoint> slope_;  ///< of the value, then of each excess
  std::exception_ptr trouble_;
};

}  // namespace

const char* name_of(Optimiser m) { return facts(m).name; }
bool looks_everywhere(Optimiser m) { return facts(m).everywhere; }
bool takes_constraints(Optimiser m) { return facts(m).constraints; }

double Worth::worst() const {
  double out = 0;
  for (const double e : excess) out = std::max(out, e);
  return out;
}

bool better(const Worth& a, const Worth& b) {
  if (!a.known || !b.known) return a.known;
  const bool a_meets = a.worst() <= met_within, b_meets = b.worst() <= met_within;
  if (a_meets != b_meets) return a_meets;
  return a_meets ? a.value < b.value : a.worst() < b.worst();
}

std::string search(const SearchSettings& settings, const WorthAt& worth) { return Searching(settings, worth).go(); }

}  // namespace pintle
