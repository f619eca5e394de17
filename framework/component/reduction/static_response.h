#pragma once

#include <vector>

#include "framework/component/eigen/factor.h"
#include "framework/component/reduction/modal_model.h"

namespace pintle {

/// Displacement, satisfying the reference conditions, under each column of `loads`, in independent dofs, n × count: of the body held by
/// these conditions (tangent, chord) or, with mean axes, of the free body accelerated by the load. For a displacement v that satisfies the
/// conditions, vᵀK u = vᵀf, so that uᵀf is twice the strain energy.
/// @param loads  independent dofs, n × count
/// @throws std::invalid_argument  as reference_condition_rows; `loads` has another number of rows
/// @throws std::runtime_error     parts of the body are not joined, or move without resistance
Eigen::MatrixXd static_response(const Component&, const ReferenceConditions&, const Eigen::MatrixXd& loads);

/// The same for one body under several reference conditions, with its stiffness factored once.
class StaticResponse {
 public:
  /// @throws std::runtime_error  as static_response
  explicit StaticResponse(const Component&);  ///< the component must outlive it
  /// @throws std::invalid_argument  as static_response
  Eigen::MatrixXd under(const ReferenceConditions&, const Eigen::MatrixXd& loads) const;

 private:
  const Component& c_;
  std::vector<int> moving_;
  Factor held_;
};

}  // namespace pintle
