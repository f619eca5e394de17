#include "tests/soak/mechanism.h"

#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "contact/normal_law.h"
#include "tests/soak/drawn.h"
#include "tests/soak/surfaces.h"

namespace soak {

namespace {

using Eigen::Vector2d;
constexpr double pi = std::numbers::pi;
constexpr int ground = -1;

/// A point of a body as a scene names it, and where it is.
struct Attachment {
  int body;
  std::string text;
  Vector2d r;
  double direction;
};

class Drawing {
 public:
  explicit Drawing(std::uint64_t seed) : chance_(seed) {}

  std::string text(std::uint64_t seed) {
    drawn_.size = chance_.decades(-2, 1);
    drawn_.aligned = chance_.one_in(4);
    drawn_.flat = drawn_.aligned && chance_.one_in(2);
    drawn_.wild_masses = chance_.one_in(4);
    drawn_.flexible = chance_.one_in(3);
    drawn_.rough = chance_.one_in(3);
    drawn_.rigid = seed >= first_rigid, drawn_.in_steps = drawn_.rigid && seed % 2 == 1, drawn_.flexible &= !drawn_.in_steps;
    if (chance_.one_in(6))
      parallelograms();
    else if (chance_.one_in(8))
      slider_cranks();
    else
      tree();
    copies();
    drivers();
    loads();
    Chance own(~seed);  // so that a seed without it draws what it drew before
    std::swap(chance_, own);
    if (chance_.one_in(4)) series();
    std::swap(chance_, own);
    if (seed >= first_with_surfaces) {
      Chance more(seed * 3);
      add_surfaces(drawn_, more);
    }
    return written("seed " + std::to_string(seed), drawn_, chance_);
  }

 private:
  // --- places ---

  double turn() { return drawn_.aligned ? pi / 2 * (drawn_.flat ? 2 * chance_.below(2) : chance_.below(4)) : chance_.either_way(pi); }
  Vector2d along(double angle) const { return {std::cos(angle), std::sin(angle)}; }
  double reach() { return drawn_.size * (drawn_.aligned ? chance_.from_to(1, 2) : chance_.between(0.2, 1.5)); }
  Vector2d near(const Vector2d& r) { return r + reach() * along(turn()); }

  Link& link(int body) { return body == ground ? drawn_.ground : drawn_.links[static_cast<std::size_t>(body)]; }
  int bodies() const { return static_cast<int>(drawn_.links.size()); }

  /// A new point of a body that is not a beam, at a place in the world.
  Attachment attachment(int body, const Vector2d& r, double direction) {
    Link& l = link(body);
    l.points.push_back({"p" + std::to_string(l.points.size()), Eigen::Rotation2Dd(-l.angle) * (r - l.r), direction - l.angle});
    return {body, l.name + "." + l.points.back().name, r, direction};
  }
  Attachment attachment(int body, std::size_t point) {
    const Link& l = link(body);
    const Point& p = l.points[point];
    return {body, l.name + "." + p.name, l.r + Eigen::Rotation2Dd(l.angle) * p.at, l.angle + p.angle};
  }
  /// Some point of a body, new or of a beam one of those it has.
  Attachment some(int body) {
    Link& l = link(body);
    if (l.beam) return attachment(body, static_cast<std::size_t>(chance_.below(static_cast<int>(l.points.size()))));
    return attachment(body, body == ground ? near(Vector2d::Zero()) : near(l.r), turn());
  }
  /// Point of a body at a place, if it can have one there.
  bool can_grip(int body, const Vector2d& r) {
    if (!link(body).beam) return true;
    for (std::size_t i = 0; i < link(body).points.size(); ++i)
      if ((attachment(body, i).r - r).norm() < 1e-12 * drawn_.size) return true;
    return false;
  }
  Attachment at(int body, const Vector2d& r, double direction) {
    if (!link(body).beam) return attachment(body, r, direction);
    std::size_t best = 0;
    for (std::size_t i = 1; i < link(body).points.size(); ++i)
      if ((attachment(body, i).r - r).norm() < (attachment(body, best).r - r).norm()) best = i;
    return attachment(body, best);
  }

