#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/dynamics/equations/equations.h"
#include "framework/mechanism/model.h"

namespace pintle {

/// Deflection within the frame, relative to the body's size, at which a run ends: results beyond it are meaningless.
inline constexpr double greatest_deflection = 1;

/// Monitors flexible bodies at the output times: their deflection, and the change of their stiffness that loads would cause.
class DeflectionMonitor {
 public:
  explicit DeflectionMonitor(const Model&);
  /// @pre the equations were evaluated at the state
  void see(const State&, const Equations&);
  /// Why the run cannot continue, in words; empty while it can.
  std::string beyond_limits() const;
  /// The first of the warnings; empty if there is none.
  std::string worst_warning() const;
  void warn(std::vector<std::string>& warnings) const;

 private:
  struct Bent {
    double deflection = 0, slope = 0;  ///< largest so far, relative to the body's size; [rad]
  };
  /// Loads at which the geometric stiffness of the first shape is least and greatest, for inertia alone and for all loads: frequency_change
  /// uses only these.
  struct Loaded {
    Eigen::VectorXd first;   ///< effect of each on the first shape
    Eigen::MatrixXd factor;  ///< loads × 4
    std::array<double, 4> on_first{};
    bool any = false;
  };
  void see_loads(const StiffeningProbe&, const State&, const Equations&, Loaded&);
  std::string warning_of_loads(std::size_t k) const;

  const Model& model_;
  std::vector<Bent> bent_;
  std::vector<Loaded> loaded_;
  Eigen::VectorXd now_;
  double t_ = 0;
};

}  // namespace pintle
