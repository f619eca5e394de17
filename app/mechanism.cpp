// The command run.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/options.h"
#include "app/frame_count.h"
#include "app/other_programs.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/run_end.h"
#include "framework/analysis/simulate/identity.h"
#include "framework/analysis/simulate/run_warnings.h"
#include "framework/bodies/segments.h"
#include "framework/common/some_of.h"
#include "framework/build/build.h"
#include "framework/output/results.h"
#include "framework/output/room.h"
#include "framework/output/run_files.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

/// "3 (the last has not ended), peak force 20 N, deepest 1e-06 m"; for rigid surfaces, an impulse instead of a depth.
std::string contacts_text(const ContactPair& pair, int first, const std::vector<Impact>& impacts) {
  long begun = 0, ended = 0;
  double deepest = 0, force = 0, impulse = 0;
  for (const Impact& i : impacts) {
    if (i.contact < first || i.contact >= first + pair.pairs) continue;
    ++begun;
    ended += std::isnan(i.end) ? 0 : 1;
    deepest = std::max(deepest, i.deepest);
    force = std::max(force, i.peak_force);
    impulse = std::max(impulse, i.impulse);
  }
  return std::to_string(begun) + (begun > ended ? " (the last has not ended)" : "") + ", peak force " + number(force, 4) + " N, " +
         (is_rigid(pair) ? "greatest impulse " + number(impulse, 4) + " N s" : "deepest " + number(deepest, 4) + " m");
}

/// The first and last actions of events.
void add_happenings(const Run& run, Rows& rows) {
  constexpr std::size_t most = 8;
  const auto& all = run.happenings;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all.size() > most && k == most / 2) {
      rows.emplace_back("  …", std::to_string(all.size() - most) + " more events, all in actions.csv");
      k = all.size() - most / 2;
    }
    rows.emplace_back("event " + all[k].event, number(all[k].t, 9) + " s: " + all[k].did);
  }
}

void add_never_came(const Scene& scene, const Run& run, Rows& rows) {
  if (const std::vector<std::string> names = never_came(scene, run); !names.empty())
    rows.emplace_back("events that never came", some_of(names, false));
}

void print_run(const Scene& scene, const Model& model, const Run& run, const fs::path& out) {
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  Rows rows{{"time reached", number(run.t_end) + " s"},
            {"energy at start", number(run.first.stored(), 9) + " J"},
            {"energy at end", number(run.last.stored(), 9) + " J"}};
  for (const FlexibleReport& r : model.flexible)
    if (r.choice) rows.emplace_back("modes of " + r.body, r.choice->reason);
  const System& s = model.system;
  for (std::size_t i = 0; i < run.integrals.size(); ++i) {
    const Integral& integral = s.integrals[i];
    const double booked = run.integrals[i];
    const bool may_be_none = integral.account == Account::scheme || integral.account == Account::switching;
    if (may_be_none && booked == 0) continue;  // the scheme did not become implicit, or no switch acted
    rows.emplace_back("  " + integral_name(s, integral), number(booked) + " J");
  }
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    if (is_held(s.contacts[c])) {
      rows.emplace_back("massless link at " + s.contact_names[c],
                        "force at the outputs from " + number(run.links[c].least, 4) + " to " + number(run.links[c].greatest, 4) + " N");
      continue;
    }
    if (s.contacts[c].pair > 0) continue;
    rows.emplace_back("contacts at " + s.contact_names[c], contacts_text(s.contacts[c], static_cast<int>(c), run.impacts));
  }
  add_happenings(run, rows);
  add_never_came(scene, run, rows);
  rows.emplace_back("method", model.scheme.reason + (run.switched.empty() ? "" : "; then " + run.switched));
  rows.emplace_back("steps", std::to_string(run.counts.steps) + " (" + std::to_string(run.counts.rejected) + " rejected), " +
                                 std::to_string(run.counts.evaluations) + " evaluations in " + number(run.seconds, 3) + " s");
  rows.emplace_back("constraints held to",
                    number(run.worst_position, 2) + " in position, " + number(run.worst_velocity, 2) + " in speed (scaled)");
  if (run.status != Status::not_written)
    rows.emplace_back("results", out.string() + (scene.output.frames > 1 ? ", animation " + (out / "mechanism.pvd").string() : ""));
  print_rows(std::cout, rows);
  for (const std::string& w : run.warnings) std::cout << "  warning: " << w << "\n";
  std::cout << "  " << status_text(run.status) << (run.reason.empty() ? "" : ": " + run.reason) << "\n";
  const bool checked = run.status == Status::finished || run.status == Status::ledger_over_bound;
  std::cout << "  unexplained energy" << (checked ? "" : " so far") << ": " << number(run.unexplained, 3) << " J, "
            << number(run.energy_in_play > 0 ? std::abs(run.unexplained) / run.energy_in_play : 0, 3) << " of the energy in play"
            << (checked ? "" : "; not checked, because the run has not finished") << "\n";
}

Scene runnable(const Options& options) {
  Scene scene = read_scene(options.scene, overrides(options));
  require_run(scene);
  return scene;
}