  /// A body with a point at r; its origin at `origin` unless it is a beam, which begins or ends at r.
  int add_body(const Vector2d& r, const Vector2d& origin) {
    Link l;
    l.name = "b" + std::to_string(drawn_.links.size());
    l.beam = drawn_.flexible && chance_.one_in(2);
    l.angle = turn();
    l.r = origin;
    if (l.beam) {
      l.length = reach();
      l.r = chance_.one_in(2) ? Vector2d(r - l.length * along(l.angle)) : r;
      l.points = {{"A", {0, 0}, drawn_.aligned ? 0 : chance_.either_way(pi)}, {"M", {l.length / 2, 0}, 0}, {"B", {l.length, 0}, 0}};
    }
    drawn_.links.push_back(l);
    return bodies() - 1;
  }

  // --- joints ---

  std::string name(const char* what) { return what + std::to_string(++named_); }

  void clearance(const Attachment& a, const Attachment& b) {
    const double radius = drawn_.size * chance_.between(0.02, 0.2), gap = radius * chance_.decades(-4, -1);
    const auto& laws = pintle::impact_factors();
    const auto& law = laws[static_cast<std::size_t>(chance_.below(static_cast<int>(laws.size())))];
    std::ostringstream s;
    s.precision(17);
    s << ", clearance: {radial: " << gap << ", bearing radius: " << radius << ", bearing: " << (link(b.body).name) << ", ";
    if (drawn_.rigid) return put_clearance(a, b, gap, s.str() + rigid_laws(drawn_, chance_) + "}");
    s << "normal: {" << law.name << ": {";
    if (law.name != "hertz") s << "restitution: " << (law.zero_allowed && chance_.one_in(8) ? 0.0 : chance_.between(0.05, 1)) << ", ";
    if (chance_.one_in(2))
      s << "young: " << chance_.decades(6, 11.4) << ", poisson: 0.3";
    else
      s << "stiffness: " << chance_.decades(5, 11) << ", exponent: " << (chance_.one_in(2) ? 1.5 : chance_.between(1, 2));
    s << "}}";
    if (chance_.one_in(2))
      s << ", friction: {ambrosio: {coefficient: " << chance_.between(0, 0.6) << ", v0: " << 1e-4 * drawn_.size * 10
        << ", v1: " << 1e-3 * drawn_.size * 10 << ", sliding: " << (chance_.one_in(2) ? "material" : "geometric") << "}}";
    put_clearance(a, b, gap, s.str() + "}");
  }
  void put_clearance(const Attachment& a, const Attachment& b, double gap, const std::string& says) {
    const std::string n = name("gap");
    drawn_.joints.push_back(n + ": {revolute: [" + a.text + ", " + b.text + "]" + says + "}");
    if (chance_.one_in(2)) {
      const Vector2d e = gap * chance_.between(0, 1.0001) * along(chance_.either_way(pi));
      std::ostringstream start;
      start.precision(17);
      start << n << ": {eccentricity: [" << e.x() << ", " << e.y() << "]}";
      drawn_.starts.push_back(start.str());
    }
  }

  void join(const char* kind, const Attachment& a, const Attachment& b, const std::string& more, int rows) {
    drawn_.joints.push_back(name(kind) + ": {" + kind + ": [" + a.text + ", " + b.text + "]" + more + "}");
    dofs_ -= rows;
  }
  static std::string keyed(const char* key, double value) {
    std::ostringstream s;
    s.precision(17);
    s << ", " << key << ": " << value;
    return s.str();
  }

