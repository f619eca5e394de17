#include "framework/analysis/simulate/explain_signals.h"

#include <cmath>
#include <numbers>

#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/dynamics/model/signal_values.h"

namespace pintle {

namespace {

class LawsAt {
 public:
  LawsAt(const Scene& scene, const Model& model, const State& start, const State& now)
      : scene_(scene), system_(model.system), start_(start), now_(now) {
    for (std::size_t i = 0; i < scene.loads.size() && i < model.order.loads.size(); ++i) {
      const SceneLoad& load = scene.loads[i];
      const auto* sized = std::get_if<SizedForce>(&system_.forces[at(model.order.loads[i])]);
      if (!sized) continue;
      const auto* force = std::get_if<SceneForce>(&load.what);
      const auto* torque = std::get_if<SceneTorque>(&load.what);
      const auto* spring = std::get_if<SceneSpring>(&load.what);
      const auto* torsion = std::get_if<SceneTorsionSpring>(&load.what);
      const Law& law = force ? force->x : torque ? torque->law : spring ? *spring->law : *torsion->law;
      judge(load.name, load.place, law, sized->size);
      if (force) judge(load.name, load.place, force->y, sized->other);
    }
    for (std::size_t i = 0; i < scene.states.size() && i < system_.states.size(); ++i)
      judge(scene.states[i].name, scene.states[i].place, scene.states[i].rate, system_.states[i].rate);
  }
  std::string found;

 private:
  void judge(const std::string& name, const Place& place, const Law& from, int law) {
    constexpr double steep = 1e6;
    if (!found.empty() || law < 0) return;
    const SignalLaw& of = system_.laws[at(law)];
    const double value = law_at(system_, of, now_.t, now_.y), before = law_at(system_, of, start_.t, start_.y);
    const bool grown = std::isfinite(value) && std::abs(value) > steep * std::abs(before) && before != 0;
    if (std::isfinite(value) && !grown) return;
    const std::string line = place.line > 0 ? ":" + std::to_string(place.line) : std::string();
    found = "the law " + from.text + " of " + quoted(name) + " (" + scene_.file + line + ") " +
            (grown ? "has come to " + number_text(value) : "is not a finite number") + " at t = " + number_text(now_.t, 9) + " s";
    for (std::size_t k = 0; k < of.in.size(); ++k)
      found +=
          (k == 0 ? ", where " : ", ") + from.signals[k] + " = " + number_text(signal_at(system_, system_.signals[at(of.in[k])], now_.y));
    found += grown ? ": it seems to grow beyond all bounds; keep it finite, for example with max(…)"
                   : ": keep it finite, for example with max(…) under a division or a root";
  }

  const Scene& scene_;
  const System& system_;
  const State &start_, &now_;
};

// A cam that has come to an end of its table, as every step on would leave it.
std::string explain_cams(const Scene& scene, const Model& model, const State& now) {
  constexpr double ahead = 1e-6, degrees = 180 / std::numbers::pi;  // [rad], of a radian
  const System& system = model.system;
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
           ") has come to the end of its table " + j.coupling->curve.text + " at t = " + number_text(now.t, 9) + " s, where its angle is " +
           number_text(degrees * angle, 9) + " deg: lengthen the table, let it span a whole turn, or end the run before";
  }
  return "";
}

}  // namespace

std::string explain_signals(const Scene& scene, const Model& model, const State& start, const State& now) {
  if (now.y.size() != model.system.n_y() || !now.y.allFinite()) return "";
  if (const std::string cam = explain_cams(scene, model, now); !cam.empty()) return cam;
  if (model.system.laws.empty()) return "";
  constexpr double ahead = 1e-9;  // of the run: where it would be next
  const std::string here = LawsAt(scene, model, start, now).found;
  if (!here.empty()) return here;
  State next = now;
  const double dt = ahead * scene.run.until;
  next.t += dt;
  next.y.head(model.system.n()) += dt * now.y.segment(model.system.n(), model.system.n());
  return LawsAt(scene, model, start, next).found;
}

}  // namespace pintle
