#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/component/reduction/modal_model.h"

namespace pintle {

/// Smallest share of a body's static compliance that its shapes represent at a port in use.
struct CoveredCompliance {
  double share = 1;
  std::string at;  ///< "B, y"; empty: no port is compliant
};

/// Compliance to a brief force at a port, such as a contact force: the body accelerates freely, whatever its reference conditions. [m/N]
struct FreeCompliance {
  Eigen::Vector2d full = Eigen::Vector2d::Zero(), kept = Eigen::Vector2d::Zero();  ///< along x and y, body axes
  /// What the shapes do not represent, if its boundary is massless; otherwise zero. Symmetric, not negative.
  Eigen::Matrix2d massless = Eigen::Matrix2d::Zero();
};

/// Smallest share of the compliance to the body's own inertia, held at its interface, that the shapes represent.
struct CoveredInertia {
  double share = 1;
  std::string of;  ///< "acceleration along y"; empty: not evaluated, or no compliance
};

/// Result of reducing a body of elements: everything about a flexible body that is expensive to compute. Excludes its name and damping.
struct Reduction {
  ReferenceConditions conditions;
  ModalModel modes;                                    ///< without shapes: rigid, and the following members are empty
  FlexInertia inertia;                                 ///< about the mass centre, without damping
  std::vector<std::array<Eigen::MatrixXd, 2>> second;  ///< foreshortening at each port, for a body with geometric stiffness
  CoveredCompliance compliance;
  std::vector<FreeCompliance> when_free;  ///< of each port; zero for those not in use
  CoveredInertia inertia_covered;         ///< for Craig–Bampton shapes
  /// Foreshortening for each of `loads_on` in use, on the `stiffened_shapes` lowest; zero for those not in use.
  std::vector<Eigen::MatrixXd> by_load;
};

/// Number of lowest shapes used in an estimate of geometric stiffness.
inline constexpr Eigen::Index stiffened_shapes = 12;

/// For a body with `modes`; for others nothing.
/// @param chosen  number of modes for `keep: auto`; all if unset
/// @throws SceneError  as reduce
Reduction reduction_of(const Scene&, const ElasticBody&, std::optional<int> chosen = {});

}  // namespace pintle