  /// Hangs a new body on another.
  void hang(int parent) {
    const Attachment a = some(parent);
    const double slide = turn(), pick = chance_.unit();
    dofs_ += 3;
    if (pick < 0.52) {
      const int b = add_body(a.r, near(a.r));
      join("revolute", a, at(b, a.r, turn()), "", 2);
      turning_.push_back({a, attachment(b, link(b).points.size() - 1)});
    } else if (pick < 0.66) {
      const int b = add_body(a.r, near(a.r));
      clearance(a, at(b, a.r, turn()));
    } else if (pick < 0.72) {
      const int b = add_body(a.r, near(a.r));
      const Attachment g = at(b, a.r, turn());
      join("weld", a, g, keyed("angle", g.direction - a.direction), 3);
    } else if (pick < 0.82) {
      const Vector2d r = a.r + reach() * along(slide);
      const int b = add_body(r, near(r));
      const Attachment g = at(b, r, turn());
      join("distance", a, g, keyed("length", (g.r - a.r).norm()), 1);
    } else {
      const Vector2d r = a.r + drawn_.size * chance_.either_way(1) * along(a.direction);
      const int b = add_body(r, near(r));
      const Attachment g = at(b, r, turn());
      if (pick < 0.92)
        join("prismatic", a, g, keyed("angle", g.direction - a.direction), 2);
      else
        join("slot", a, g, "", 1);
    }
  }

  /// Closes a loop between two bodies that are there.
  void loop() {
    const int a = chance_.one_in(3) ? ground : chance_.below(bodies()), b = chance_.below(bodies());
    if (a == b) return;
    const Attachment g = some(a);
    const double pick = chance_.unit();
    const bool may_overconstrain = chance_.one_in(8);
    const auto fits = [&](int rows) { return dofs_ >= rows + 1 || may_overconstrain; };
    if (pick < 0.5 && fits(2) && can_grip(b, g.r)) {
      if (chance_.one_in(4))
        clearance(g, at(b, g.r, turn()));
      else
        join("revolute", g, at(b, g.r, turn()), "", 2);
    } else if (pick < 0.75 && fits(1)) {
      const Attachment h = some(b);
      if (const double d = (h.r - g.r).norm(); d > 0.01 * drawn_.size) join("distance", g, h, keyed("length", d), 1);
    } else if (fits(1)) {
      const Vector2d r = g.r + drawn_.size * chance_.either_way(1) * along(g.direction);
      if (can_grip(b, r)) join("slot", g, at(b, r, turn()), "", 1);
    }
  }

  void tree() {
    const int n = chance_.one_in(12) ? chance_.from_to(10, 40) : chance_.from_to(1, 7);
    const bool floating = chance_.one_in(10);
    for (int i = 0; i < n; ++i) {
      if (i == 0 && floating) {
        add_body({0, 0}, {0, 0});
        dofs_ += 3;
      } else {
        hang(i == 0 || (!floating && chance_.one_in(5)) ? ground : chance_.one_in(2) ? i - 1 : chance_.below(i));
      }
    }
    for (int i = chance_.one_in(2) ? 0 : chance_.from_to(1, 1 + n / 3); i > 0; --i) loop(), drawn_.loops = true;
  }

  /// Cranks of one length on a row of ground points, joined by rods: flat when they lie along the row.
  void parallelograms() {
    const int cells = chance_.from_to(1, 5);
    const double crank = reach(), pitch = chance_.one_in(3) ? crank : reach(), base = turn(),
                 open = chance_.one_in(2) ? 0.0 : chance_.either_way(pi);
    const Vector2d up = crank * along(base + open);
    Attachment before{};
    for (int i = 0; i <= cells; ++i) {
      const Vector2d foot = i * pitch * along(base);
      const int b = add_body(foot, foot + 0.5 * up);
      Link& l = link(b);
      if (l.beam) l.r = foot, l.angle = base + open, l.length = crank, l.points[1].at.x() = crank / 2, l.points[2].at.x() = crank;
      dofs_ += 3;
      const Attachment a = attachment(ground, foot, turn()), f = at(b, foot, turn());
      join("revolute", a, f, "", 2);
      turning_.push_back({a, f});
      const Attachment top = at(b, foot + up, turn());
      if (i > 0) {
        const bool bends = drawn_.flexible;
        drawn_.flexible = false;
        const int rod = add_body(before.r, 0.5 * (before.r + top.r));
        drawn_.flexible = bends;
        dofs_ += 3;
        join("revolute", before, attachment(rod, before.r, 0), "", 2);
        if (chance_.one_in(6))
          clearance(top, attachment(rod, top.r, 0));
        else
          join("revolute", top, attachment(rod, top.r, 0), "", 2);
      }
      before = top;
    }
  }

