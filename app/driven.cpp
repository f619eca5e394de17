// Commands on driven mechanisms: kinematics and inverse.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/output/results.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// compute(listeners) with a progress display; frames, if the scene requests any, are passed to `writer`.
template <class Compute>
auto watched(const Scene& scene, const Model& model, std::optional<FrameWriter>& writer, const Options& options, Compute compute) {
  now_doing("computing the motion");
  const Drafting drafting(scene, model);
  Listeners listeners;
  if (writer) listeners.frame = [&](const State& state, const Equations& eq) { writer->add(draw(model, drafting, state, eq)); };
  Progress progress(scene.run.until, options.quiet);
  listeners.progress = [&](double t) { return progress(t); };
  return compute(listeners);
}

std::optional<FrameWriter> frame_writer(const Scene& scene, const ResultsDirectory& results) {
  return scene.output.frames > 1 ? std::make_optional<FrameWriter>(results.path()) : std::nullopt;
}

Rows run_rows(const Run& run) {
  return {{"time reached", number(run.t_end) + " s"},
          {"steps", std::to_string(run.counts.steps) + " (" + std::to_string(run.counts.rejected) + " rejected) in " +
                        number(run.seconds, 3) + " s"},
          {"constraints held to", number(run.worst_position, 2) + " in position, " + number(run.worst_velocity, 2) + " in speed (scaled)"}};
}

void print(const Scene& scene, const Run& run, Rows rows, const fs::path& out) {
  if (run.status != Status::not_written)
    rows.emplace_back("results", out.string() + (scene.output.frames > 1 ? ", animation " + (out / "mechanism.pvd").string() : ""));
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  print_rows(std::cout, rows);
  for (const std::string& w : run.warnings) std::cout << "  warning: " << w << "\n";
  std::cout << "  " << status_text(run.status) << (run.reason.empty() ? "" : ": " + run.reason) << "\n";
}

std::string effort_text(const Inverse& found, std::size_t d, const fs::path& out) {
  const DriverEffort& e = found.drivers[d];
  const std::string unit = e.turns ? " N m" : " N";
  if (e.t.empty()) return "nothing computed";
  const auto [least, most] = std::minmax_element(e.value.begin(), e.value.end());
  return number(*least) + " to " + number(*most) + unit + ", " + (out / effort_file(found, d)).string() + " with " +
         std::to_string(e.t.size()) + " rows" +
         (std::isnan(e.error) ? "" : " (error of a spline through every second row: " + number(e.error, 2) + unit + " at most)");
}

}  // namespace

int kinematics(const Options& options) {
  const Scene scene = ready_for_kinematics(read_scene(options.scene, overrides(options)));
  require_run(scene);
  const fs::path out = results_directory(options, "-kinematics");
  require_place(out);
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  require_driven(scene, model, assembly);

  handle_signals();
  tell_leftovers(options, out);
  ResultsDirectory results(out);
  results_are_in(results.path().string());
  std::optional<FrameWriter> writer = frame_writer(scene, results);
  Run run =
      watched(scene, model, writer, options, [&](const Listeners& listeners) { return kinematics(scene, model, assembly, listeners); });
  if (run.status == Status::interrupted) run.reason = stopped_by();
  const auto write = [&] {
    if (writer) writer->finish();
    write_kinematics(results.path(), scene, model, run);
  };
  finish_run(results, run, write, [&] { write_text(results.path() / "kinematics.json", kinematics_json(scene, model, run)); });

  if (options.json)
    std::cout << kinematics_json(scene, model, run);
  else if (!options.quiet)
    print(scene, run, run_rows(run), out);
  return exit_code(options, scene, run);
}

int inverse(const Options& options) {
  const Scene scene = with_pieces(read_scene(options.scene, overrides(options)));
  require_run(scene);
  const fs::path out = results_directory(options, "-inverse");
  require_place(out);
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);

  handle_signals();
  tell_leftovers(options, out);
  ResultsDirectory results(out);
  results_are_in(results.path().string());
  std::optional<FrameWriter> writer = frame_writer(scene, results);
  Inverse found =
      watched(scene, model, writer, options, [&](const Listeners& listeners) { return inverse(scene, model, assembly, listeners); });
  if (found.run.status == Status::interrupted) found.run.reason = stopped_by();
  const auto write = [&] {
    if (writer) writer->finish(drawn_impacts(found.run.impacts));
    write_inverse(results.path(), scene, model, assembly, found);
  };
  finish_run(results, found.run, write, [&] { write_text(results.path() / "inverse.json", inverse_json(scene, model, found)); });

  if (options.json) {
    std::cout << inverse_json(scene, model, found);
  } else if (!options.quiet) {
    Rows rows{{"found", found.how}};
    for (std::size_t d = 0; d < found.drivers.size(); ++d)
      rows.emplace_back((found.drivers[d].turns ? "torque of " : "thrust of ") + found.drivers[d].name, effort_text(found, d, out));
    const Rows more = run_rows(found.run);
    rows.insert(rows.end(), more.begin(), more.end());
    print(scene, found.run, rows, out);
  }
  return exit_code(options, scene, found.run);
}

}  // namespace pintle::app
