#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/component/modal_model.h"
#include "framework/run/elastic_body.h"

namespace pintle {

/// Least share of the static compliance of a body that its shapes cover at a port in use.
struct CoveredCompliance {
  double share = 1;
  std::string at;  ///< "B, y"; empty: no port yields
};

/// What a body of elements is reduced to: all of a flexible body that is dear to find. Neither its name nor its damping is in it.
struct Reduction {
  FrameTie tie;
  ModalModel modes;     ///< no shapes: rigid, and what follows is empty
  FlexInertia inertia;  ///< about the mass centre, without damping
  std::vector<std::array<Eigen::MatrixXd, 2>> second;  ///< foreshortening at each port, if `stiffening: axial`
  CoveredCompliance compliance;
};

/// Of a body that says `modes`; of another, nothing.
/// @param chosen  how many modes where the scene says `keep: auto`; all without
/// @throws SceneError  as reduce
Reduction reduction_of(const Scene&, const ElasticBody&, std::optional<int> chosen = {});

}  // namespace pintle