  /// Slider-cranks on one shaft; at a dead centre if their angle is 0, able to fold flat if crank and rod are equal.
  void slider_cranks() {
    const double crank = reach(), rod = chance_.one_in(3) ? crank : crank * chance_.between(1.2, 4), base = turn();
    const double angle = chance_.one_in(2) ? 0 : chance_.either_way(pi);
    const Vector2d axis = along(base), elbow = crank * along(base + angle);
    const double across = crank * std::sin(angle), x = crank * std::cos(angle) + std::sqrt(std::max(rod * rod - across * across, 0.0));
    const bool bends = drawn_.flexible;
    drawn_.flexible = false;
    const int shaft = add_body({0, 0}, 0.5 * elbow), slider = add_body(x * axis, x * axis);
    drawn_.flexible = bends;
    const int coupler = add_body(elbow, 0.5 * (elbow + x * axis));
    Link& l = link(coupler);
    if (l.beam)
      l.r = elbow, l.length = rod, l.angle = std::atan2(x * axis.y() - elbow.y(), x * axis.x() - elbow.x()), l.points[1].at.x() = rod / 2,
      l.points[2].at.x() = rod;
    dofs_ += 9;
    const Attachment o = attachment(ground, {0, 0}, base), crank_o = attachment(shaft, {0, 0}, base + angle);
    join("revolute", o, crank_o, "", 2);
    turning_.push_back({o, crank_o});
    join("revolute", attachment(shaft, elbow, 0), at(coupler, elbow, 0), "", 2);
    const Attachment end = at(coupler, x * axis, 0), pin = attachment(slider, x * axis, base);
    if (chance_.one_in(3))
      clearance(end, pin);
    else
      join("revolute", end, pin, "", 2);
    join("prismatic", o, pin, "", 2);
  }

  /// A joint stands twice: redundant, but not in contradiction.
  void copies() {
    if (!chance_.one_in(8) || drawn_.joints.empty()) return;
    const std::string original = chance_.of(drawn_.joints);
    if (original.starts_with("gap")) return;
    drawn_.joints.push_back(name("copy") + original.substr(original.find(':')));
  }

  // --- what moves it ---

  std::string law(double mean, double size, double rate) {
    std::ostringstream s;
    s.precision(17);
    switch (chance_.below(4)) {
      case 0: s << mean + size * chance_.either_way(1); break;
      case 1: s << mean << " + " << size << "*sin(" << rate << "*t)"; break;
      case 2: s << mean << " + " << size * rate * chance_.either_way(1) << "*t"; break;
      default: s << mean << " + " << size << "*step(t, 0, " << 1 / rate << ")";
    }
    return "\"" + s.str() + "\"";
  }
  double pace() { return soak::pace(drawn_.size, chance_); }

