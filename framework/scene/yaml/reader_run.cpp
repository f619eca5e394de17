#include <algorithm>
#include <unordered_map>

#include "framework/common/nearest.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

void read_if(const Node& group, std::string_view key, const Dimension& expected, std::optional<double>& value) {
  if (group.has(key)) value = group.at(key).quantity(expected);
}

// x and y from `both`, or each separately.
void read_plane(const Node& group, std::string_view both, std::string_view x_key, std::string_view y_key, const Dimension& expected,
                std::optional<double>& x, std::optional<double>& y) {
  if (group.has(both)) {
    for (const std::string_view alone : {x_key, y_key})
      if (group.has(alone)) group.at(alone).fail("is given twice: leave out " + std::string(alone) + " or " + std::string(both));
    const Pair pair = group.at(both).pair(expected);
    x = pair[0];
    y = pair[1];
  }
  read_if(group, x_key, expected, x);
  read_if(group, y_key, expected, y);
}

void reject(const Node& group, std::initializer_list<std::string_view> keys, const char* message) {
  for (const std::string_view key : keys)
    if (group.has(key)) group.at(key).fail(message);
}

// Deformation of a flexible body at t = 0.
void read_bent(const Node& node, const SceneBody& body, StartBody& start) {
  for (const char* key : {"deflection", "modes"})
    if (node.has(key) && !(body.elastic && body.elastic->modes))
      node.at(key).fail("needs a flexible body: without modes the body is rigid in a mechanism; " + std::string("give \"") + body.name +
                        "\" modes, or leave it out");
  if (node.has("deflection") && node.has("modes")) node.fail("is bent by deflection and by modes at once; keep one of them");
  if (node.has("deflection"))
    for (const Node& at : node.at("deflection").entries("points and their displacements: {B: [0, 5 mm]}")) {
      check_own_point(at, at.name(), body);
      start.deflection.push_back({at.name(), at.pair(dimension::length), at.place()});
    }
  if (node.has("modes"))
    for (const Node& eta : node.at("modes").list(1, "modal coordinates in m kg^0.5, the lowest first: [1e-3, 0]"))
      start.modes.push_back(eta.quantity(dimension::number, rule::any));
}

StartBody read_start_body(const Node& node, const SceneBody& body) {
  reject(node, {"eccentricity"}, "is for a joint with clearance, but this is a body; use at");
  StartBody start;
  start.body = node.name();
  start.place = node.place();
  read_plane(node, "at", "x", "y", dimension::length, start.x, start.y);
  read_plane(node, "velocity", "vx", "vy", dimension::speed, start.vx, start.vy);
  read_if(node, "angle", dimension::angle, start.angle);
  if (node.has("speed") && node.at("speed").is_list())
    node.at("speed").fail("of a body is one value, its angular speed; for two values write velocity: [vx, vy]");
  read_if(node, "speed", dimension::angular_speed, start.speed);
  read_bent(node, body, start);
  return start;
}

StartJournal read_start_journal(const Node& node) {
  reject(node, {"at", "x", "y", "angle", "velocity", "vx", "vy", "deflection", "modes"},
         "is for a body, but this is a joint; use eccentricity and speed of its journal");
  StartJournal start;
  start.joint = node.name();
  start.place = node.place();
  if (node.has("eccentricity")) start.eccentricity = node.at("eccentricity").pair(dimension::length);
  if (node.has("speed")) start.speed = node.at("speed").pair(dimension::speed);
  return start;
}

/// The entries of a list by name, so that reading a long scene takes linear time.
template <class Entry>
std::unordered_map<std::string, const Entry*> by_name(const std::vector<Entry>& all) {
  std::unordered_map<std::string, const Entry*> out;
  for (const Entry& e : all) out.emplace(e.name, &e);
  return out;
}

struct StartNames {
  std::unordered_map<std::string, const SceneBody*> bodies;
  std::unordered_map<std::string, const SceneJoint*> joints;
};

