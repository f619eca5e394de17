#include "framework/study/case.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <optional>

#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/bodies/elastic_body.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/library_threads.h"
#include "framework/common/processor_time.h"
#include "framework/common/text.h"
#include "framework/configuration/equilibrium.h"
#include "framework/scene/text_file.h"
#include "framework/study/measures/mode_measure.h"
#include "meshes/limits.h"

namespace pintle {

namespace {

double since(double begin) { return processor_time() - begin; }

std::string one_line(std::string s) {
  for (char& c : s)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return s;
}

/// The measures' values; a name that this case lacks but the study's scene without the case's overrides has is not an error.
void measure(const CaseSource& source, const std::vector<Measure>& measures, const Scene& scene, const Model& model, const Run& run,
             Outcome& out) {
  for (std::size_t i = 0; i < measures.size(); ++i) {
    try {
      const MeasuredValue m = measured(measures[i], scene, model, run);
      out.values[i] = m.value, out.units[i] = m.unit;
    } catch (const SceneError&) {
      out.units[i] = measured_unit(measures[i], common_scene(source));
    }
  }
}

/// @throws SceneError  a measure that is possible neither in the case nor in the study's scene
void validate_words(const CaseSource& source, const std::vector<Measure>& measures, const Scene& scene) {
  std::optional<Scene> common;
  for (const Measure& m : measures) {
    try {
      measured_unit(m, scene);
    } catch (const SceneError&) {
      if (!common) common = common_scene(source);
      measured_unit(m, *common);
    }
  }
}

struct Timed {
  double begin = processor_time();
  bool over = false;
};

/// Listeners that stop a case, and record whether its time limit was the reason.
Listeners watched(const CaseLimits& limits, Timed& timed) {
  Listeners out;
  if (limits.go_on || limits.seconds > 0)
    out.progress = [&](double) {
      timed.over = limits.seconds > 0 && since(timed.begin) > limits.seconds;
      return !timed.over && (!limits.go_on || limits.go_on());
    };
  return out;
}

/// The equilibrium of the mechanism, as a run with one row.
Run resting(const Scene& scene, const Model& model, const Assembly& assembly, double at) {
  const Equilibrium rest = find_equilibrium(scene, model, assembly, at);
  Run run;
  run.status = rest.found ? Status::finished : Status::failed;
  run.reason = rest.found ? "" : "no equilibrium: " + rest.reason;
  run.trajectory = rest.table;
  run.t_end = rest.found ? at : -1;
  run.warnings = rest.warnings;
  if (rest.found && rest.stability.unstable > 0)
    run.warnings.push_back("the equilibrium is unstable in " + counted(static_cast<std::size_t>(rest.stability.unstable), "direction"));
  return run;
}

Run follow_case(const Scene& scene, const Model& model, const Assembly& assembly, const Question& question, const Listeners& listeners) {
  switch (question.analysis) {
    case Analysis::kinematics: return kinematics(scene, model, assembly, listeners);
    case Analysis::inverse: return inverse(scene, model, assembly, listeners).run;
    case Analysis::statics: return resting(scene, model, assembly, question.at.value_or(0));
    default: return simulate(scene, model, assembly, listeners);
  }
}

/// Copies the results of a run, or of an analysis with similar results.
void take_over(Outcome& out, const Run& run) {
  out.status = status_text(run.status);
  out.reason = one_line(run.reason);
  for (const std::string& warning : run.warnings) out.warnings.push_back(one_line(warning));
  out.t_end = run.t_end;
  out.counts = run.counts;
  out.impacts = static_cast<long>(run.impacts.size());
  out.unexplained_share = run.energy_in_play > 0 ? std::abs(run.worst_unexplained) / run.energy_in_play : 0;
}

std::string curves_csv(const std::vector<Measure>& curves, const Scene& scene, const Model& model, const Run& run) {
  std::vector<std::vector<double>> columns;
  std::string out = "t [s]";
  for (const Measure& m : curves) {
    columns.push_back(curve(m, scene, model, run));
    const std::string unit = measured_unit(m, scene);
    out += "," + csv_field(m.name + (unit.empty() ? "" : " [" + unit + "]"));
  }
  out += '\n';
  for (std::size_t r = 0; r < run.trajectory.rows(); ++r) {
    append_number(out, run.trajectory.data[r * run.trajectory.columns()]);
    for (const std::vector<double>& column : columns) {
      out += ',';
      if (r < column.size()) append_number(out, column[r]);
    }
    out += '\n';
  }
  return out;
}

/// Analyses whose results are columns: a run, kinematics, inverse, statics.
void follow_in(Outcome& out, const CaseSource& source, const std::vector<Measure>& measures, const CaseLimits& limits, Scene& scene,
               double begin) {
  if (limits.time_alone) scene.output.every = scene.run.until;
  const Model model = limits.bodies ? build(scene, *limits.bodies) : build(scene);
  const Assembly assembly = assemble(scene, model);
  out.build_seconds = since(begin);
  Timed timed;
  auto run = std::make_shared<Run>(follow_case(scene, model, assembly, source.question, watched(limits, timed)));
  out.run_seconds = since(timed.begin);
  if (run->status == Status::out_of_memory) throw std::bad_alloc();
  take_over(out, *run);
  if (timed.over) out.status = "over its limit", out.reason = "stopped after " + std::to_string(out.run_seconds) + " s of computing";
  if (!limits.time_alone) measure(source, measures, scene, model, *run, out);
  if (limits.curves && !limits.curves->empty()) out.curves[""] = curves_csv(*limits.curves, scene, model, *run);
  if (limits.keep_run) out.run = std::move(run);
}

/// The state for a linearisation; nothing, and the reason, if there is none.
std::optional<State> linearized_about(const Scene& scene, const Model& model, const Question& question, Outcome& out) {
  const Assembly assembly = assemble(scene, model);
  if (question.equilibrium) {
    const Equilibrium rest = find_equilibrium(scene, model, assembly, question.at.value_or(0));
    if (rest.found) return rest.state;
    out.status = status_text(Status::failed), out.reason = one_line("no equilibrium to linearize about: " + rest.reason);
    return {};
  }
  if (!question.at) return linearized_start(scene, model, assembly).state;
  try {
    return state_at(model, assembly.start, *question.at);
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& e) {
    out.status = status_text(Status::failed), out.reason = one_line(e.what());
    return {};
  }
}

/// Analyses that compute modes.
void modes_in(Outcome& out, const CaseSource& source, const std::vector<Measure>& measures, const CaseLimits& limits, const Scene& scene,
              double begin) {
  std::vector<AskedMode> asked;
  for (const Measure& m : measures) asked.push_back(read_mode_measure(m, scene)), out.units[asked.size() - 1] = asked.back().unit;
  const double solving = processor_time();
  if (source.question.analysis == Analysis::modes) {
    std::map<std::string, int> most;
    for (const AskedMode& a : asked) most[a.body] = std::max(most[a.body], a.number);
    for (const auto& [body, count] : most) {
      const ModesReport report = modes_of(scene, elastic_body(scene, elastic_of(scene, body)), count);
      for (std::size_t i = 0; i < asked.size(); ++i)
        if (asked[i].body == body) out.values[i] = value_of(asked[i], report);
    }
  } else {
    const Model model = limits.bodies ? build(scene, *limits.bodies) : build(scene);
    const std::optional<State> about = linearized_about(scene, model, source.question, out);
    if (!about) return;
    const Linearization lin = linearize(scene, model, *about, source.question.equilibrium ? Laws::hold : Laws::go_on);
    out.t_end = about->t;
    for (std::size_t i = 0; i < asked.size(); ++i) out.values[i] = value_of(asked[i], lin);
  }
  out.status = status_text(Status::finished);
  out.build_seconds = since(begin) - since(solving), out.run_seconds = since(solving);
}

void run_in(Outcome& out, const CaseSource& source, const Overrides& overrides, const std::vector<Measure>& measures,
            const CaseLimits& limits) {
  const double begin = processor_time();
  Scene scene = case_scene(source, overrides);
  validate_words(source, measures, scene);
  std::vector<Measure> recorded = measures;
  if (limits.curves) recorded.insert(recorded.end(), limits.curves->begin(), limits.curves->end());
  prepare(scene, recorded);
  if (of_modes(source.question)) return modes_in(out, source, measures, limits, scene, begin);
  follow_in(out, source, measures, limits, scene, begin);
}

}  // namespace

CaseSource read_case_source(const std::filesystem::path& scene, Overrides common) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  return {scene, read_text_file(scene, most_bytes), std::move(common)};
}

