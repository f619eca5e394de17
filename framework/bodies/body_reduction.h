#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/bodies/elastic_body.h"
#include "framework/component/reduction/modal_model.h"

namespace pintle {

/// Least share of the static compliance of a body that its shapes cover at a port in use.
struct CoveredCompliance {
  double share = 1;
  std::string at;  ///< "B, y"; empty: no port yields
};

/// How the body yields to a brief force at a port, as a contact exerts it: freely accelerating, whatever ties the frame. [m/N]
struct FreeCompliance {
  Eigen::Vector2d full = Eigen::Vector2d::Zero(), kept = Eigen::Vector2d::Zero();  ///< along x and y, body axes
};

/// The least share that shapes cover of the compliance under the body's own inertia, held at its interface.
struct CoveredInertia {
  double share = 1;
  std::string of;  ///< "acceleration along y"; empty: not judged, or nothing yields
};

/// What a body of elements is reduced to: all of a flexible body that is expensive to find. Neither its name nor its damping is in it.
struct Reduction {
  ReferenceConditions conditions;
  ModalModel modes;                                    ///< no shapes: rigid, and what follows is empty
  FlexInertia inertia;                                 ///< about the mass centre, without damping
  std::vector<std::array<Eigen::MatrixXd, 2>> second;  ///< foreshortening at each port, if it stiffens
  CoveredCompliance compliance;
  std::vector<FreeCompliance> when_free;  ///< of each port; zero of those not in use
  CoveredInertia inertia_covered;         ///< of Craig–Bampton shapes
  /// Foreshortening of each of `loads_on` in use, on the `stiffened_shapes` lowest; those not in use are zero.
  std::vector<Eigen::MatrixXd> by_load;
};

/// Of the lowest shapes, those that loads may mix in an estimate of stiffening.
inline constexpr Eigen::Index stiffened_shapes = 12;

/// Of a body that says `modes`; of another, nothing.
/// @param chosen  how many modes where the scene says `keep: auto`; all without
/// @throws SceneError  as reduce
Reduction reduction_of(const Scene&, const ElasticBody&, std::optional<int> chosen = {});

}  // namespace pintle