/// Output of `run` during the run and at its end.
class Recording {
 public:
  Recording(const fs::path& directory, const Scene& scene, const Model& model, const Assembly& assembly)
      : directory_(directory),
        scene_(scene),
        model_(model),
        assembly_(assembly),
        identity_(identity(scene, model, assembly)),
        files_(directory, scene, model),
        kept_for_report_(directory / "run.json", least_room + 4 * scene.filled_in.size()) {
    files_.flush();  // even if the run is killed, the files have headings and name the scene
    write_text(directory_ / "run.json", begun_json(scene));
    if (scene.output.frames < 2) return;
    writer_.emplace(directory);
    drafting_.emplace(scene, model);
  }

  Listeners listeners() {
    Listeners out;
    out.rows = [this](const Table& trajectory, const Table& ledger, const std::vector<Impact>& impacts,
                      const std::vector<Happening>& happenings) { files_.add(trajectory, ledger, impacts, happenings); };
    out.state = [this](const SavedState& state) { add(state); };
    if (writer_) out.frame = [this](const State& state, const Equations& eq) { writer_->add(draw(model_, *drafting_, state, eq)); };
    return out;
  }
  void finish(const Run& run) {
    if (writer_) writer_->finish(drawn_impacts(run.impacts));
    files_.finish(run.impacts, run.happenings);
  }
  void report(const Run& run) {
    kept_for_report_.release();
    write_text(directory_ / "run.json", run_json(scene_, model_, assembly_, run));
  }

 private:
  static constexpr std::size_t least_room = std::size_t{1} << 16;

  void add(const SavedState& state) {
    files_.flush();  // write rows first, in case the disk becomes full
    std::ostringstream name;
    name << std::setw(5) << std::setfill('0') << ++saved_ << ".state";
    std::error_code error;
    fs::create_directories(directory_ / "states", error);
    if (error) throw FileError(directory_ / "states", error.value(), "cannot be made");
    write_text(directory_ / "states" / name.str(), state_text(identity_, state));
  }

  const fs::path directory_;
  const Scene& scene_;
  const Model& model_;
  const Assembly& assembly_;
  const std::string identity_;  ///< identity to which saved states belong
  RunFiles files_;
  ReservedRoom kept_for_report_;
  std::optional<FrameWriter> writer_;
  std::optional<Drafting> drafting_;
  int saved_ = 0;
};

std::optional<SavedState> saved_state(const Options& options, const Scene& scene, const Model& model, const Assembly& assembly) {
  if (options.restart.empty()) return {};
  SavedState from = read_state(options.restart, scene, model, assembly);
  if (from.t >= scene.run.until)
    throw SceneError("--restart " + options.restart + ": was saved at " + number(from.t, 9) + " s, but the run of " + scene.file +
                     " ends no later than this; increase run.until");
  return from;
}

/// Writes the results in further forms, if options request them: a page, an HDF5 file. @returns the exit code
int write_other_forms(const Options& options, const fs::path& out) {
  const auto tell = [&](const char* what, const fs::path& file) {
    if (!options.quiet && !options.json) std::cout << "  " << what << ": " << file.string() << "\n";
  };
  if (options.report) {
    write_report(out, out / "report.html", options.megabytes, options.quiet);
    tell("report", out / "report.html");
  }
  if (!options.hdf5) return ok;
  now_doing("writing the HDF5 file");
  const int exit = write_hdf5(out);
  if (exit == ok) tell("HDF5", out / "results.h5");
  return exit;
}

}  // namespace

int run(const Options& options) {
  if (options.hdf5) require_hdf5();
  now_doing("reading the scene");
  Scene scene = with_pieces(runnable(options));
  const FrameCount frames(scene);
  const fs::path out = results_directory(options);
  require_place(out);
  now_doing("building the model");
  Model model = build(scene);
  frames.fit(model, scene);
  const Assembly assembly = assemble(scene, model);
  const std::optional<SavedState> from = saved_state(options, scene, model, assembly);
  for (std::string& warning : validate_room(out, room_needed(scene, model, from ? from->t : 0), room_at(out)))
    model.warnings.push_back(std::move(warning));

  now_doing("running the scene");
  Progress progress(scene.run.until, options.quiet);
  tell_leftovers(options, out);
  ResultsDirectory results(out);
  results_are_in(results.path().string());
  Recording recording(results.path(), scene, model, assembly);
  Listeners listeners = recording.listeners();
  listeners.progress = [&](double t) { return progress(t); };
  Run result = simulate(scene, model, assembly, listeners, from ? &*from : nullptr);
  if (result.status == Status::interrupted) result.reason = stopped_by();
  now_doing("writing the results");
  const auto report = [&] { recording.report(result); };
  const auto write = [&] { recording.finish(result), report(); };
  finish_run(results, result, write, report);

  if (options.json)
    std::cout << run_json(scene, model, assembly, result);
  else if (!options.quiet)
    print_run(scene, model, result, out);
  const int exit = exit_code(options, scene, result);
  if (result.status == Status::not_written) return exit;
  const int other = write_other_forms(options, out);
  return other == ok ? exit : other;
}

}  // namespace pintle::app
