#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/build/build.h"

namespace pintle {

/// Deflection within the frame, over the body's size, at which a run ends: numbers beyond mean nothing.
inline constexpr double greatest_deflection = 1;

/// Flexible bodies at the output times: how far they bend, and how the loads on them would change their stiffness.
class DeflectionMonitor {
 public:
  explicit DeflectionMonitor(const Model&);
  /// @pre the equations were evaluated at the state
  void see(const State&, const Equations&);
  /// Why the run cannot go on, in words; empty while it can.
  std::string beyond_limits() const;
  /// The first of the doubts; empty if there is none.
  std::string worst_warning() const;
  void warn(std::vector<std::string>& warnings) const;

 private:
  struct Bent {
    double deflection = 0, slope = 0;  ///< greatest so far, over the body's size, [rad]
  };
  /// Loads where they stiffen the first shape least and most, those of inertia alone and all: frequency_change looks at no others.
  struct Loaded {
    Eigen::VectorXd first;   ///< what each does to the first shape
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
