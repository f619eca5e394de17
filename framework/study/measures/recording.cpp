#include <algorithm>
#include <cmath>

#include "framework/scene/error.h"
#include "framework/study/measures/measurables.h"
#include "framework/study/measures/measure.h"
#include "framework/study/measures/measure_words.h"
#include "framework/study/measures/mode_measure.h"

// The data that a run must record for its measures.
namespace pintle {

namespace {

constexpr double rows_in_a_window = 2000, rows_of_a_path = 500, most_rows = 200'000;

bool sampled(const Asked& a) { return !a.instant && (a.frequency || (a.statistic != Statistic::none && a.statistic != Statistic::last)); }

void record(Scene& scene, const Asked& a) {
  const auto add = [](std::vector<PointRef>& list, const PointRef& p) {
    const auto same = [&](const PointRef& q) { return q.body == p.body && q.point == p.point; };
    if (!p.body.empty() && std::ranges::none_of(list, same)) list.push_back(p);
  };
  for (const std::string& name : {a.owner, a.other}) {
    const PointRef p = point_named(scene, name);
    const bool wants_stress = a.what == What::stress ||
                              (a.what == What::column && (a.part == "N" || a.part == "V" || a.part == "M" || a.part == "stress" ||
                                                          a.part == "sx" || a.part == "sy" || a.part == "txy" || a.part == "von Mises"));
    if (p.body.empty()) continue;
    const SceneBody& body = *body_named(scene, p.body);
    const ScenePoint& point = *std::ranges::find(body.points, p.point, &ScenePoint::name);
    if (!wants_stress)
      add(scene.output.points, p);
    else if (body.elastic && body.elastic->modes && point.hole.empty())
      add(scene.output.stress, p);
  }
}

/// The longest interval up to `most` such that all instants are multiples of it, if that does not need too many rows.
double interval(double most, double until, std::vector<double> instants) {
  std::erase_if(instants, [&](double t) { return !(t > 0 && t < until * (1 - 1e-12)); });
  if (instants.empty()) return most;
  const double first = *std::min_element(instants.begin(), instants.end());
  for (double k = std::ceil(first / most - 1e-9), tries = 0; tries < 2000; ++k, ++tries) {
    const double every = first / k;
    if (until / every > std::min(most_rows, std::max(20'000.0, 10 * until / most))) break;
    const auto hit = [&](double t) { return std::abs(t / every - std::round(t / every)) < 1e-8; };
    if (std::ranges::all_of(instants, hit)) return every;
  }
  return most;
}

}  // namespace

void prepare(Scene& scene, const std::vector<Measure>& measures) {
  scene.output.frames = 0;
  const bool one_state = !measures.empty() && measures.front().question.analysis == Analysis::statics;
  if (!scene.has_run && !one_state) return;
  const double until = scene.run.until, written = scene.output.every > 0 ? scene.output.every : until / 1000;
  double most = written;
  std::vector<double> instants;
  for (const Measure& m : measures) {
    Asked asked;
    if (of_modes(m.question)) return;
    try {
      asked = read_measure(m, scene);
    } catch (const SceneError&) {
      continue;
    }
    record(scene, asked);
    if (asked.expression && std::ranges::find(scene.outputs, asked.owner, &SceneOutput::name) == scene.outputs.end())
      scene.outputs.push_back(*asked.expression);
    if (one_state) continue;
    const double to = std::isinf(asked.to) ? until : asked.to;
    instants.push_back(asked.from), instants.push_back(to);
    const double rows = asked.what == What::path ? rows_of_a_path : rows_in_a_window;
    if (sampled(asked) && to > asked.from) most = std::min(most, std::max((to - asked.from) / rows, until / most_rows));
  }
  if (one_state) return;
  if (const double every = interval(most, until, instants); every != written) scene.output.every = every;
}

}  // namespace pintle
