#pragma once

#include <vector>

#include "framework/common/index.h"
#include "framework/dynamics/equations/sticking.h"

/// Columns of eq.sticking, by their indices.
namespace pintle::sticking_columns {

using Places = std::vector<Eigen::Index>;

/// An index into State::friction: the contacts come first, then the frictions in joints.
inline bool of_contact(const System& system, std::size_t k) { return k < system.contacts.size(); }
inline std::size_t joint_friction(const System& system, std::size_t k) { return k - system.contacts.size(); }

inline Eigen::Index count(const Sticking& s) { return static_cast<Eigen::Index>(s.of.size()); }
inline std::size_t place(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// N of a friction in a joint, for given multipliers.
double load_of(const System&, const Equations&, std::size_t k, const Eigen::VectorXd& lambda);

}  // namespace pintle::sticking_columns
