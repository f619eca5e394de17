#include <algorithm>
#include <cmath>

#include "framework/common/nearest.h"
#include "framework/common/some_of.h"
#include "framework/scene/error.h"
#include "framework/scene/units/signal_words.h"
#include "framework/study/measures/measure.h"
#include "framework/study/measures/measure_vocabulary.h"
#include "framework/study/measures/measure_words.h"
#include "framework/study/measures/measured_expression.h"
#include "framework/study/measures/measurables.h"
#include "framework/study/measures/mode_measure.h"

namespace pintle {

namespace {

[[noreturn]] void fail(const Measure& m, const Scene& scene, const std::string& message) {
  Place place = m.place;
  if (place.key.empty()) place.key = "measure \"" + m.words + "\"";
  throw SceneError(m.file.empty() ? scene.file : m.file, place, "\"" + m.words + "\" " + message);
}

/// Whether only flexible bodies have this quantity.
bool elastic(const Asked& a) {
  if (a.what == What::stress || a.what == What::displacement || a.what == What::deflection) return true;
  return (a.what == What::column || a.what == What::motion) &&
         (std::ranges::find(elastic_columns, "." + a.part, &Column::name) != elastic_columns.end() || a.part.starts_with("mode "));
}

/// The body of a measure; nullptr if there is none, or more than one.
const SceneBody* body_of(const Asked& a, const Scene& scene) {
  const PointRef p = point_named(scene, a.owner);
  return body_named(scene, p.body.empty() ? a.owner : p.body);
}

bool bends(const SceneBody& body) { return body.elastic && body.elastic->modes; }

std::string those_that_bend(const Scene& scene) {
  Names names;
  for (const SceneBody& b : scene.bodies)
    if (bends(b)) names.push_back(b.name);
  return names.empty() ? "every body of the scene is rigid" : "the flexible bodies are " + some_of(names, false);
}

/// Rejects columns that no case can have: "coil.depth" of a spring, "main.normal" of an ideal joint.
void refuse_absent_column(const Measure& m, const Asked& asked, const Scene& scene, const std::vector<std::string>& varied) {
  if (asked.what != What::column || asked.owner.empty() || asked.part.find(' ') != std::string::npos) return;
  const std::string name = asked.owner + "." + asked.part;
  const Measurables all = measurables_of(scene);
  const bool acts = std::ranges::find(all.actors, asked.owner) != all.actors.end();
  if (!acts || !is_unknown_signal(scene, name)) return;
  for (const char* section : {"joints", "contacts", "drivers", "forces"})
    for (const std::string& path : varied)
      if (path == section || path.starts_with(std::string(section) + "." + asked.owner)) return;
  Names parts;
  for (const auto& [word, what] : signal_words(scene))
    if (word.starts_with(asked.owner + ".") && word.find(" on ") == std::string::npos &&
        (what.what != SignalWord::work_rate || !what.text.empty()))
      parts.push_back(word);
  fail(m, scene, "is a column that \"" + asked.owner + "\" has in no case; it has " + listed(parts, "and"));
}

}  // namespace

void validate(const std::vector<Measure>& measures, const Scene& scene) {
  for (const Measure& m : measures) {
    if (of_modes(m.question)) {
      read_mode_measure(m, scene);
      continue;
    }
    const Asked asked = read_measure(m, scene);
    if (!over_time(m.question)) continue;
    const double last = std::isinf(asked.to) ? asked.from : asked.to;
    const bool late = m.path && !m.path->times.empty() && std::ranges::max(m.path->times) > scene.run.until * (1 + 1e-9);
    if (late || last > scene.run.until * (1 + 1e-9))
      fail(m, scene, "lies after the end of the run; make run.until longer, or ask for an earlier time");
  }
}

void validate_flexible(const std::vector<Measure>& measures, const Scene& scene, const std::vector<std::string>& varied) {
  for (const Measure& m : measures) {
    if (of_modes(m.question)) continue;
    const Asked asked = read_measure(m, scene);
    refuse_absent_column(m, asked, scene, varied);
    const SceneBody* body = elastic(asked) ? body_of(asked, scene) : nullptr;
    const auto may_change = [&](const std::string& path) { return path == "bodies" || path.starts_with("bodies." + body->name); };
    if (body && !bends(*body) && std::ranges::none_of(varied, may_change))
      fail(m, scene,
           "is of a flexible body, and \"" + body->name + "\" is rigid in every case; " + those_that_bend(scene) +
               ". Give it modes (docs/scene.md), or ask for something else");
  }
}

}  // namespace pintle
