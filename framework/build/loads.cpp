#include "framework/build/loads.h"

#include <string>
#include <variant>

#include "framework/build/couplings.h"
#include "framework/scene/error.h"

namespace pintle {

namespace {

/// Creates the forces of one load; laws of signals use SizedForce, laws of time and constants need no signal.
class Loading {
 public:
  Loading(const Scene& scene, const SceneLoad& load, Markers& markers, SignalMaker& signals, Model& model)
      : scene_(scene), load_(load), markers_(markers), signals_(signals), system_(model.system) {}

  void operator()(const SceneForce& f) {
    if (markers_.body(f.at) == ground)
      throw SceneError(scene_.file, f.at.place, "a force on the ground has no effect; name a point of a body");
    const int b = markers_.marker(f.at, f.follows ? Holds::direction : Holds::point), a = markers_.marker({"ground", "", f.at.place});
    if (f.x.signals.empty() && f.y.signals.empty())
      add(PointForce{a, b, f.x.at, f.y.at, f.follows});
    else
      size(f.follows ? SizedForce::follows : SizedForce::world, a, b, f.x, &f.y);
  }

  void operator()(const SceneTorque& q) {
    const auto [a, b] = ends(q.a, q.b, Holds::direction);
    if (q.law.signals.empty())
      add(Torque{a, b, q.law.at});
    else
      size(SizedForce::couple, a, b, q.law);
  }

  void operator()(const SceneSpring& s) {
    const auto [a, b] = ends(s.a, s.b, Holds::point);
    if (s.law)
      size(SizedForce::pull, a, b, *s.law);
    else
      add(Spring{a, b, s.stiffness, s.damping, s.free_length});
  }

  void operator()(const SceneTorsionSpring& s) {
    const auto [a, b] = ends(s.a, s.b, Holds::direction);
    if (s.law)
      size(SizedForce::restoring, a, b, *s.law);
    else
      add(TorsionSpring{a, b, s.stiffness, s.damping, s.free_angle});
  }

  void operator()(const SceneMaxwell& m) {
    const auto [a, b] = ends(m.a, m.b, Holds::point);
    add(Maxwell{a, b, m.stiffness, m.damping});
  }

  void operator()(const SceneBelt& belt) {
    int span = 0;
    for (const BeltSpan& s : spans_of(scene_, load_, belt, markers_)) {
      system_.forces.push_back(s);
      system_.force_names.push_back(load_.name + " " + std::to_string(++span));
    }
  }

 private:
  std::pair<int, int> ends(const PointRef& a, const PointRef& b, Holds what) {
    markers_.two_bodies(a, b, load_.place);
    const int first = markers_.marker(a, what);
    return {first, markers_.marker(b, what)};
  }
  void add(Force force) {
    system_.forces.push_back(std::move(force));
    system_.force_names.push_back(load_.name);
  }
  void size(SizedForce::Way way, int a, int b, const Law& law, const Law* other = nullptr) {
    const int size = signals_.begin(law, load_.place);
    add(SizedForce{way, a, b, size, other ? signals_.begin(*other, load_.place) : -1});
  }

  const Scene& scene_;
  const SceneLoad& load_;
  Markers& markers_;
  SignalMaker& signals_;
  System& system_;
};

}  // namespace

void add_load(const Scene& scene, const SceneLoad& load, Markers& markers, SignalMaker& signals, Model& model) {
  model.order.loads.push_back(static_cast<int>(model.system.forces.size()));
  std::visit(Loading(scene, load, markers, signals, model), load.what);
}

}  // namespace pintle
