#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "app/body_fields.h"

namespace pintle {

/// What pictures of some frames share: the part of the world that they show, the scale of their arrows, the range of their colours.
class Survey {
 public:
  /// @param around  an owner to show alone, or nothing   @param field  of flexible bodies, or nothing
  Survey(std::string around, std::string field) : around_(std::move(around)), field_(std::move(field)) {}
  void add(const Drawing&);

  /// What moves, and of the ground what is near it, but of what it lies in, as a ball in a bowl, the whole. Around a force or couple what is near its place.
  /// @throws std::invalid_argument  nothing is drawn of what it is to be around; std::runtime_error  there is nothing at all
  Eigen::AlignedBox2d world() const;
  /// The force that an arrow of the usual length has: of the largest of each frame the one that nine tenths of the frames do not pass [N].
  double usual_force() const;
  double largest_couple() const { return largest_couple_; }
  /// All forces of all frames, whose arrows the picture is to hold; none where it shows a part alone.
  const std::vector<DrawnForce>& forces() const { return forces_; }
  /// Whether a force of this kind is in some frame.
  bool gives(Giver giver) const { return givers_[static_cast<std::size_t>(giver)]; }
  const FieldRange& range() const { return range_; }

 private:
  std::string around_, field_;
  Eigen::AlignedBox2d moving_, all_;     ///< of what is shown; of all that moves
  std::vector<Eigen::Vector2d> places_;  ///< of the force that is shown
  std::vector<DrawnForce> forces_;
  std::vector<std::string> owners_;
  std::vector<Eigen::Vector2d> fixed_, paths_;          ///< points of guides and of the ground; of paths
  std::vector<std::vector<Eigen::Vector2d>> surfaces_;  ///< of the ground, whole
  std::vector<double> largest_forces_;                  ///< of each frame [N]
  std::array<bool, 4> givers_{};
  double largest_couple_ = 0;  ///< [N m]
  FieldRange range_;
};

}  // namespace pintle
