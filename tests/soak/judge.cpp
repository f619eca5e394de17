#include "tests/soak/judge.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/common/processor_time.h"
#include "framework/configuration/equilibrium.h"
#include "framework/output/results.h"
#include "framework/scene/yaml/reader.h"
#include "tests/soak/agree.h"

namespace soak {

using namespace pintle;

namespace {

/// A message with its numbers and names taken out, so that equal reasons can be counted.
std::string kind_of(const std::string& whole) {
  std::string message = whole;
  if (message.starts_with("soak.yaml:"))  // file, line, key
    for (int i = 0; i < 2; ++i)
      if (const auto colon = message.find(": "); colon != std::string::npos) message.erase(0, colon + 2);
  message = message.substr(0, message.find(';'));
  std::string out;
  bool quoted = false;
  for (std::size_t i = 0; i < message.size(); ++i) {
    const char c = message[i];
    if (c == '"') {
      if (!quoted) out += "\"…\"";
      quoted = !quoted;
      continue;
    }
    if (quoted) continue;
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    const bool in_word = !out.empty() && (std::isalpha(static_cast<unsigned char>(out.back())) != 0);
    if (digit && !in_word) {
      out += '#';
      while (i + 1 < message.size() &&
             (std::isdigit(static_cast<unsigned char>(message[i + 1])) || std::string(".e+-").find(message[i + 1]) != std::string::npos) &&
             !(message[i + 1] == '.' && i + 2 < message.size() && message[i + 2] == ' '))
        ++i;
    } else {
      out += c;
    }
  }
  return out.substr(0, 120);
}

Verdict bad(const std::string& outcome, const std::string& detail) { return {false, outcome, detail, 0, 0}; }

/// Name of the first column that holds a number that is not finite.
std::string unfinite(const Table& t) {
  for (std::size_t i = 0; i < t.data.size(); ++i)
    if (!std::isfinite(t.data[i])) return t.header[i % t.columns()] + ", row " + std::to_string(i / t.columns());
  return "";
}

/// What is wrong with the books, judged by what their columns are called: "unexplained" must be what the others leave open, and
/// below `bound` of all that moved. Empty: nothing.
std::string wrong_books(const Table& ledger, double bound, double rounding) {
  const std::size_t n = ledger.columns();
  const auto has = [](const std::string& name, const char* word) { return name.find(word) != std::string::npos; };
  double in_play = 0, worst = 0;
  for (std::size_t row = 0; row < ledger.rows(); ++row) {
    double open = 0, largest = 0, moved = 0, unexplained = 0;
    for (std::size_t c = 1; c < n; ++c) {
      const std::string& name = ledger.header[c];
      const double value = ledger.data[row * n + c], rise = value - ledger.data[c];
      if (has(name, "unexplained")) unexplained = value;
      if (has(name, "unexplained") || name.starts_with("stored")) continue;
      largest = std::max({largest, std::abs(value), std::abs(ledger.data[c])});
      moved += std::abs(name.starts_with("gravity") ? rise : value);
      open += has(name, ".work in") ? -rise : rise;
    }
    in_play = std::max(in_play, moved);
    worst = std::max(worst, std::abs(unexplained));
    if (std::abs(open - unexplained) > 1e-12 * static_cast<double>(n) * largest)
      return "row " + std::to_string(row) + " leaves " + number(open) + " J, but says " + number(unexplained);
  }
  if (worst > bound * in_play + rounding) return number(worst) + " J of " + number(in_play) + " unexplained";
  return "";
}

/// The largest distance between the two recorded points of a pin, over the size of the mechanism.
double open_pins(const Scene& scene, const Model& model, const Table& trajectory, std::string& where) {
  double worst = 0;
  const auto known = [&](const PointRef& p) {
    return std::any_of(scene.output.points.begin(), scene.output.points.end(),
                       [&](const PointRef& o) { return o.body == p.body && o.point == p.point; });
  };
  const auto place = [&](const PointRef& p, const char* axis) -> std::vector<double> {
    if (p.body != "ground") return trajectory.column(p.body + "." + p.point + "." + axis + " [m]");
    for (const ScenePoint& g : scene.ground)
      if (g.name == p.point) return std::vector<double>(trajectory.rows(), g.at[axis[0] == 'x' ? 0 : 1]);
    return {};
  };
  for (const SceneJoint& j : scene.joints) {
    if (j.clearance || (j.kind != JointKind::revolute && j.kind != JointKind::weld)) continue;
    if ((j.a.body != "ground" && !known(j.a)) || (j.b.body != "ground" && !known(j.b))) continue;
    const auto ax = place(j.a, "x"), ay = place(j.a, "y"), bx = place(j.b, "x"), by = place(j.b, "y");
    for (std::size_t i = 0; i < ax.size(); ++i)
      if (const double gap = std::hypot(bx[i] - ax[i], by[i] - ay[i]) / model.system.length; !(gap <= worst)) worst = gap, where = j.name;
  }
  return worst;
}

/// How far the points of a pin may part, over the mechanism's size: explicit methods bring every output back onto the joints, the
/// implicit one interpolates between its steps, with an error of the order of its tolerance.
double may_part(const Scene& scene) {
  const bool implicit = scene.run.method == "auto" || scene.run.method == "generalized-alpha";
  return implicit ? std::max(1e-8, scene.run.tolerance) : 1e-8;
}

Verdict validate_run(const Scene& scene, const Model& model, const Assembly& assembly, bool twice, double seconds) {
  using clock = std::chrono::steady_clock;
  const auto begin = clock::now();
  bool late = false;
  double last = -1;
  long same = 0;
  Listeners listeners;
  listeners.progress = [&](double t) {
    same = t > last ? 0 : same + 1;
    last = t;
    late = std::chrono::duration<double>(clock::now() - begin).count() > seconds;
    return !late && same < 100;  // 6400 steps
  };
  const Run run = simulate(scene, model, assembly, listeners);
  if (same >= 100) return bad("time stands still", "t = " + number(last));
  if (late)
    return {true, "stopped: out of time", "t = " + number(run.t_end) + " of " + number(scene.run.until),
            static_cast<double>(run.counts.steps), seconds};
  for (const Table* t : {&run.trajectory, &run.ledger})
    if (const std::string where = unfinite(*t); !where.empty())
      return bad("a number that is not finite", where + "; status " + status_text(run.status) + " " + run.reason);
  if (!std::isfinite(run.unexplained) || !std::isfinite(run.energy_in_play))
    return bad("books that are not finite", status_text(run.status) + std::string(" ") + run.reason);
  if (run.status != Status::finished && run.reason.empty()) return bad("no reason", status_text(run.status));
  if (run_json(scene, model, assembly, run).empty()) return bad("no run.json", "");
  std::string where;
  if (const double gap = open_pins(scene, model, run.trajectory, where); !(gap <= may_part(scene)))
    return bad("a pin has parted", where + " by " + number(gap) + " of the mechanism's size");
  if (run.status == Status::finished) {
    if (!(run.t_end >= scene.run.until)) return bad("finished early", number(run.t_end));
    double mass = 0;
    for (const Body& b : model.system.bodies) mass += b.m;
    const double rounding =
        1e-11 * mass * model.system.length * (model.system.gravity.norm() + model.system.length / std::pow(scene.run.until, 2));
    if (const std::string wrong = wrong_books(run.ledger, scene.run.ledger_bound, rounding); !wrong.empty())
      return bad("books that say they close and do not", wrong);
  }
  if (twice && run.status != Status::interrupted) {
    const Run again = simulate(scene, model, assembly);
    if (again.trajectory.data != run.trajectory.data || again.ledger.data != run.ledger.data)
      return bad("a run that differs from itself", "");
  }
  Verdict v{true, status_text(run.status), run.reason, static_cast<double>(run.counts.steps), run.seconds};
  if (run.status == Status::failed) v.outcome = "failed: " + kind_of(run.reason);
  return v;
}

Listeners stop_after(double seconds) {
  Listeners listeners;
  listeners.progress = [begin = std::chrono::steady_clock::now(), seconds](double) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < seconds;
  };
  return listeners;
}

Verdict validate_statics(const Scene& scene, const Model& model, const Assembly& assembly) {
  const Equilibrium e = find_equilibrium(scene, model, assembly);
  if (!e.found) return e.reason.empty() ? bad("no reason", "") : Verdict{true, "not found: " + kind_of(e.reason), e.reason, 0, 0};
  if (const std::string where = unfinite(e.table); !where.empty()) return bad("a number that is not finite", where);
  if (!e.state.y.allFinite() || !e.lambda.allFinite()) return bad("a state that is not finite", "");
  if (!(e.residual <= 1e-6)) return bad("found, but forces are left", number(e.residual));
  if (equilibrium_json(scene, model, e).empty()) return bad("no statics.json", "");
  return {true, "found", e.method, static_cast<double>(e.iterations), 0};
}

/// Of kinematics and inverse dynamics.
Verdict validate_driven(const Scene& scene, const Model& model, const Run& run) {
  if (const std::string where = unfinite(run.trajectory); !where.empty())
    return bad("a number that is not finite", where + "; status " + status_text(run.status) + " " + run.reason);
  if (run.status != Status::finished && run.reason.empty()) return bad("no reason", status_text(run.status));
  std::string where;
  if (const double gap = open_pins(scene, model, run.trajectory, where); !(gap <= may_part(scene)))
    return bad("a pin has parted", where + " by " + number(gap) + " of the mechanism's size");
  Verdict v{true, status_text(run.status), run.reason, static_cast<double>(run.counts.steps), run.seconds};
  if (run.status == Status::failed) v.outcome = "failed: " + kind_of(run.reason);
  return v;
}

Verdict validate_linear(const Scene& scene, const Linearization& l) {
  for (const auto* m : {&l.space.A, &l.space.B, &l.space.C, &l.space.D})
    if (!m->allFinite()) return bad("a matrix that is not finite", "");
  int roots = 0;
  for (const LinearMode& m : l.modes) {
    if (!std::isfinite(std::abs(m.root)) || !m.shape.allFinite()) return bad("a mode that is not finite", m.carrier);
    roots += m.roots;
  }
  if (roots != l.space.A.rows()) return bad("roots are missing", std::to_string(roots) + " of " + std::to_string(l.space.A.rows()));
  if (linearized_json(scene, l).empty()) return bad("no linearized.json", "");
  return {true, "linearized", "", 0, 0};
}

}  // namespace

