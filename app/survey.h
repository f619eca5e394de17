#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "app/body_fields.h"

namespace pintle {

/// Properties common to pictures of several frames: the visible part of the world, the scale of arrows, the range of colours.
class Survey {
 public:
  /// @param around  an owner to show alone, or empty   @param field  of flexible bodies, or empty
  Survey(std::string around, std::string field) : around_(std::move(around)), field_(std::move(field)) {}
  void add(const Drawing&);

  /// The box of everything that moves and the nearby part of the ground; a surface that contains the moving things, as a bowl contains a
  /// ball, is included completely. For a force or couple, the surroundings of its point.
  /// @throws std::invalid_argument  nothing is drawn of the owner; std::runtime_error  there is nothing at all
  Eigen::AlignedBox2d world() const;
  /// The force for an arrow of the usual length: of the largest force in each frame, the 90 % quantile over frames [N].
  double usual_force() const;
  double largest_couple() const { return largest_couple_; }
  /// All forces of all frames, whose arrows must fit in the picture; none if it shows only one owner.
  const std::vector<DrawnForce>& forces() const { return forces_; }
  /// Whether a force of this kind occurs in any frame.
  bool gives(Giver giver) const { return givers_[static_cast<std::size_t>(giver)]; }
  const FieldRange& range() const { return range_; }

 private:
  std::string around_, field_;
  Eigen::AlignedBox2d moving_, all_;     ///< of what is shown; of everything that moves
  std::vector<Eigen::Vector2d> places_;  ///< of the force shown
  std::vector<DrawnForce> forces_;
  std::vector<std::string> owners_;
  std::vector<Eigen::Vector2d> fixed_, paths_;          ///< points of guides and of the ground; of paths
  std::vector<std::vector<Eigen::Vector2d>> surfaces_;  ///< of the ground, complete
  std::vector<double> largest_forces_;                  ///< of each frame [N]
  std::array<bool, 4> givers_{};
  double largest_couple_ = 0;  ///< [N m]
  FieldRange range_;
};

}  // namespace pintle
