#pragma once

#include <array>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/integration/explicit/stages.h"
#include "framework/integration/step.h"

namespace pintle {

/// The motion inside a step of a pair whose steps are too long for polynomials through their ends. The pair steps to the middle, and the
/// motion is evaluated at the sixths; y is then the polynomial of degree 9 through its values at 0, ½, 1 and its rates at 0, ⅙, ⅓, ½, ⅔,
/// ⅚, 1. Its error falls as that of a step of order 8, h⁹; it costs one step and twelve evaluations, regardless of the number of samples.
class InnerMotion {
 public:
  static constexpr int evaluations_beyond_step = 12;

  /// Does nothing if it is already prepared for this step. @returns false if the motion cannot be evaluated
  bool prepare(const System&, const Step&, Stages&, Equations&);
  /// Not projected onto the constraints. @pre prepared for this step
  void interpolate(const Step&, double t, State& out) const;

 private:
  struct Inner {
    double x;  ///< share of the step
    Instant at = {};
    Eigen::VectorXd rate = {};  ///< to x, beyond that of the cubic
  };

  bool is_prepared(const Step&) const;
  bool follow(const System&, const Step&, Stages&, Equations&);
  void bend();

  Eigen::VectorXd from_, to_;  ///< y at the ends of the step it was prepared for
  double t_ = 0, h_ = 0;       ///< of that step
  Inner middle_{1.0 / 2};
  std::array<Inner, 4> sixths_{{{1.0 / 6}, {1.0 / 3}, {2.0 / 3}, {5.0 / 6}}};
  Eigen::VectorXd a_, b_, c_, d_, e_, f_;  ///< y beyond the cubic: (¼ − u²)² (a + b u + c u² + d u³ + e u⁴ + f u⁵), u = x − ½
};

}  // namespace pintle
