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

}  // namespace

void prepare(Scene& scene, const std::vector<Measure>& measures) {
  scene.output.frames = 0;
  const bool one_state = !measures.empty() && measures.front().question.analysis == Analysis::statics;
  if (!scene.has_run && !one_state) return;
  const double until = scene.run.until, written = scene.output.every > 0 ? scene.output.every : until / 1000;
  double every = written;
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
    for (const double t : {asked.from, to, until - asked.last}) scene.output.instants.push_back(t);
    const double rows = asked.what == What::path ? rows_of_a_path : rows_in_a_window;
    if (sampled(asked) && to > asked.from) every = std::min(every, std::max((to - asked.from) / rows, until / most_rows));
  }
  if (every != written) scene.output.every = every;
}

}  // namespace pintle
