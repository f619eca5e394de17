#include "framework/study/case.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <optional>

#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/common/library_threads.h"
#include "framework/scene/text_file.h"
#include "meshes/limits.h"

namespace pintle {

namespace {

using clock = std::chrono::steady_clock;
double since(clock::time_point begin) { return std::chrono::duration<double>(clock::now() - begin).count(); }

std::string one_line(std::string s) {
  for (char& c : s)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return s;
}

/// The measures' values; a name that this case lacks, but the study's scene without the case's overrides has, is no error.
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

/// @throws SceneError  a measure that neither the case nor the study's scene can have
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
  clock::time_point begin = clock::now();
  bool over = false;
};

void run_in(Outcome& out, const CaseSource& source, const Overrides& overrides, const std::vector<Measure>& measures,
            const CaseLimits& limits) {
  const auto begin = clock::now();
  Overrides all = source.common;
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scene scene = with_pieces(read_scene_text(source.text, source.file.string(), all, source.file.parent_path()));
  require_run(scene);
  validate_words(source, measures, scene);
  prepare(scene, measures);
  if (limits.time_alone) scene.output.every = scene.run.until;
  const Model model = limits.bodies ? build(scene, *limits.bodies) : build(scene);
  const Assembly assembly = assemble(scene, model);
  out.build_seconds = since(begin);

  Timed timed;
  Listeners listeners;
  if (limits.go_on || limits.seconds > 0)
    listeners.progress = [&](double) {
      timed.over = limits.seconds > 0 && since(timed.begin) > limits.seconds;
      return !timed.over && (!limits.go_on || limits.go_on());
    };
  auto run = std::make_shared<Run>(simulate(scene, model, assembly, listeners));
  out.run_seconds = since(timed.begin);
  if (run->status == Status::out_of_memory) throw std::bad_alloc();
  out.status = timed.over ? "over its limit" : status_text(run->status);
  out.reason = one_line(run->reason);
  if (timed.over) out.reason = "stopped after " + std::to_string(out.run_seconds) + " s of computing";
  out.t_end = run->t_end;
  out.counts = run->counts;
  out.impacts = static_cast<long>(run->impacts.size());
  out.unexplained_share = run->energy_in_play > 0 ? std::abs(run->worst_unexplained) / run->energy_in_play : 0;
  if (!limits.time_alone) measure(source, measures, scene, model, *run, out);
  if (limits.keep_run) out.run = std::move(run);
}

}  // namespace

CaseSource read_case_source(const std::filesystem::path& scene, Overrides common) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  return {scene, read_text_file(scene, most_bytes), std::move(common)};
}

Scene common_scene(const CaseSource& source) {
  return with_pieces(read_scene_text(source.text, source.file.string(), source.common, source.file.parent_path()));
}

Outcome run_case(const CaseSource& source, const Overrides& overrides, const std::vector<Measure>& measures, const CaseLimits& limits) {
  hold_library_threads();
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
    out.status = status_text(Status::interrupted), out.reason = "stopped while a body was meshed";
  } catch (const std::exception& error) {
    out.status = "refused", out.reason = one_line(error.what());
  }
  return out;
}

}  // namespace pintle
