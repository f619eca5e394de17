#include "tests/extremes/atlas.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/reader.h"
#include "tests/extremes/contact_rigid.h"
#include "tests/unit/sanitized.h"

namespace extremes {

using namespace pintle;

const char* word(End e) {
  switch (e) {
    case End::finished: return "finished";
    case End::warned: return "warned";
    case End::stopped: return "stopped";
    case End::rejected: return "refused";
  }
  return "";
}

namespace {

/// A column by its name without the unit.
std::vector<double> values(const Table& t, const std::string& name) {
  for (const std::string& header : t.header)
    if (header.substr(0, header.rfind(" [")) == name) return t.column(header);
  throw std::out_of_range("no column \"" + name + "\"");
}

std::string not_finite(const Table& t) {
  for (std::size_t i = 0; i < t.data.size(); ++i)
    if (!std::isfinite(t.data[i])) return t.header[i % t.columns()] + ", row " + std::to_string(i / t.columns()) + ", is not finite";
  return "";
}

/// NaN means "still touching" in an impact's end and separation, and nothing elsewhere.
std::string not_finite(const std::vector<Impact>& impacts) {
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const Impact& i = impacts[k];
    const bool sound = std::isfinite(i.begin) && std::isfinite(i.approach) && std::isfinite(i.deepest) && std::isfinite(i.peak_force) &&
                       std::isfinite(i.lost) && !std::isinf(i.end) && !std::isinf(i.separation) && !(i.end < i.begin);
    if (!sound) return "impact " + std::to_string(k) + " is not finite or ends before it begins";
  }
  return "";
}

/// What no run may leave behind.
std::string trouble_of(const Run& run, double until) {
  if (run.status == Status::interrupted) return "did not end within its time, t = " + number(run.t_end) + " s";
  if (run.status != Status::finished && run.reason.empty()) return std::string(status_text(run.status)) + " without a reason";
  if (run.status == Status::finished && run.t_end != until) return "finished at t = " + number(run.t_end) + " s";
  for (const Table* t : {&run.trajectory, &run.ledger})
    if (const std::string bad = not_finite(*t); !bad.empty()) return bad;
  if (!std::isfinite(run.worst_unexplained) || !std::isfinite(run.energy_in_play)) return "the books are not finite";
  return not_finite(run.impacts);
}

/// By this process so far [s]: others on the machine do not count.
double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void carry_out(Attempt& a, double seconds) {
  try {
    a.model = build(*a.scene);
    const Assembly assembly = assemble(*a.scene, *a.model);
    const double latest = processor_time() + seconds;
    Listeners listeners;
    listeners.progress = [&](double) { return processor_time() < latest; };
    a.run = simulate(*a.scene, *a.model, assembly, listeners);
  } catch (const SceneError& e) {
    a.said = e.what();
    return;
  } catch (const AssemblyError& e) {
    a.said = e.what();
    return;
  }
  a.trouble = trouble_of(*a.run, a.scene->run.until);
  if (a.run->status != Status::finished)
    a.end = End::stopped, a.said = a.run->reason;
  else if (const auto doubt = std::ranges::find_if(a.run->warnings, [](const std::string& w) { return !w.starts_with("stability, "); });
           doubt != a.run->warnings.end())  // that steps could be fewer is no doubt of the numbers
    a.end = End::warned, a.said = *doubt;
  else
    a.end = End::finished;
}

}  // namespace

std::vector<double> Attempt::column(const std::string& name) const { return values(run->trajectory, name); }
std::vector<double> Attempt::ledger(const std::string& name) const { return values(run->ledger, name); }
double Attempt::open_books() const {
  return run->energy_in_play > 0 ? std::abs(run->worst_unexplained) / run->energy_in_play : std::abs(run->worst_unexplained);
}

Attempt attempt(Scene scene, double seconds) {
  Attempt a;
  a.scene = std::move(scene);
  try {
    carry_out(a, seconds * pintle_test::sanitizer_slowdown);
  } catch (const std::exception& e) {
    a.trouble = std::string("an exception: ") + e.what();
  }
  if (a.end == End::rejected && a.said.empty() && a.trouble.empty()) a.trouble = "refused without a message";
  return a;
}

Attempt attempt(const std::string& scene_text, double seconds) {
  Attempt a;
  try {
    return attempt(with_pieces(read_scene_text(scene_text, "scene.yaml")), seconds);
  } catch (const SceneError& e) {
    a.said = e.what();
  } catch (const std::exception& e) {
    a.trouble = std::string("an exception: ") + e.what();
  }
  return a;
}

Finding ended(const Attempt& a) { return {a.end, a.said, a.trouble, 0, -1}; }

Finding measured(const Attempt& a, double figure, double bound) {
  if (!a.whole()) return ended(a);
  return {a.end, a.said, a.trouble, figure, bound};
}

Finding worst(const std::vector<Finding>& all) {
  Finding out = all.at(0);
  for (const Finding& x : all) {
    if (!x.trouble.empty()) return x;
    if (x.end != out.end) return x;
    const auto share = [](const Finding& y) {
      return y.bound > 0 ? y.measured / y.bound : y.bound < 0 ? -1 : y.measured > 0 ? INFINITY : 0;
    };
    if (!(share(x) <= share(out))) out = x;
  }
  return out;
}

std::string Row::wrong() const {
  if (!found.trouble.empty()) return found.trouble;
  if (found.end == End::rejected && !what->or_refused.empty() && found.said.find(what->or_refused) != std::string::npos) return "";
  if (found.end != what->end)
    return std::string(word(found.end)) + ", not " + word(what->end) + (found.said.empty() ? "" : ": " + found.said);
  if (found.said.find(what->says) == std::string::npos) return "does not say \"" + what->says + "\" but \"" + found.said + "\"";
  const bool asserts_figure = found.bound >= 0;
  if (asserts_figure && !(found.measured <= found.bound)) return printed("%.3g exceeds its bound %.3g", found.measured, found.bound);
  if (!asserts_figure && (what->end == End::finished || what->end == End::warned)) return "nothing was measured";
  return "";
}

Row row(const Axis& axis, const Case& what) {
  Row out{&axis, &what, {}, 0};
  const auto begin = std::chrono::steady_clock::now();
  try {
    out.found = what.run();
  } catch (const std::exception& e) {
    out.found.trouble = std::string("an exception: ") + e.what();
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

const Atlas& atlas() {
  static const Atlas all = [] {
    Atlas axes = axes_of_contact();
    for (Axis& axis : axes_of_rigid_bodies()) axes.push_back(std::move(axis));
    for (Axis& axis : axes_of_motion()) axes.push_back(std::move(axis));
    return axes;
  }();
  return all;
}

std::string number(double x) { return printed("%.17g", x); }

std::string with(std::string text, const std::vector<std::pair<std::string, std::string>>& values) {
  for (const auto& [name, value] : values) {
    const std::string hole = "{" + name + "}";
    bool found = false;
    for (std::size_t i = text.find(hole); i != std::string::npos; i = text.find(hole, i + value.size()))
      text.replace(i, hole.size(), value), found = true;
    if (!found) throw std::invalid_argument("the text has no " + hole);
  }
  return text;
}

}  // namespace extremes
