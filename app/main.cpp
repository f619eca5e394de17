// The command line. Thin: nothing here that a user of the library lacks.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "framework/run/results.h"
#include "framework/scene/reader.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle;

enum Exit { ok = 0, trouble = 1, bad_scene = 2, no_assembly = 3, run_failed = 4, ledger_over = 5, stopped = 6 };

constexpr const char* exit_codes =
    "Exit codes\n"
    "  0  done\n"
    "  1  a file or directory cannot be read or written\n"
    "  2  the scene or the command line is wrong\n"
    "  3  the mechanism cannot be assembled, or a joint in it is redundant\n"
    "  4  the integration failed; what was computed is kept\n"
    "  5  the ledger leaves more energy unexplained than the scene's bound; the results are kept\n"
    "  6  stopped by the user (Ctrl-C); what was computed is kept\n"
    "\n"
    "A scene is a YAML file; docs/scene.md has its language, examples/ has scenes to start from:\n"
    "  pintle check examples/slider_crank_clearance.yaml\n"
    "  pintle run examples/slider_crank_clearance.yaml --set clearance=0.1mm --out worn\n"
    "  paraview worn/mechanism.pvd\n";

constexpr const char* what_it_writes =
    "It writes\n"
    "  trajectory.csv   motion of each body, force of each joint, eccentricity and contact of each clearance\n"
    "  ledger.csv       each energy, loss and work against time, and what none of them explains\n"
    "  events.csv       an impact a row: begin, end, speeds, deepest penetration, peak force, energy lost\n"
    "  run.json         the scene with every value filled in, status, counts, timings\n"
    "  mechanism.pvd    the animation for ParaView, with frames/*.vtu, if the scene asks for frames\n"
    "Exit codes: see pintle --help\n";

volatile std::sig_atomic_t interrupted = 0;
extern "C" void interrupt(int) { interrupted = 1; }

struct Options {
  std::string scene, out;
  std::vector<std::string> set;
  bool quiet = false, json = false;
};

Overrides overrides(const Options& options) {
  Overrides out;
  for (const std::string& s : options.set) {
    const auto equals = s.find('=');
    if (equals == std::string::npos || equals == 0)
      throw SceneError("--set " + s + ": write it as NAME=VALUE, for example --set clearance=0.1mm");
    out.emplace_back(s.substr(0, equals), s.substr(equals + 1));
  }
  return out;
}

std::string number(double x, int digits = 6) {
  std::ostringstream s;
  s << std::setprecision(digits) << x;
  return s.str();
}

/// A table of two columns, printed with the second aligned.
void print_rows(std::ostream& out, const std::vector<std::pair<std::string, std::string>>& rows) {
  std::size_t width = 0;
  for (const auto& row : rows) width = std::max(width, row.first.size());
  for (const auto& [left, right] : rows)
    out << "  " << std::left << std::setw(static_cast<int>(width) + 2) << left << right << "\n";
}

/// results/NAME, or results/NAME-2, … : never over something that is there.
fs::path free_directory(const fs::path& scene) {
  const fs::path base = fs::path("runs") / scene.stem();
  fs::path path = base;
  for (int k = 2; fs::exists(path); ++k) path = base.string() + "-" + std::to_string(k);
  return path;
}

