#include "framework/build/build.h"
#include "tests/scenes/mechanisms.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include <nlohmann/json.hpp>

namespace pintle_scenes {

using namespace pintle;

PointRef ref(const std::string& text) {
  const auto dot = text.find('.');
  return dot == std::string::npos ? PointRef{text, "", {}} : PointRef{text.substr(0, dot), text.substr(dot + 1), {}};
}

ScenePoint point(const std::string& name, double x, double y, double angle) { return {name, {x, y}, angle, {}}; }

SceneBody body(const std::string& name, double mass, double inertia, std::vector<ScenePoint> points) {
  SceneBody b;
  b.name = name, b.mass = mass, b.inertia = inertia, b.points = std::move(points);
  return b;
}

SceneJoint joint(const std::string& name, JointKind kind, const std::string& a, const std::string& b) {
  SceneJoint j;
  j.name = name, j.kind = kind, j.a = ref(a), j.b = ref(b);
  return j;
}

Law law(double value, double rate, double accel) {
  return {[=](double t) {
            return Jet{value + rate * t + accel * t * t / 2, rate + accel * t, accel};
          },
          "polynomial", rate == 0 && accel == 0};
}

Law wave(double mean, double amplitude, double omega) {
  return {[=](double t) {
            const double s = amplitude * std::sin(omega * t), c = amplitude * std::cos(omega * t);
            return Jet{mean + s, omega * c, -omega * omega * s};
          },
          "wave", false};
}

SceneDriver angle_driver(const std::string& name, const std::string& a, const std::string& b, Law law) {
  return {name, DriverKind::angle, ref(a), ref(b), std::move(law), {}};
}

SceneLoad spring(const std::string& name, const std::string& a, const std::string& b, double stiffness, double damping,
                 double free_length) {
  return {name, SceneSpring{ref(a), ref(b), stiffness, damping, free_length}, {}};
}

SceneLoad torque(const std::string& name, const std::string& on, Law law) {
  return {name, SceneTorque{ref("ground"), ref(on), std::move(law)}, {}};
}

SceneLoad force(const std::string& name, const std::string& at, Law x, Law y, bool follows) {
  return {name, SceneForce{ref(at), std::move(x), std::move(y), follows}, {}};
}

StartBody start_angle(const std::string& name, double angle, double speed) {
  StartBody s;
  s.body = name, s.angle = angle, s.speed = speed;
  return s;
}

StartBody start_at(const std::string& name, double x, double y, double angle, double vx, double vy, double speed) {
  StartBody s = start_angle(name, angle, speed);
  s.x = x, s.y = y, s.vx = vx, s.vy = vy;
  return s;
}

SceneClearance clearance(const std::string& bearing, double radial, double restitution) {
  SceneClearance c;
  c.radial = radial, c.bearing_radius = 0.01, c.bearing = bearing;
  c.normal.restitution = restitution;
  c.normal.bearing = {207e9, 0.3};
  return c;
}

Scene scene(const SliderCrank& o) {
  Scene s;
  s.gravity = {0, -9.81};
  s.ground = {point("O", 0)};
  s.bodies = {body("crank", 0.3, 1e-4, {point("O", -0.025), point("A", 0.025)}),
              body("coupler", 0.21, 2.5e-4, {point("A", -0.06), point("B", 0.06)}), body("slider", 0.14, 1e-4, {point("P", 0)})};
  const double phi = -std::asin(0.05 * std::sin(o.angle) / 0.12);
  const double x = 0.05 * std::cos(o.angle), y = 0.05 * std::sin(o.angle);
  s.bodies[0].at = {x / 2, y / 2}, s.bodies[0].angle = o.angle;
  s.bodies[1].at = {x + 0.06 * std::cos(phi), y / 2}, s.bodies[1].angle = phi;
  s.bodies[2].at = {x + 0.12 * std::cos(phi), 0};
  s.joints = {
      joint("main bearing", JointKind::revolute, "ground.O", "crank.O"), joint("crank pin", JointKind::revolute, "crank.A", "coupler.A"),
      joint("gudgeon pin", JointKind::revolute, "coupler.B", "slider.P"), joint("guide", JointKind::prismatic, "ground.O", "slider.P")};
  if (o.clearance > 0) {
    SceneClearance c = clearance(o.bearing_on_slider ? "slider" : "coupler", o.clearance, o.restitution);
    if (o.friction > 0) {
      c.friction.emplace();
      c.friction->coefficient = o.friction;
      c.friction->sliding = o.geometric ? SlidingSpeed::geometric : SlidingSpeed::material;
    }
    s.joints[2].clearance = c;
    s.start_journals = {{"gudgeon pin", o.eccentricity, {0, 0}, {}}};
  }
  if (o.driven)
    s.drivers = {angle_driver("motor", "ground.O", "crank.O", law(o.angle, o.speed))};
  else
    s.start_bodies = {start_angle("crank", o.angle, o.speed)};
  s.run.until = o.until, s.run.tolerance = o.tolerance;
  s.run.method = o.method, s.run.constraints = o.constraints;
  s.output.every = o.until / o.outputs;
  return s;
}

pintle_oracle::Params oracle(const SliderCrank& o) {
  pintle_oracle::Params p;
  p.clearance = o.clearance;
  p.stiffness = pintle_oracle::hertz_stiffness(p.bearing_radius - o.clearance, p.bearing_radius, 207e9, 0.3, true);
  p.chi = pintle_oracle::lankarani_nikravesh(o.restitution);
  p.mu = o.friction;
  p.slip = o.geometric ? pintle_oracle::Slip::geometric : pintle_oracle::Slip::material;
  p.bearing_on_slider = o.bearing_on_slider;
  p.driven = o.driven;
  p.speed = o.speed, p.start_angle = o.angle;
  p.start_e[0] = o.eccentricity[0], p.start_e[1] = o.eccentricity[1];
  return p;
}

Scene pendulum(Hanging hanging, double release, double gravity) {
  Scene s;
  s.gravity = {0, -gravity};
  s.ground = {point("P", 0)};
  const double c = std::sin(release), d = -std::cos(release);  // where the rod points
  if (hanging == Hanging::by_link) {
    s.bodies = {body("bob", 1, 0.3, {point("end", 0)})};
    s.joints = {joint("rod", JointKind::distance, "ground.P", "bob.end")};
    s.joints[0].length = 1;
    s.start_bodies = {start_at("bob", c, d, 0, 0, 0, 0)};
  } else {
    // 0.5 m + J/(m · 0.5 m) = 1 m; the axes' origin at the pivot, the centre of mass beside it
    s.bodies = {body("bob", 1, 0.25, {point("P", 0), point("end", 1)})};
    s.bodies[0].center = {0.5, 0};
    s.joints = {joint("rod", JointKind::revolute, "ground.P", "bob.P")};
    s.start_bodies = {start_angle("bob", std::atan2(d, c), 0)};
  }
  return s;
}

Scene double_pendulum(const pintle_oracle::DoublePendulum& p, const pintle_oracle::Vec<4>& y) {
  constexpr double quarter = M_PI / 2;  // a body's x axis hangs down at angle −π/2
  Scene s;
  s.gravity = {0, -p.gravity};
  s.ground = {point("P", 0)};
  s.bodies = {body("upper", p.mass[0], p.inertia[0], {point("top", 0), point("end", p.length)}),
              body("lower", p.mass[1], p.inertia[1], {point("top", 0)})};
  s.bodies[0].center = {p.centre[0], 0}, s.bodies[1].center = {p.centre[1], 0};
  s.bodies[1].at = {p.length * std::sin(y[0]), -p.length * std::cos(y[0])};
  s.joints = {joint("pivot", JointKind::revolute, "ground.P", "upper.top"), joint("elbow", JointKind::revolute, "upper.end", "lower.top")};
  s.start_bodies = {start_angle("upper", y[0] - quarter, y[2]), start_angle("lower", y[1] - quarter, y[3])};
  return s;
}

Scene four_bar(const pintle_oracle::FourBar& f, const pintle_oracle::LinkMass (&links)[3], double gravity, double start, double rate,
               double accel) {
  const auto m = pintle_oracle::evaluate(f, {start, rate, accel});
  const double lengths[3] = {f.crank, f.coupler, f.rocker};
  const double angles[3] = {start, m.coupler.angle, m.rocker.angle};
  const char* names[3] = {"crank", "coupler", "rocker"};
  Scene s;
  s.gravity = {0, -gravity};
  s.ground = {point("A", 0), point("D", f.ground)};
  for (int i = 0; i < 3; ++i) {
    s.bodies.push_back(body(names[i], links[i].mass, links[i].inertia, {point("near", 0), point("far", lengths[i])}));
    s.bodies.back().center = {links[i].fraction * lengths[i], 0};
    s.bodies.back().angle = angles[i];
  }
  s.bodies[1].at = {f.crank * std::cos(start), f.crank * std::sin(start)};
  s.bodies[2].at = {f.ground, 0};
  s.joints = {joint("A", JointKind::revolute, "ground.A", "crank.near"), joint("B", JointKind::revolute, "crank.far", "coupler.near"),
              joint("C", JointKind::revolute, "coupler.far", "rocker.far"), joint("D", JointKind::revolute, "ground.D", "rocker.near")};
  s.drivers = {angle_driver("motor", "ground.A", "crank.near", law(start, rate, accel))};
  return s;
}

Scene andrews() {
  std::ifstream file(PINTLE_SOURCE_DIR "/tests/data/andrews.json");
  const auto data = nlohmann::json::parse(file);
  const auto& geometry = data["rigid_body_geometry"];
  const auto q = data["initial"]["q"].get<std::vector<double>>();
  const double beta = q[0], theta = q[1], gamma = q[2], phi = q[3], delta = q[4], omega = q[5], epsilon = q[6];
  const double angle[7] = {beta, beta + theta, gamma, phi + delta, delta, omega + epsilon, epsilon};

  Scene s;
  std::map<std::string, Pair> pins;  // where the points of the ground and, later, G, H, F are
  for (const auto& [name, at] : geometry["ground"].items()) {
    pins[name] = at.get<Pair>();
    s.ground.push_back(point(name, pins[name][0], pins[name][1]));
  }
  // Origins follow from bodies before them: F on K1, G on K5, H on K7.
  for (const int i : {1, 5, 7, 2, 3, 4, 6}) {
    const std::string number = std::to_string(i), name = std::string("K").append(number);
    const auto& b = geometry["bodies"][name];
    const auto& p = data["parameters"];
    SceneBody made = body(name, p[std::string("m").append(number)], p[std::string("i").append(number)], {});
    made.center = b["com"].get<Pair>();
    made.at = pins.at(b["origin"]);
    made.angle = angle[i - 1];
    for (const auto& [label, at] : b["pts"].items()) {
      const Pair x = at.get<Pair>();
      made.points.push_back(point(label, x[0], x[1]));
      const double c = std::cos(made.angle), d = std::sin(made.angle);
      pins[label] = {made.at[0] + c * x[0] - d * x[1], made.at[1] + d * x[0] + c * x[1]};
    }
    s.bodies.push_back(made);
  }
  for (const auto& [name, reaction] : data["joint_reactions_t0.03_Cartesian_model_N(lambda of constraint pos_a-pos_b=0; force on "
                                           "body of a = J^T lam)"]
                                          .items()) {
    // "E:K2-K3"
    const auto colon = name.find(':'), dash = name.find('-');
    const std::string pin = name.substr(0, colon);
    s.joints.push_back(
        joint(name, JointKind::revolute, name.substr(colon + 1, dash - colon - 1) + "." + pin, name.substr(dash + 1) + "." + pin));
  }
  s.loads = {spring("spring", "K3.D", "ground.C", 4530, 0, 0.07785), torque("drive", "K1", law(0.033))};
  for (const SceneBody& b : s.bodies)
    if (b.name == "K1") s.start_bodies = {start_angle("K1", b.angle, 0)};
  s.run.until = 0.03;
  return s;
}

Scene sundials_slider_crank() {
  // The rod's mass centre is the slider point; the crank turns about its own, so its mass is idle.
  // Mass 1 there, as the published table's first accelerations and energies need.
  Scene s;
  s.bodies = {body("crank", 1, 1, {point("O", 0), point("half", 0.25), point("A", 0.5)}),
              body("rod", 1, 2, {point("A", -1), point("half", -0.5), point("end", 1)})};
  const double q = M_PI / 2, p = -M_PI / 6;
  s.bodies[0].angle = q;
  s.bodies[1].angle = p, s.bodies[1].at = {std::cos(p), 0};
  s.joints = {joint("main bearing", JointKind::revolute, "ground", "crank.O"), joint("crank pin", JointKind::revolute, "crank.A", "rod.A"),
              joint("guide", JointKind::slot, "ground", "rod")};
  s.loads = {spring("spring", "crank.half", "rod.half", 1, 1, 1), force("push", "rod.end", law(1), law(0))};
  s.start_bodies = {start_angle("crank", q, 0)};
  s.run.until = 10;
  return s;
}

Scene floating_chain(double damping) {
  Scene s;
  s.bodies = {body("one", 1, 0.02, {point("A", 0.2), point("S", -0.1, 0.1)}),
              body("two", 0.5, 0.01, {point("A", -0.15), point("B", 0.15, 0.05)}),
              body("three", 2, 0.05, {point("B", -0.1), point("S", 0.3, -0.1)})};
  s.bodies[1].at = {0.35, 0}, s.bodies[2].at = {0.6, 0.05};
  s.joints = {joint("pin A", JointKind::revolute, "one.A", "two.A"), joint("pin B", JointKind::revolute, "two.B", "three.B")};
  s.loads = {spring("strut", "one.S", "three.S", 200, damping, 0.6)};
  s.start_bodies = {start_at("one", 0, 0, 0, 0.3, -0.2, 4), start_angle("two", 0, -3), start_angle("three", 0, 2)};
  s.run.until = 2;
  return s;
}

Scene moved(Scene s, double dx, double dy, double turn) {
  const double c = std::cos(turn), d = std::sin(turn);
  const auto turned = [&](Pair p) { return Pair{c * p[0] - d * p[1], d * p[0] + c * p[1]}; };
  const auto shifted = [&](Pair p) {
    p = turned(p);
    return Pair{p[0] + dx, p[1] + dy};
  };
  s.gravity = turned(s.gravity);
  for (ScenePoint& p : s.ground) p.at = shifted(p.at), p.angle += turn;
  for (SceneBody& b : s.bodies) b.at = shifted(b.at), b.angle += turn;
  for (StartBody& b : s.start_bodies)
    if (b.angle) *b.angle += turn;
  for (StartJournal& j : s.start_journals) j.eccentricity = turned(j.eccentricity), j.speed = turned(j.speed);
  return s;
}

Scene mirrored(Scene s) {
  const auto flip = [](Pair& p) { p[1] = -p[1]; };
  const auto flip_points = [&](std::vector<ScenePoint>& points) {
    for (ScenePoint& p : points) flip(p.at), p.angle = -p.angle;
  };
  flip(s.gravity);
  flip_points(s.ground);
  for (SceneBody& b : s.bodies) flip_points(b.points), flip(b.at), flip(b.center), b.angle = -b.angle;
  for (SceneJoint& j : s.joints) j.angle = -j.angle;
  for (StartBody& b : s.start_bodies) {
    for (auto* x : {&b.y, &b.vy, &b.angle, &b.speed})
      if (*x) **x = -**x;
  }
  for (StartJournal& j : s.start_journals) flip(j.eccentricity), flip(j.speed);
  return s;
}

std::vector<double> Whole::column(const std::string& name) const { return run.trajectory.column(name); }

Whole run(const Scene& s) {
  Whole w;
  w.model = build(s);
  w.assembly = assemble(s, w.model);
  w.run = simulate(s, w.model, w.assembly);
  return w;
}

double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.empty()) return std::nan("");
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return size > 0 ? difference / size : difference;
}

}  // namespace pintle_scenes
