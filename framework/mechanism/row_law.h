#pragma once

#include <memory>

#include "framework/dynamics/equations/equations.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

/// A law of columns of trajectory.csv or outputs. It is evaluated on the row that would be written in a state, for which the
/// equations of motion are solved. Each copy has its own workspace.
class RowLaw {
 public:
  /// @param of  must be complete before the first call
  RowLaw(std::shared_ptr<const Model> of, WrittenOutput law) : of_(std::move(of)), law_(std::move(law)) {}
  RowLaw(const RowLaw& other) : of_(other.of_), law_(other.law_) {}
  RowLaw& operator=(const RowLaw&) = delete;

  /// NaN where the accelerations cannot be computed.
  double operator()(const State&) const;
  std::vector<double> inputs(const State&) const;
  const SignalFunction& function() const { return law_.of; }

 private:
  struct Work {
    explicit Work(const System& system) : eq(system), dy(system.n_y()) {}
    Equations eq;
    Eigen::VectorXd dy;
    Table row;
  };
  std::shared_ptr<const Model> of_;
  WrittenOutput law_;
  mutable std::unique_ptr<Work> work_;  ///< created at the first call
};

}  // namespace pintle