void print_check(const Scene& scene, const Model& model, const Assembly& a) {
  const System& s = model.system;
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  print_rows(std::cout,
             {{"bodies", std::to_string(s.bodies.size()) + " rigid, " + std::to_string(s.n()) + " coordinates"},
              {"constraint rows", std::to_string(s.n_rows()) + ", rank " + std::to_string(a.rank) +
                                      (a.redundant.empty() ? "" : ", " + std::to_string(s.n_rows() - a.rank) + " redundant")},
              {"mobility", std::to_string(s.n() - a.rank)},
              {"clearance joints", s.contacts.empty() ? "none" : std::to_string(s.contacts.size())},
              {"forces", s.forces.empty() ? "none" : std::to_string(s.forces.size())},
              {"gravity", s.gravity.isZero() ? "off" : number(s.gravity.x()) + ", " + number(s.gravity.y()) + " m/s^2"},
              {"ledger integrals", std::to_string(s.n_z())},
              {"scheme", std::string(model.scheme.tableau->name) + ", tolerance " + number(model.scheme.tolerance) +
                             ", constraints by " + scene.run.constraints},
              {"constraint equations", s.n_rows() > Schur::dense_rows ? "sparse (CHOLMOD)" : s.n_rows() > 0 ? "dense" : "none"},
              {"assembly", "closed in " + std::to_string(a.iterations) + " iterations, worst coordinate moved by " + number(a.moved, 3)}});
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    const ContactPair& p = s.contacts[c];
    std::cout << "  clearance at \"" << s.contact_names[c] << "\": " << number(p.gap.clearance()) << " m, stiffness "
              << number(p.normal.k) << " N/m^" << number(p.normal.n) << ", restitution delivered "
              << number(effective_restitution(p.normal.chi), 4)
              << (p.friction ? ", friction " + number(p.friction->mu) : ", no friction") << "\n";
  }
}

void print_run(const Scene& scene, const Model& model, const Run& run, const fs::path& out) {
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  std::vector<std::pair<std::string, std::string>> rows{
      {"time reached", number(run.t_end) + " s"},
      {"energy at start", number(run.first.stored(), 9) + " J"},
      {"energy at end", number(run.last.stored(), 9) + " J"}};
  const System& s = model.system;
  for (int i = 0; i < s.n_z() && run.ledger.rows() > 0; ++i)
    rows.emplace_back("  " + integral_name(s, s.integrals[static_cast<std::size_t>(i)]),
                      number(run.ledger.data[(run.ledger.rows() - 1) * run.ledger.columns() + 6 + static_cast<std::size_t>(i)]) + " J");
  for (std::size_t c = 0; c < s.contacts.size(); ++c) {
    long begun = 0, ended = 0;
    double deepest = 0, force = 0;
    for (const Impact& i : run.impacts)
      if (i.contact == static_cast<int>(c)) {
        ++begun;
        ended += std::isnan(i.end) ? 0 : 1;
        deepest = std::max(deepest, i.deepest);
        force = std::max(force, i.peak_force);
      }
    rows.emplace_back("contacts at " + s.contact_names[c],
                      std::to_string(begun) + (begun > ended ? " (the last goes on)" : "") + ", peak force " +
                          number(force, 4) + " N, deepest " + number(deepest, 4) + " m");
  }
  rows.emplace_back("steps", std::to_string(run.counts.steps) + " (" + std::to_string(run.counts.rejected) + " rejected), " +
                                 std::to_string(run.counts.evaluations) + " evaluations in " + number(run.seconds, 3) + " s");
  rows.emplace_back("constraints held to", number(run.worst_position, 2) + " in position, " + number(run.worst_velocity, 2) + " in speed (scaled)");
  rows.emplace_back("results", out.string() + (scene.output.frames > 1 ? ", animation " + (out / "mechanism.pvd").string() : ""));
  print_rows(std::cout, rows);
  for (const std::string& w : run.warnings) std::cout << "  warning: " << w << "\n";
  std::cout << "  " << status_text(run.status) << (run.reason.empty() ? "" : ": " + run.reason) << "\n";
  std::cout << "  unexplained energy: " << number(run.unexplained, 3) << " J, "
            << number(run.energy_in_play > 0 ? std::abs(run.unexplained) / run.energy_in_play : 0, 3)
            << " of the energy in play\n";
}

