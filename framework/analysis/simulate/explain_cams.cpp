#include "framework/analysis/simulate/explain_cams.h"

#include <cmath>
#include <numbers>

#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/dynamics/model/marker_motion.h"

namespace pintle {

std::string explain_cams(const Scene& scene, const Model& model, const State& now) {
  constexpr double ahead = 1e-6, degrees = 180 / std::numbers::pi;  // [rad], of a radian
  const System& system = model.system;
  if (now.y.size() != system.n_y() || !now.y.allFinite()) return "";
  for (std::size_t i = 0; i < scene.joints.size() && i < model.order.joints.size(); ++i) {
    const SceneJoint& j = scene.joints[i];
    if (j.kind != JointKind::cam) continue;
    const auto& cam = std::get<Relation>(system.joints[at(model.order.joints[i])]);
    const int shaft = cam.ends.marker[0], frame = cam.ends.marker[2];
    const MovingPoint b = moving_point(system, shaft, now.y), a = moving_point(system, frame, now.y);
    const auto curve = [&](double angle) { return j.coupling->curve.at(angle).value; };
    const double angle = b.angle - a.angle + system.markers[at(frame)].angle, beyond = angle + std::copysign(ahead, b.w - a.w);
    if (std::isfinite(curve(angle)) && std::isfinite(curve(beyond))) continue;
    return "the cam " + quoted(j.name) + " (" + (j.place.file.empty() ? scene.file : j.place.file) + ":" + std::to_string(j.place.line) +
           ") has reached the end of its table " + j.coupling->curve.text + " at t = " + number_text(now.t, 9) + " s, where its angle is " +
           number_text(degrees * angle, 9) + " deg: lengthen the table, let it span a whole turn, or end the run before";
  }
  return "";
}

}  // namespace pintle