void read_start_entry(const Node& node, const StartNames& names, Scene& scene) {
  check_keys(node, "start.*");
  const std::string name = node.name();
  const auto found = names.bodies.find(name);
  const auto joint_found = names.joints.find(name);
  const bool body = found != names.bodies.end();
  const SceneJoint* joint = joint_found == names.joints.end() ? nullptr : joint_found->second;
  const bool journal = joint && joint->clearance && !is_open(*joint);
  if (body && journal) node.fail("both a body and a joint are named \"" + name + "\"; rename one of them");
  if (body) {
    scene.start_bodies.push_back(read_start_body(node, *found->second));
  } else if (journal) {
    scene.start_journals.push_back(read_start_journal(node));
  } else if (joint) {
    node.fail(joint->play || is_open(*joint)
                  ? "the clearance of \"" + name + "\" starts where its bodies are; instead give one of these bodies a start position"
                  : "the joint \"" + name +
                        "\" has no clearance, so its journal has no start; give the joint a clearance, or give the start of a body");
  } else {
    std::vector<std::string> known;
    for (const SceneBody& b : scene.bodies) known.push_back(b.name);
    for (const SceneJoint& j : scene.joints)
      if (j.clearance && !is_open(j)) known.push_back(j.name);
    node.fail("there is no body or clearance joint \"" + name + "\"." + did_you_mean(name, known));
  }
}

void read_onset(const Node& node, RunOptions& run) {
  if (node.is_map()) {
    check_keys(node, "run.onset");
    run.onset_cut = node.at("cut").quantity(dimension::length, rule::positive);
  } else if (node.text("locate or {cut: 1e-8 m}") != "locate") {
    node.fail(node.shown() + " must be locate or {cut: 1e-8 m}");
  }
}

void read_method(const Node& node, RunOptions& run) {
  if (!node.is_map()) {
    run.method = node.one_of(choices("run", "method"));
    if (run.method == "moreau") node.fail("needs a step length; write {moreau: {step: 0.1 ms}}");
    return;
  }
  check_keys(node, "run.method");
  run.method = which_key(node, std::vector<std::string>{"generalized-alpha", "moreau"}, "its method");
  const Node method = node.at(run.method);
  check_keys(method, "run.method." + run.method);
  if (run.method == "moreau")
    run.step = method.at("step").quantity(dimension::time, rule::positive);
  else
    run.rho = method.at("rho").quantity(dimension::number, rule::zero_to_one);
}

const std::vector<ScenePoint>* points_of(const std::string& body, const Scene& scene) {
  if (body == "ground") return &scene.ground;
  const auto found = std::ranges::find(scene.bodies, body, &SceneBody::name);
  return found == scene.bodies.end() ? nullptr : &found->points;
}

// A point that exists; a body alone means the origin of its axes.
PointRef read_known_point(const Node& node, const Scene& scene) {
  PointRef ref = read_point_ref(node);
  const std::vector<ScenePoint>* points = points_of(ref.body, scene);
  std::vector<std::string> known;
  if (!points) {
    for (const SceneBody& b : scene.bodies) known.push_back(b.name);
    known.push_back("ground");
    node.fail("there is no body \"" + ref.body + "\"." + did_you_mean(ref.body, known));
  }
  if (ref.point.empty() || std::ranges::find(*points, ref.point, &ScenePoint::name) != points->end()) return ref;
  if (points->empty())
    node.fail("\"" + ref.point + "\" is not a point: " + ref.body + " has none; add points: {" + ref.point + ": [0, 0]} to it");
  for (const ScenePoint& p : *points) known.push_back(p.name);
  node.fail(ref.body + " has no point \"" + ref.point + "\"." + did_you_mean(ref.point, known));
}

// Stress exists only where material deforms.
void must_have_stress(const Node& node, const PointRef& ref, const Scene& scene) {
  const auto body = std::ranges::find(scene.bodies, ref.body, &SceneBody::name);
  if (body == scene.bodies.end()) node.fail("the ground has no stress; name a point of a body with modes");
  if (!body->elastic || !body->elastic->modes)
    node.fail(ref.body + " is rigid in a mechanism and has no stress; give it " + (body->elastic ? "" : "a beam or a plate, and ") +
              "modes, or leave the point out");
  if (ref.point.empty())
    node.fail("is a body; name a point for the stress: " + ref.body + "." + (body->points.empty() ? "A" : body->points.front().name));
  const ScenePoint& point = *std::ranges::find(body->points, ref.point, &ScenePoint::name);
  if (!point.hole.empty()) node.fail("is the centre of a hole, where there is no material; name a point of the plate itself");
}