Scene case_scene(const CaseSource& source, const Overrides& overrides) {
  Overrides all = source.common;
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scene scene = read_scene_text(source.text, source.file.string(), all, source.file.parent_path());
  const Question& q = source.question;
  if (needs_run(q)) require_run(scene);
  switch (q.analysis) {
    case Analysis::modes: return scene;
    case Analysis::kinematics: return ready_for_kinematics(std::move(scene));
    case Analysis::statics: return with_pieces(ready_for_statics(std::move(scene)));
    default: return with_pieces(std::move(scene));
  }
}

Scene common_scene(const CaseSource& source) { return case_scene(source, {}); }

namespace {

/// A case in one situation, or without situations.
Outcome one_outcome(const CaseSource& source, const Overrides& overrides, const std::vector<Measure>& measures, const CaseLimits& limits) {
  Outcome out;
  out.values.assign(measures.size(), std::numeric_limits<double>::quiet_NaN());
  out.units.resize(measures.size());
  try {
    run_in(out, source, overrides, measures, limits);
  } catch (const AssemblyError& error) {
    out.status = "not assembled", out.reason = one_line(error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const MeshingStopped&) {
    out.status = status_text(Status::interrupted), out.reason = "stopped while a body was being meshed";
  } catch (const std::exception& error) {
    out.status = "refused", out.reason = one_line(error.what());
  }
  return out;
}

/// Adds the result of one of several situations to a case.
void merge(Outcome& whole, const Outcome& part, const std::vector<std::size_t>& places, const std::string& situation) {
  for (std::size_t i = 0; i < places.size(); ++i) whole.values[places[i]] = part.values[i], whole.units[places[i]] = part.units[i];
  for (const auto& [none, curves] : part.curves) whole.curves[situation] = curves;
  for (const std::string& warning : part.warnings) whole.warnings.push_back("in " + situation + ": " + warning);
  whole.build_seconds += part.build_seconds, whole.run_seconds += part.run_seconds;
  whole.t_end = whole.status.empty() ? part.t_end : std::min(whole.t_end, part.t_end);
  whole.counts.steps += part.counts.steps, whole.impacts += part.impacts;
  whole.unexplained_share = std::max(whole.unexplained_share, part.unexplained_share);
  const std::string finished = status_text(Status::finished);
  if (!whole.status.empty() && whole.status != finished) return;  // the first failure is reported
  whole.status = part.status;
  whole.reason = part.reason.empty() ? "" : "in " + situation + ": " + part.reason;
}

}  // namespace

Outcome run_case(const CaseSource& source, const Overrides& overrides, const std::vector<Measure>& measures, const CaseLimits& limits) {
  hold_library_threads();
  if (source.situations.empty()) return one_outcome(source, overrides, measures, limits);
  Outcome whole;
  whole.values.assign(measures.size(), std::numeric_limits<double>::quiet_NaN());
  whole.units.resize(measures.size());
  for (std::size_t s = 0; s < source.situations.size(); ++s) {
    std::vector<Measure> here;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < measures.size(); ++i)
      if (measures[i].situation == s) here.push_back(measures[i]), places.push_back(i);
    Overrides set = overrides;
    set.insert(set.end(), source.situations[s].set.begin(), source.situations[s].set.end());
    const bool asked = !here.empty() || (limits.curves && !limits.curves->empty());
    if (asked) merge(whole, one_outcome(source, set, here, limits), places, source.situations[s].name);
  }
  return whole;
}

}  // namespace pintle