/// A line on the terminal that says how far the run is; nothing if stderr is not one.
class Progress {
 public:
  Progress(double until, bool quiet) : until_(until), on_(!quiet && ::isatty(STDERR_FILENO)) {}
  ~Progress() {
    if (shown_) std::cerr << "\r\033[K" << std::flush;
  }
  bool operator()(double t) {
    const auto now = std::chrono::steady_clock::now();
    if (on_ && now - last_ > std::chrono::milliseconds(200)) {
      last_ = now;
      shown_ = true;
      std::cerr << "\r  " << std::fixed << std::setprecision(1) << 100 * t / until_ << " %  t = " << std::defaultfloat
                << std::setprecision(6) << t << " s\033[K" << std::flush;
    }
    return !interrupted;
  }

 private:
  double until_;
  bool on_, shown_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

int check(const Options& options) {
  const Scene scene = read_scene(options.scene, overrides(options));
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  if (options.json)
    std::cout << check_json(scene, model, assembly);
  else
    print_check(scene, model, assembly);
  refuse_redundancy(scene, model, assembly);
  return ok;
}

int run(const Options& options) {
  const Scene scene = read_scene(options.scene, overrides(options));
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  refuse_redundancy(scene, model, assembly);

  const fs::path out = options.out.empty() ? free_directory(options.scene) : fs::path(options.out);
  ResultsDirectory results(out);
  FrameWriter writer(results.path());
  const Drafting drafting(scene, model);
  Progress progress(scene.run.until, options.quiet);
  std::signal(SIGINT, interrupt);
  std::signal(SIGTERM, interrupt);
  Listeners listeners;
  listeners.progress = [&](double t) { return progress(t); };
  if (scene.output.frames > 1)
    listeners.frame = [&](const State& state, const Equations& eq) { writer.add(draw(model, drafting, state, eq)); };
  const Run result = simulate(scene, model, assembly, listeners);
  if (scene.output.frames > 1) writer.finish();
  write_results(results.path(), scene, model, assembly, result);
  results.commit();

  if (options.json)
    std::cout << run_json(scene, model, assembly, result);
  else if (!options.quiet)
    print_run(scene, model, result, out);
  if (result.status != Status::finished && (options.quiet || options.json))
    std::cerr << scene.file << ": " << status_text(result.status) << ": " << result.reason << "\n";
  switch (result.status) {
    case Status::finished: return ok;
    case Status::failed: return run_failed;
    case Status::interrupted: return stopped;
    case Status::ledger_over_bound: return ledger_over;
  }
  return trouble;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Planar mechanisms with real joints: from a scene file to an energy ledger, time series and a ParaView "
               "animation.", "pintle");
  app.set_version_flag("--version", std::string("pintle ") + PINTLE_VERSION);
  app.require_subcommand(1);
  app.footer(exit_codes);
  Options options;
  auto* run_command = app.add_subcommand("run", "Run a scene and write its results");
  auto* check_command = app.add_subcommand("check", "Say what a scene holds and requires, and run nothing");
  for (auto* command : {run_command, check_command}) {
    command->add_option("scene", options.scene, "scene file (YAML)")->required()->type_name("SCENE.yaml");
    command->add_option("--set", options.set, "override a parameter of the scene, e.g. --set clearance=0.1mm; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUE");
    command->add_flag("--json", options.json, "print JSON instead of text");
  }
  run_command->add_option("-o,--out", options.out, "directory for the results; it must not exist (default: runs/SCENE, numbered)")->type_name("DIR");
  run_command->footer(what_it_writes);
  run_command->add_flag("-q,--quiet", options.quiet, "print nothing but errors");
  try {
    app.parse(argc, argv);
    const int exit = run_command->parsed() ? run(options) : check(options);
    if (!std::cout.flush()) throw std::runtime_error("what there was to print could not be written to standard output");
    return exit;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? ok : bad_scene;
  } catch (const SceneError& e) {
    std::cerr << "pintle: " << e.what() << "\n";
    return bad_scene;
  } catch (const AssemblyError& e) {
    std::cerr << "pintle: " << e.what() << "\n";
    return no_assembly;
  } catch (const std::exception& e) {
    std::cerr << "pintle: " << e.what() << "\n";
    return trouble;
  }
}