std::vector<PointRef> read_output_points(const Node& node, const Scene& scene) {
  std::vector<PointRef> refs;
  for (const Node& item : node.list(1, "a list of points [coupler.M, rocker.D]")) {
    PointRef ref = read_known_point(item, scene);
    for (const PointRef& other : refs)
      if (other.body == ref.body && other.point == ref.point) item.fail(item.shown() + " is listed twice; remove one");
    refs.push_back(std::move(ref));
  }
  return refs;
}

double read_deformation(const Node& node) {
  if (node.is_scalar() && node.text("auto or a number") == "auto") return 0;
  return node.quantity(dimension::number, rule::positive);
}

constexpr int frames_left_open = -1;

int read_frames(const Node& node) {
  if (node.is_scalar() && node.text("auto or a number") == "auto") return frames_left_open;
  const long frames = node.count(0);
  if (frames > 1'000'000) node.fail("is more than a million; use fewer");
  return static_cast<int>(frames);
}

void read_constraints(const Node& node, RunOptions& run) {
  if (node.is_scalar() && node.text("projection or partitioning") == "index 3")
    node.fail(
        "index 3 is no longer available: its reactions had an error of order h after every change of step; use projection (the default), "
        "which satisfies the constraints in position and velocity");
  run.constraints = node.one_of(choices("run", "constraints"));
}

}  // namespace

void read_start(const Node& root, Scene& scene) {
  if (!root.has("start")) return;
  if (root.at("start").is_scalar()) {
    root.at("start").one_of(choices("", "start"));
    scene.start_at_rest = true;
    return;
  }
  const StartNames names{by_name(scene.bodies), by_name(scene.joints)};
  for (const Node& node : root.at("start").entries("bodies and their start: {crank: {speed: 5 rad/s}}"))
    read_start_entry(node, names, scene);
}

void read_run(const Node& root, Scene& scene) {
  scene.has_run = root.has("run");
  if (!scene.has_run) return;
  const Node node = root.at("run");
  check_keys(node, "run");
  RunOptions& run = scene.run;
  run.place = node.place();
  run.until = node.at("until").quantity(dimension::time, rule::positive);
  if (node.has("method")) read_method(node.at("method"), run);
  if (node.has("constraints")) read_constraints(node.at("constraints"), run);
  if (node.has("onset")) read_onset(node.at("onset"), run);
  read_optional(node, "tolerance", dimension::number, rule::tolerance, run.tolerance);
  read_optional(node, "max step", dimension::time, rule::positive, run.max_step);
  if (node.has("max steps")) run.max_steps = node.at("max steps").count(1);
  read_optional(node, "ledger bound", dimension::number, rule::positive, run.ledger_bound);
}

void read_output(const Node& root, Scene& scene) {
  scene.output.frames = frames_left_open;
  if (!root.has("output")) return;
  const Node node = root.at("output");
  check_keys(node, "output");
  OutputOptions& output = scene.output;
  output.place = node.place();
  read_optional(node, "every", dimension::time, rule::positive, output.every);
  if (scene.has_run && output.every > scene.run.until)
    node.at("every").fail(node.at("every").shown() + " is longer than the run; shorten it");
  read_optional(node, "states", dimension::time, rule::positive, output.states);
  if (scene.has_run && output.states > 0 && scene.run.until / output.states > 1e5)
    node.at("states").fail(node.at("states").shown() + " gives more than a hundred thousand files; increase it");
  if (node.has("frames")) output.frames = read_frames(node.at("frames"));
  read_optional(node, "exaggerate", dimension::number, rule::positive, output.exaggerate);
  if (node.has("deformation")) output.deformation = read_deformation(node.at("deformation"));
  if (node.has("points")) output.points = read_output_points(node.at("points"), scene);
  if (!node.has("stress")) return;
  output.stress = read_output_points(node.at("stress"), scene);
  const auto items = node.at("stress").list(1, "a list of points");
  for (std::size_t i = 0; i < items.size(); ++i) must_have_stress(items[i], output.stress[i], scene);
}

}  // namespace pintle
