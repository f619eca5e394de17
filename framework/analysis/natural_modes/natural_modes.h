#pragma once

#include <optional>
#include <string>

#include "framework/bodies/modal_basis.h"

namespace pintle {

/// Modes with what a reader wants to know of each.
struct ModeTable {
  std::string title;  ///< "held at root", "free", "Craig–Bampton at A, B; mean axes"
  ModalModel modes;
  Eigen::Matrix3Xd mass;  ///< effective, along x and y [kg], in rotation about the mass centre [kg m²]
  Eigen::VectorXd zeta;   ///< damping ratios, zero where the scene gives none
};

struct ModesReport {
  RigidInertia inertia;              ///< about the origin of the body's axes
  double centre_inertia = 0;         ///< about the mass centre [kg m²]
  ModeTable natural;                 ///< of the body as its supports hold it, free without supports
  int rigid = 0;                     ///< motions the supports leave, at zero frequency; not in the table
  std::optional<ModeTable> reduced;  ///< what a mechanism gets, if the body says `modes`
  double seconds = 0;                ///< for the natural modes
};

/// @param count  how many natural modes; at most what the body has
/// @throws SceneError  more modes than freedoms, a tie without its points, damping of a mode that is not kept, …
ModesReport modes_of(const Scene&, const ElasticBody&, int count);

std::string modes_csv(const ModeTable&, const ModesReport&);
std::string modes_json(const Scene&, const ElasticBody&, const ModesReport&);

}  // namespace pintle
