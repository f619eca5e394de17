#pragma once

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

  /// What moves, and of the ground what is near it. @throws std::runtime_error  there is nothing
  Eigen::AlignedBox2d world() const;
  /// The force that an arrow of the usual length has: of the largest of each frame the one that nine tenths of the frames do not pass [N].
  double usual_force() const;
  double largest_couple() const { return largest_couple_; }
  const FieldRange& range() const { return range_; }

 private:
  std::string around_, field_;
  Eigen::AlignedBox2d moving_;
  std::vector<Eigen::Vector2d> fixed_, paths_;  ///< points of guides and of the ground; of paths
  std::vector<double> largest_forces_;          ///< of each frame [N]
  double largest_couple_ = 0;                   ///< [N m]
  FieldRange range_;
};

}  // namespace pintle
