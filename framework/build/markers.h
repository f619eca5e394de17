#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "framework/bodies/mechanism_body.h"
#include "framework/mechanism/model.h"
#include "framework/scene/scene.h"

namespace pintle {

/// Whether a direction is needed: on bodies of elements not every point has one.
enum class Holds { point, direction };

/// Converts a scene's names of bodies and points into indices and markers.
class Markers {
 public:
  /// @param elements  of each body of the scene, empty where it is rigid   @param model  receives the markers
  Markers(const Scene& scene, const std::vector<std::optional<MechanismBody>>& elements, Model& model);

  /// By name; without `ground`.
  const std::map<std::string, int>& bodies() const { return bodies_; }
  /// @throws SceneError  no such body
  int body(const PointRef&) const;
  /// @returns nullptr for the ground and rigid bodies
  const MechanismBody* elements(int body) const;

  /// @throws SceneError  no such point, or none with a direction
  Marker marker_at(const PointRef&, Holds) const;
  /// Its index in System::markers; created at the first call.
  int marker(const PointRef&, Holds = Holds::point);
  /// Marker at this point with the body's own axes as drawn, to carry a surface.
  int carrier(const PointRef&);
  /// Position of a point in the drawn body, body axes [m].
  Eigen::Vector2d place(const PointRef&) const;
  /// Marker for recording the motion of a point: second order, unless joints hold it at first order.
  Marker recorded_at(const PointRef&) const;

  /// @throws SceneError  both are on one body
  void two_bodies(const PointRef& a, const PointRef& b, const Place&) const;

 private:
  int index_of(const Marker&, const std::string& point);
  [[noreturn]] void wrong(const Place&, const std::string& message) const;

  const Scene& scene_;
  const std::vector<std::optional<MechanismBody>>& elements_;
  Model& model_;
  std::map<std::string, int> bodies_;
  std::map<std::tuple<int, double, double, double, std::string>, int> known_;
};

}  // namespace pintle
