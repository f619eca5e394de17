#include <sstream>

#include "framework/scene/yaml/keys.h"
#include "tests/soak/drawn.h"

namespace soak {

namespace {

class Writing {
 public:
  Writing(const Drawn& drawn, Chance& chance) : drawn_(drawn), chance_(chance) { out_.precision(17); }

  std::string all(const std::string& title) {
    out_ << "# " << title << ": " << drawn_.links.size() << " bodies" << (drawn_.aligned ? drawn_.flat ? ", flat" : ", aligned" : "")
         << (drawn_.wild_masses ? ", masses over 8 decades" : "") << (drawn_.rough ? ", rough poses" : "") << "\n";
    out_ << "gravity: [" << drawn_.gravity.x() << ", " << drawn_.gravity.y() << "]\n";
    const Link& ground = drawn_.ground;
    if (!ground.points.empty() || !ground.profile.empty()) {
      out_ << "ground: {";
      if (!ground.points.empty()) write_points(ground);
      if (!ground.profile.empty()) out_ << (ground.points.empty() ? "" : ", ") << "profiles: {skin: " << ground.profile << "}";
      out_ << "}\n";
    }
    out_ << "bodies:\n";
    const double off = drawn_.rough ? chance_.decades(-3, -1) : 0;
    for (const Link& l : drawn_.links) {
      out_ << "  " << l.name << ": {";
      if (l.beam)
        write_beam(l);
      else
        write_rigid();
      if (!l.points.empty()) {
        out_ << ", ";
        write_points(l);
      }
      if (!l.profile.empty()) out_ << ", profiles: {skin: " << l.profile << "}";
      out_ << ", pose: {at: [" << l.r.x() + off * chance_.either_way(drawn_.size) << ", " << l.r.y() + off * chance_.either_way(drawn_.size)
           << "], angle: " << l.angle + off * chance_.either_way(1) << "}}\n";
    }
    write_list("joints", drawn_.joints);
    write_list("contacts", drawn_.contacts);
    write_list("drivers", drawn_.drivers);
    write_list("forces", drawn_.forces);
    std::vector<std::string> starts = drawn_.starts;
    if (drawn_.drivers.empty() && chance_.one_in(drawn_.loops ? 4 : 1.5)) {
      std::ostringstream s;
      s.precision(17);
      s << chance_.of(drawn_.links).name << ": {speed: " << pace(drawn_.size, chance_) * (chance_.one_in(2) ? 1 : -1) << "}";
      starts.push_back(s.str());
    }
    write_list("start", starts);
    write_run();
    return out_.str();
  }

 private:
  void write_points(const Link& l) {
    out_ << "points: {";
    for (std::size_t i = 0; i < l.points.size(); ++i) {
      const Point& p = l.points[i];
      out_ << (i ? ", " : "") << p.name << ": {at: [" << p.at.x() << ", " << p.at.y() << "], angle: " << p.angle << "}";
    }
    out_ << "}";
  }

  void write_beam(const Link& l) {
    out_ << "beam: {from: A, to: B, section: {circle: " << l.length * chance_.between(0.02, 0.12)
         << "}, elements: " << chance_.from_to(2, 4) << ", theory: " << (chance_.one_in(2) ? "euler" : "timoshenko")
         << ", young: " << chance_.decades(6, 11.3) << ", poisson: 0.3, density: " << chance_.decades(2.5, 4)
         << "}, modes: {frame: " << chance_.of<std::string>({"mean axes", "chord", "tangent"}) << ", "
         << chance_.of<std::string>({"keep: all", "count: 1", "count: 3", "craig-bampton: {count: 1}", "free: {count: 2}"}) << "}";
    if (chance_.one_in(2)) out_ << ", damping: {ratios: " << chance_.decades(-3, -0.5) << "}";
    if (chance_.one_in(3)) out_ << ", stiffening: " << (chance_.one_in(2) ? "rotation" : "axial");
  }
  void write_rigid() {
    const double mass = drawn_.wild_masses ? chance_.decades(-4, 4) : chance_.decades(-0.5, 0.5),
                 arm = drawn_.size * chance_.between(0.05, 0.7);
    out_ << "rigid: {mass: " << mass << ", inertia: " << mass * arm * arm * (chance_.one_in(20) ? 1e-6 : 1);
    if (chance_.one_in(2))
      out_ << ", center: [" << drawn_.size * chance_.either_way(0.5) << ", " << drawn_.size * chance_.either_way(0.5) << "]";
    out_ << "}";
  }

  void write_list(const char* key, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    out_ << key << ":\n";
    for (const std::string& line : lines) out_ << "  " << line << "\n";
  }

  void write_run() {
    const double until = std::sqrt(drawn_.size / 9.81) * chance_.between(0.5, 5);
    const auto known = pintle::choices("run", "method"), constraints = pintle::choices("run", "constraints");
    std::vector<std::string> methods(known.begin(), known.end());
    std::erase(methods, "moreau");  // which takes rigid contacts only
    if (drawn_.rigid) std::erase(methods, "generalized-alpha");
    const std::string method = methods[static_cast<std::size_t>(chance_.below(static_cast<int>(methods.size())))];
    std::vector<std::string> fitting;  // what the method takes
    for (const std::string& c : constraints)
      if (method != "generalized-alpha" || c != "partitioning") fitting.push_back(c);
    const double tolerance = chance_.decades(-10, -4);
    if (drawn_.in_steps) {
      out_ << "run: {until: " << until << ", method: {moreau: {step: " << until / chance_.from_to(300, 3000)
           << "}}, max steps: " << chance_.from_to(2000, 12000) << "}\n";
      return write_output(until);
    }
    out_ << "run: {until: " << until << ", method: " << method << ", constraints: " << chance_.of(fitting) << ", tolerance: " << tolerance
         << ", max steps: " << chance_.from_to(2000, 12000);
    if (chance_.one_in(10)) out_ << ", onset: {cut: " << 1e-6 * drawn_.size << "}";
    if (chance_.one_in(10)) out_ << ", max step: " << until / chance_.from_to(20, 500);
    out_ << "}\n";
    write_output(until);
  }

  void write_output(double until) {
    out_ << "output: {every: " << until / chance_.from_to(20, 60);
    std::string points;
    for (const Link& l : drawn_.links)
      for (const Point& p : l.points) points += (points.empty() ? "" : ", ") + l.name + "." + p.name;
    out_ << (points.empty() ? "" : ", points: [" + points + "]") << "}\n";
  }

  const Drawn& drawn_;
  Chance& chance_;
  std::ostringstream out_;
};

}  // namespace

double pace(double size, Chance& chance) { return std::sqrt(9.81 / size) * chance.decades(-0.5, 1); }

std::string written(const std::string& title, const Drawn& drawn, Chance& chance) { return Writing(drawn, chance).all(title); }

}  // namespace soak
