// Commands on driven mechanisms: kinematics and inverse.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "app/options.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/run_end.h"
#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/output/results.h"
#include "framework/output/run_files.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// Output of a driven motion during it: its tables, and frames if the scene requests any.
class Recording {
 public:
  Recording(const fs::path& directory, const Scene& scene, const Model& model)
      : directory_(directory),
        scene_(scene),
        model_(model),
        kept_for_report_(directory / "run.json", least_room + 4 * scene.filled_in.size()) {
    write_text(directory_ / "run.json", begun_json(scene));  // remains if the program is killed
    if (scene.output.frames > 1) writer_.emplace(directory), drafting_.emplace(scene, model);
  }

  /// compute(listeners) with a progress display.
  template <class Compute>
  auto watch(const Options& options, Compute compute) {
    now_doing("computing the motion");
    Listeners listeners;
    listeners.rows = [this](const Table& trajectory, const Table& ledger, const std::vector<Impact>& impacts,
                            const std::vector<Happening>& happenings) { add(trajectory, ledger, impacts, happenings); };
    if (writer_) listeners.frame = [this](const State& state, const Equations& eq) { writer_->add(draw(model_, *drafting_, state, eq)); };
    Progress progress(scene_.run.until, options.quiet);
    listeners.progress = [&](double t) { return progress(t); };
    return compute(listeners);
  }
  void finish(const Run& run) {
    if (writer_) writer_->finish(drawn_impacts(run.impacts));
    begin(run.trajectory, run.ledger);
    if (files_) files_->finish(run.impacts, run.happenings);
    if (trajectory_) trajectory_->close();
  }
  /// Makes room for reports, and removes the one of a motion that has not ended.
  void release() {
    kept_for_report_.release();
    std::error_code error;
    fs::remove(directory_ / "run.json", error);
  }

 private:
  static constexpr std::size_t least_room = std::size_t{1} << 16;

  /// Algebra has no ledger and no impacts.
  void begin(const Table& trajectory, const Table& ledger) {
    if (files_ || trajectory_) return;
    if (ledger.columns() > 0) return files_.emplace(directory_, scene_, model_).flush();
    trajectory_.emplace(directory_ / "trajectory.csv").append(csv_heading(trajectory));
    trajectory_->flush();
  }
  void add(const Table& trajectory, const Table& ledger, const std::vector<Impact>& impacts, const std::vector<Happening>& happenings) {
    begin(trajectory, ledger);
    if (files_) return files_->add(trajectory, ledger, impacts, happenings);
    for (std::size_t r = 0; r < trajectory.rows(); ++r) {
      row_.clear();
      append_csv_row(row_, trajectory, r);
      trajectory_->append(row_);
    }
  }

  const fs::path directory_;
  const Scene& scene_;
  const Model& model_;
  ReservedRoom kept_for_report_;
  std::optional<FileWriter> trajectory_;
  std::optional<RunFiles> files_;
  std::optional<FrameWriter> writer_;
  std::optional<Drafting> drafting_;
  std::string row_;
};

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

/// Writes a page of the results if there are some and it is asked for.
int ended(const Options& options, const Scene& scene, const Run& run, const fs::path& out) {
  if (options.report && run.status != Status::not_written) {
    write_report(out, out / "report.html", options.megabytes, options.quiet);
    if (!options.quiet && !options.json) std::cout << "  report: " << (out / "report.html").string() << "\n";
  }
  return exit_code(options, scene, run);
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
  Recording recording(results.path(), scene, model);
  Run run = recording.watch(options, [&](const Listeners& listeners) { return kinematics(scene, model, assembly, listeners); });
  if (run.status == Status::interrupted) run.reason = stopped_by();
  const auto report = [&] {
    recording.release();
    write_text(results.path() / "kinematics.json", kinematics_json(scene, model, run));
  };
  const auto write = [&] {
    recording.finish(run);
    report();
  };
  finish_run(results, run, write, report);

  if (options.json)
    std::cout << kinematics_json(scene, model, run);
  else if (!options.quiet)
    print(scene, run, run_rows(run), out);
  return ended(options, scene, run, out);
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
  Recording recording(results.path(), scene, model);
  Inverse found = recording.watch(options, [&](const Listeners& listeners) { return inverse(scene, model, assembly, listeners); });
  if (found.run.status == Status::interrupted) found.run.reason = stopped_by();
  const auto write = [&] {
    recording.finish(found.run);
    recording.release();
    if (!found.by_algebra) write_text(results.path() / "run.json", run_json(scene, model, assembly, found.run));
    write_efforts(results.path(), scene, model, found);
  };
  const auto report = [&] {
    recording.release();
    write_text(results.path() / "inverse.json", inverse_json(scene, model, found));
  };
  finish_run(results, found.run, write, report);

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
  return ended(options, scene, found.run, out);
}

}  // namespace pintle::app