  void drivers() {
    for (int i = chance_.unit() < (drawn_.loops ? 0.8 : 0.5) ? 0 : chance_.one_in(4) ? 2 : 1; i > 0 && !turning_.empty(); --i) {
      if (dofs_ < 1 && !chance_.one_in(4)) return;
      const auto& [a, b] = chance_.of(turning_);
      std::ostringstream s;
      s.precision(17);
      const double w = pace();
      s << b.direction - a.direction << (chance_.one_in(2) ? " + 0.7*sin(" : " + 0*sin(") << w << "*t) + " << chance_.one_in(2) * w << "*t";
      drawn_.drivers.push_back(name("motor") + ": {angle: [" + a.text + ", " + b.text + "], law: \"" + s.str() + "\"}");
      --dofs_;
    }
    if (!chance_.one_in(6) || bodies() < 2 || dofs_ < 1) return;
    const Attachment a = some(chance_.one_in(2) ? ground : 0), b = some(bodies() - 1);
    const double d = (a.r - b.r).norm();
    if (d < 0.1 * drawn_.size) return;
    std::ostringstream s;
    s.precision(17);
    s << d << " + " << 0.2 * d << "*sin(" << pace() << "*t)";
    drawn_.drivers.push_back(name("jack") + ": {distance: [" + a.text + ", " + b.text + "], law: \"" + s.str() + "\"}");
  }

  void loads() {
    drawn_.gravity = chance_.one_in(4) ? Vector2d(0, 0) : chance_.one_in(3) ? Vector2d(9.81 * along(turn())) : Vector2d(0, -9.81);
    for (int i = chance_.from_to(0, 3); i > 0; --i) load();
  }
  void load() {
    const int b = chance_.below(bodies());
    int a = chance_.one_in(2) ? ground : chance_.below(bodies());
    if (a == b) a = ground;
    const Attachment g = some(b);
    std::ostringstream s;
    s.precision(17);
    const double stiffness = chance_.decades(-1, chance_.one_in(6) ? 9 : 3) / drawn_.size,
                 damping = chance_.one_in(2) ? 0 : chance_.decades(-3, 2);
    switch (chance_.below(4)) {
      case 0:
        s << "{force: [" << law(0, chance_.decades(-1, 2), pace()) << ", " << law(0, chance_.decades(-1, 2), pace()) << "], at: " << g.text
          << ", follows: " << (chance_.one_in(2) ? "true" : "false") << "}";
        break;
      case 1: s << "{torque: " << law(0, drawn_.size * chance_.decades(-1, 2), pace()) << ", on: " << g.text << "}"; break;
      case 2: {
        const Attachment h = some(a);
        s << "{spring: [" << h.text << ", " << g.text << "], stiffness: " << stiffness << ", damping: " << damping
          << ", free length: " << (chance_.one_in(4) ? 0 : (h.r - g.r).norm() * chance_.between(0.5, 1.5)) << "}";
        break;
      }
      default: {
        const Attachment h = some(a);
        s << "{torsion spring: [" << h.text << ", " << g.text << "], stiffness: " << stiffness * drawn_.size * drawn_.size
          << ", damping: " << damping * drawn_.size * drawn_.size << ", free angle: " << g.direction - h.direction + chance_.either_way(0.5)
          << "}";
      }
    }
    drawn_.forces.push_back(name("load") + ": " + s.str());
  }

  /// A spring and a damper in series.
  void series() {
    const int b = chance_.below(bodies());
    const Attachment g = some(b), h = some(chance_.one_in(2) || bodies() == 1 ? ground : (b + 1) % bodies());
    std::ostringstream s;
    s.precision(17);
    s << "{maxwell: [" << h.text << ", " << g.text << "], stiffness: " << chance_.decades(-1, chance_.one_in(4) ? 8 : 3) / drawn_.size
      << ", damping: " << chance_.decades(-3, 2) << "}";
    drawn_.forces.push_back(name("mount") + ": " + s.str());
  }

  Chance chance_;
  Drawn drawn_;
  std::vector<std::pair<Attachment, Attachment>> turning_;  ///< pairs whose angle a driver may impose
  int dofs_ = 0, named_ = 0;
};

}  // namespace

std::string random_scene(std::uint64_t seed) { return Drawing(seed).text(seed); }

}  // namespace soak
