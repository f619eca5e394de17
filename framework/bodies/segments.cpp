#include "framework/bodies/segments.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/bodies/redirection.h"
#include "framework/common/nearest.h"

namespace pintle {

namespace {

using Eigen::Vector2d;

/// Distances below this part of a piece's length are rounding.
constexpr double rounding_of_step = 1e-8;

/// The line along which a beam runs.
struct Axis {
  std::vector<Vector2d> corners;
  std::vector<double> at;  ///< arc length of each corner, from 0 [m]
  double length() const { return at.back(); }
};

Axis axis_of(const Scene& scene, const SceneBody& body, const SceneBeam& beam) {
  Axis axis;
  for (const std::string& name : beam.through) {
    const Vector2d x = vector(point_of(scene, body, name, body.place).at);
    const double step = axis.corners.empty() ? 0 : (x - axis.corners.back()).norm();
    if (!axis.corners.empty() && !(step > 0))
      throw SceneError(scene.file, body.place, "its beam has no length up to " + name + "; move one of the two points");
    axis.at.push_back(axis.at.empty() ? 0 : axis.at.back() + step);
    axis.corners.push_back(x);
  }
  return axis;
}

Vector2d place(const Axis& axis, double s) {
  std::size_t i = 0;
  while (i + 2 < axis.at.size() && axis.at[i + 1] < s) ++i;
  const double t = (s - axis.at[i]) / (axis.at[i + 1] - axis.at[i]);
  return axis.corners[i] + t * (axis.corners[i + 1] - axis.corners[i]);
}

/// Arc length of p on the axis, the first if it passes there twice.
std::optional<double> arc_of(const Axis& axis, const Vector2d& p, double tolerance) {
  for (std::size_t i = 0; i + 1 < axis.corners.size(); ++i) {
    const Vector2d &a = axis.corners[i], &b = axis.corners[i + 1];
    const double t = std::clamp((b - a).dot(p - a) / (b - a).squaredNorm(), 0.0, 1.0);
    if ((a + t * (b - a) - p).norm() <= tolerance) return axis.at[i] + t * (axis.at[i + 1] - axis.at[i]);
  }
  return {};
}

/// How often the axis passes p, except through points of other names.
int passages(const Axis& axis, const SceneBeam& beam, const ScenePoint& p, double tolerance) {
  std::vector<double> at;
  for (std::size_t i = 0; i + 1 < axis.corners.size(); ++i) {
    const Vector2d &a = axis.corners[i], &b = axis.corners[i + 1];
    const double t = std::clamp((b - a).dot(vector(p.at) - a) / (b - a).squaredNorm(), 0.0, 1.0),
                 s = axis.at[i] + t * (axis.at[i + 1] - axis.at[i]);
    if ((a + t * (b - a) - vector(p.at)).norm() > tolerance) continue;
    bool other = !at.empty() && std::abs(at.back() - s) <= tolerance;
    for (std::size_t k = 0; k < axis.at.size(); ++k) other = other || (beam.through[k] != p.name && std::abs(axis.at[k] - s) <= tolerance);
    if (!other) at.push_back(s);
  }
  return static_cast<int>(at.size());
}

/// A beam while it is being divided.
struct Whole {
  const Scene& scene;
  const SceneBody& body;
  const SceneBeam& beam;
  Axis axis;
  double tolerance = 0;        ///< [m]
  std::vector<double> points;  ///< arc length of each point of the body
  std::vector<double> cuts;    ///< from 0 to the length, one more than pieces
};

void validate(const Scene& scene, const SceneBody& body, const SceneBeam& beam) {
  const auto wrong = [&](const std::string& message) { throw SceneError(scene.file, body.place, message); };
  if (!body.elastic->modes) wrong("its beam is cut into pieces but has no modes; add modes");
  if (beam.bar)
    wrong(
        "its beam is cut into pieces, but bars are hinged at every node and cannot be welded; "
        "use the theory euler or timoshenko");
  if (beam.through.size() < 2) wrong("its beam runs through fewer than two points; name two");
  for (std::size_t i = 0; i < beam.through.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (beam.through[i] == beam.through[k])
        wrong("its beam is cut into pieces and passes " + beam.through[i] + " twice; give the second passage its own point");
}

Whole whole_of(const Scene& scene, const SceneBody& body, const SceneBeam& beam) {
  validate(scene, body, beam);
  Whole whole{scene, body, beam, axis_of(scene, body, beam), 0, {}, {}};
  const double step = whole.axis.length() / beam.pieces;
  whole.tolerance = rounding_of_step * step;
  for (const ScenePoint& p : body.points) {
    const auto corner = std::ranges::find(beam.through, p.name);
    if (corner != beam.through.end()) {
      whole.points.push_back(whole.axis.at[static_cast<std::size_t>(corner - beam.through.begin())]);
    } else if (const auto s = arc_of(whole.axis, vector(p.at), whole.tolerance)) {
      whole.points.push_back(*s);
    } else {
      throw SceneError(
          scene.file, p.place,
          "lies off the axis of the beam \"" + body.name + "\", at " + shown(vector(p.at)) + "; put it on the axis or leave it out");
    }
  }
  for (const ScenePoint& p : body.points)
    if (passages(whole.axis, beam, p, whole.tolerance) > 1)
      throw SceneError(scene.file, body.place,
                       "its beam is cut into pieces and passes " + p.name +
                           " twice, where the pieces would not be joined; make the second passage a separate body and weld it there");
  whole.cuts.push_back(0);
  for (int k = 1; k < beam.pieces; ++k) {
    double cut = k * step;
    for (const double s : whole.points)
      if (std::abs(s - cut) <= whole.tolerance) cut = s;
    whole.cuts.push_back(cut);
  }
  whole.cuts.push_back(whole.axis.length());
  return whole;
}

/// A name for the cut that no point of the body has; the reader allows no quotes in names.
std::string cut_name(const SceneBody& body, std::size_t cut) {
  std::string name = "cut " + std::to_string(cut);
  while (std::ranges::find(body.points, name, &ScenePoint::name) != body.points.end()) name += "'";
  return name;
}

/// Volume between two positions on the beam. Areas are at most quadratic in the arc length, for which Simpson's rule is exact.
double volume(const SceneBeam& beam, double begin, double end, double length) {
  const auto area = [&](double s) {
    return section(beam.taper_to ? between(beam.section, *beam.taper_to, s / length) : beam.section, ShearFactor::five_sixths, 0).A;
  };
  return (end - begin) / 6 * (area(begin) + 4 * area((begin + end) / 2) + area(end));
}

void share_sections(const Whole& whole, std::size_t k, SceneBeam& piece) {
  const double length = whole.axis.length(), begin = whole.cuts[k], end = whole.cuts[k + 1];
  const SceneBeam& beam = whole.beam;
  if (beam.mass) piece.mass = *beam.mass * volume(beam, begin, end, length) / volume(beam, 0, length, length);
  const double wanted = beam.elements > 0 ? beam.elements : default_beam_elements;
  piece.elements = static_cast<int>(std::lround(wanted * end / length) - std::lround(wanted * begin / length));
  piece.elements = std::max(1, piece.elements);
  if (!beam.taper_to) return;
  piece.section = between(beam.section, *beam.taper_to, begin / length);
  piece.taper_to = between(beam.section, *beam.taper_to, end / length);
}

/// Points of piece k, and the names of those through which its beam runs. A point at its beginning belongs to the previous piece.
void share_points(const Whole& whole, std::size_t k, SceneBody& piece) {
  const bool first = k == 0, last = k + 2 == whole.cuts.size();
  const double begin = whole.cuts[k], end = whole.cuts[k + 1], near = whole.tolerance;
  std::string from, to;
  std::vector<std::pair<double, std::string>> corners;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const ScenePoint& p = whole.body.points[i];
    const double s = whole.points[i];
    if ((!first && s <= begin + near) || s > end + near) continue;
    piece.points.push_back(p);
    const bool corner = std::ranges::find(whole.beam.through, p.name) != whole.beam.through.end();
    if (s <= begin + near) {
      if (from.empty() || corner) from = p.name;
    } else if (s >= end - near) {
      if (to.empty() || corner) to = p.name;
    } else if (corner) {
      corners.emplace_back(s, p.name);
    }
  }
  const auto added = [&](std::size_t cut) {
    const Vector2d x = place(whole.axis, whole.cuts[cut]);
    piece.points.push_back({cut_name(whole.body, cut), {x.x(), x.y()}, 0, whole.body.place});
    return piece.points.back().name;
  };
  if (!first) from = added(k);
  if (!last && to.empty()) to = added(k + 1);
  std::ranges::sort(corners);
  auto& through = std::get<SceneBeam>(piece.elastic->shape).through;
  through = {from};
  for (const auto& [s, name] : corners) through.push_back(name);
  through.push_back(to);
}

bool has_point(const SceneBody& body, const std::string& name) {
  return std::ranges::find(body.points, name, &ScenePoint::name) != body.points.end();
}

/// Keeps the frame's reference conditions if the piece has their points, otherwise uses the ends of the piece.
void set_reference_conditions(SceneModes& modes, const SceneBody& piece) {
  using Frame = SceneModes::Frame;
  if (modes.frame == Frame::mean_axes) return;
  const bool chord = modes.frame == Frame::chord;
  if (has_point(piece, modes.a) && (!chord || has_point(piece, modes.b))) return;
  const SceneBeam& beam = std::get<SceneBeam>(piece.elastic->shape);
  modes.a = beam.through.front();
  modes.b = chord ? beam.through.back() : "";
}

/// Profiles carried by its points; their own points may lie on other pieces, since all share the axes of the whole.
std::vector<SceneProfile> profiles_on(const SceneBody& whole, const SceneBody& piece) {
  std::vector<SceneProfile> out;
  for (const SceneProfile& profile : whole.profiles) {
    if (!has_point(piece, profile.on)) continue;
    SceneProfile& made = out.emplace_back(profile);
    const auto place = [&](ScenePathPoint& p) {
      if (const auto named = std::ranges::find(whole.points, p.point, &ScenePoint::name); named != whole.points.end()) p.at = named->at;
      p.point.clear();
    };
    place(made.centre);
    for (ScenePathPoint& p : made.points) place(p);
  }
  return out;
}

SceneBody piece_of(const Whole& whole, std::size_t k) {
  SceneBody piece = whole.body;
  piece.name += " " + std::to_string(k + 1);
  piece.points.clear();
  share_points(whole, k, piece);
  SceneElastic& elastic = *piece.elastic;
  SceneBeam& beam = std::get<SceneBeam>(elastic.shape);
  beam.pieces = 1;
  share_sections(whole, k, beam);
  std::erase_if(elastic.lumps, [&](const SceneLump& l) { return !has_point(piece, l.at); });
  std::erase_if(elastic.supports, [&](const SceneSupport& s) { return !has_point(piece, s.at); });
  set_reference_conditions(*elastic.modes, piece);
  piece.profiles = profiles_on(whole.body, piece);
  return piece;
}

SceneJoint weld(const Whole& whole, const SceneBody& a, const SceneBody& b, std::size_t cut) {
  const std::string& from = std::get<SceneBeam>(a.elastic->shape).through.back();
  const std::string& to = std::get<SceneBeam>(b.elastic->shape).through.front();
  SceneJoint joint;
  joint.name = whole.body.name + " " + std::to_string(cut) + "-" + std::to_string(cut + 1);
  joint.kind = JointKind::weld;
  joint.place = whole.body.place;
  joint.a = {a.name, from, joint.place};
  joint.b = {b.name, to, joint.place};
  joint.angle = -std::ranges::find(a.points, from, &ScenePoint::name)->angle;  // b's is 0
  return joint;
}

Pieces cut(const Scene& scene, const SceneBody& body) {
  const Whole whole = whole_of(scene, body, std::get<SceneBeam>(body.elastic->shape));
  Pieces out;
  for (std::size_t k = 0; k + 1 < whole.cuts.size(); ++k) {
    out.bodies.push_back(piece_of(whole, k));
    for (const ScenePoint& p : out.bodies.back().points)
      if (has_point(body, p.name)) out.owner[p.name] = out.bodies.back().name;
    if (k > 0) out.welds.push_back(weld(whole, out.bodies[k - 1], out.bodies[k], k));
  }
  return out;
}

bool is_cut(const SceneBody& body) {
  const auto* beam = body.elastic ? std::get_if<SceneBeam>(&body.elastic->shape) : nullptr;
  return beam && beam->pieces > 1;
}

/// Checks that names needed for pieces and welds are free.
void validate_names(const Scene& scene, const std::map<std::string, Pieces>& cuts) {
  std::map<std::string, Place> taken;
  for (const SceneBody& b : scene.bodies) taken.try_emplace(b.name, b.place);
  for (const SceneJoint& j : scene.joints) taken.try_emplace(j.name, j.place);
  for (const SceneDriver& d : scene.drivers) taken.try_emplace(d.name, d.place);
  for (const SceneLoad& l : scene.loads) taken.try_emplace(l.name, l.place);
  const auto validate_name = [&](const std::string& name, const std::string& what, const std::string& beam) {
    if (const auto found = taken.find(name); found != taken.end())
      throw SceneError(
          scene.file, found->second,
          "\"" + name + "\" is the name of a " + what + " of the beam \"" + beam + "\", which is cut into pieces; choose another name");
  };
  for (const auto& [beam, pieces] : cuts) {
    for (const SceneBody& b : pieces.bodies) validate_name(b.name, "piece", beam);
    for (const SceneJoint& j : pieces.welds) validate_name(j.name, "weld", beam);
  }
}

}  // namespace

Scene with_pieces(Scene scene) {
  std::map<std::string, Pieces> cuts;
  for (const SceneBody& body : scene.bodies)
    if (is_cut(body)) cuts[body.name] = in_body(scene, body, [&] { return cut(scene, body); });
  if (cuts.empty()) return scene;
  validate_names(scene, cuts);
  const Scene before = scene;
  const Redirection to(before, cuts);
  for (SceneJoint& j : scene.joints) to.redirect(j);
  for (SceneContact& c : scene.contacts) to.redirect(c);
  for (SceneDriver& d : scene.drivers) to.redirect(d.a, d.b, d.place);
  for (SceneLoad& l : scene.loads) to.redirect(l);
  for (PointRef& ref : scene.output.points) to.redirect(ref);
  for (PointRef& ref : scene.output.stress) to.redirect(ref);
  scene.start_bodies = to.starts();
  for (const auto& [beam, pieces] : cuts)
    for (const auto& [point, piece] : pieces.owner) scene.piece_of_point[beam + "." + point] = piece;
  scene.bodies.clear();
  for (const SceneBody& body : before.bodies) {
    const auto found = cuts.find(body.name);
    if (found == cuts.end()) {
      scene.bodies.push_back(body);
      continue;
    }
    const auto& [pieces, welds, owner] = found->second;
    scene.bodies.insert(scene.bodies.end(), pieces.begin(), pieces.end());
    scene.joints.insert(scene.joints.end(), welds.begin(), welds.end());
    if (scene.statics && scene.statics->body == body.name) scene.statics.reset();
  }
  return scene;
}

}  // namespace pintle
