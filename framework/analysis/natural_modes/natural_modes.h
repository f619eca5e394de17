#pragma once

#include <optional>
#include <string>

#include "framework/bodies/modal_basis.h"

namespace pintle {

/// Modes with further data on each.
struct ModeTable {
  std::string title;  ///< "held at root", "free", "Craig–Bampton at A, B; mean axes"
  ModalModel modes;
  Eigen::Matrix3Xd mass;  ///< effective, along x and y [kg], in rotation about the mass centre [kg m²]
  Eigen::VectorXd zeta;   ///< damping ratios, zero if not given in the scene
};

struct ModesReport {
  RigidInertia inertia;              ///< about the origin of the body's axes
  double centre_inertia = 0;         ///< about the mass centre [kg m²]
  ModeTable natural;                 ///< of the body on its supports, free without supports
  int rigid = 0;                     ///< rigid motions that the supports allow, at zero frequency; not in the table
  std::optional<ModeTable> reduced;  ///< used in a mechanism, if the body has `modes`
  double seconds = 0;                ///< computing time for the natural modes [s]
};

/// @param count  number of natural modes; at most what the body has
/// @throws SceneError  more modes than degrees of freedom, reference conditions without their points, damping of a mode that is not kept, …
ModesReport modes_of(const Scene&, const ElasticBody&, int count);

std::string modes_csv(const ModeTable&, const ModesReport&);
std::string modes_json(const Scene&, const ElasticBody&, const ModesReport&);

}  // namespace pintle