Verdict judge(const std::string& text, Question question, bool twice, double seconds) {
  try {
    const Scene scene = with_pieces(read_scene_text(text, "soak.yaml"));
    const Model model = build(scene);
    const Assembly assembly = assemble(scene, model);
    switch (question) {
      case Question::run: return validate_run(scene, model, assembly, twice, seconds);
      case Question::statics: return validate_statics(scene, model, assembly);
      case Question::kinematics: return validate_driven(scene, model, kinematics(scene, model, assembly, stop_after(seconds)));
      case Question::inverse: return validate_driven(scene, model, inverse(scene, model, assembly, stop_after(seconds)).run);
      case Question::linearize: return validate_linear(scene, linearize(scene, model, assembly.start));
      case Question::agree: {
        Verdict v = agreement(scene, model, assembly, seconds);
        v.seconds = processor_time();
        return v;
      }
    }
    return bad("no such question", "");
  } catch (const SceneError& e) {
    return {true, "scene refused: " + kind_of(e.what()), e.what(), 0, 0};
  } catch (const AssemblyError& e) {
    return {true, "no assembly: " + kind_of(e.what()), e.what(), 0, 0};
  } catch (const std::exception& e) {
    return bad("an exception that is none of ours", e.what());
  }
}

}  // namespace soak
