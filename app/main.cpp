// The command line. It contains little code: a user of the library can do everything that it does.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <new>

#include "app/command_options.h"
#include "app/failure.h"
#include "app/options.h"
#include "app/mistyped.h"
#include "app/progress.h"
#include "framework/common/library_threads.h"

namespace {

using namespace pintle;
using namespace pintle::app;

constexpr const char* exit_codes =
    "Exit codes\n"
    "  0  done\n"
    "  1  results cannot be read or written, or there is not enough memory; what was computed is kept, and its place is named\n"
    "  2  the command line, a scene, a study or a file that they name is wrong, missing or unreadable\n"
    "  3  the mechanism cannot be assembled\n"
    "  4  the integration failed (check: in the trial run; sweep and nonlinear: in every case; sensitivity: in at least one case);\n"
    "     nonlinear: too few returns at every value; tradeoff: no setting was shown to reach the requested accuracy; fit: the goal\n"
    "     or a limit was not met; what was computed is kept\n"
    "  5  the energy-balance error exceeds the bound of the scene; the results are kept\n"
    "  6  stopped by the user (Ctrl-C), SIGTERM or SIGHUP; what was computed is kept. A second signal, 0.5 s or more later, ends the\n"
    "     program at once\n"
    "\n"
    "A scene is a YAML file; docs/scene.md describes the format, examples/ has scenes to start from:\n"
    "  pintle check examples/slider_crank_clearance.yaml\n"
    "  pintle run examples/slider_crank_clearance.yaml --set clearance=0.1mm --out worn\n"
    "  pintle report worn        (worn/report.html, for any browser)\n"
    "  pintle film worn worn.mp4\n"
    "  paraview worn/mechanism.pvd\n"
    "  pintle modes examples/modes_eye_bar.yaml --count 8\n";

int carry_out(int argc, char** argv) {
  CLI::App app(
      "Planar mechanisms with real joints: from a scene file to an energy ledger, time series and a ParaView "
      "animation; modes and statics of their bodies.",
      "pintle");
  app.set_version_flag("--version", std::string("pintle ") + PINTLE_VERSION);
  app.require_subcommand(1);
  app.footer(exit_codes);
  Options options;
  const std::map<CLI::App*, int (*)(const Options&)> commands{
      {app.add_subcommand("run", "Run a scene and write its results"), run},
      {app.add_subcommand("check", "Say what a scene contains and requires, and what its run will cost"), check},
      {app.add_subcommand("statics", "Find the equilibrium of a whole mechanism, and the joint forces there"), equilibrium},
      {app.add_subcommand("kinematics", "Move a mechanism by its drivers alone; no masses needed"), kinematics},
      {app.add_subcommand("inverse", "Find the driving torques and joint forces of a driven mechanism"), inverse},
      {app.add_subcommand("linearize", "Find natural frequencies, damping and state-space matrices about a state"), linearize},
      {app.add_subcommand("sweep", "Run many cases of a scene into one table, by threads, MPI or a job array"), sweep},
      {app.add_subcommand("merge", "Join the parts of a sweep into one table"), merge},
      {app.add_subcommand("fit", "Find parameters that reach a goal, within limits"), fit},
      {app.add_subcommand("sensitivity", "Find how measures depend on parameters and their tolerances"), sensitivity},
      {app.add_subcommand("nonlinear", "Find Poincare sections, bifurcation diagrams and Lyapunov exponents"), nonlinear},
      {app.add_subcommand("tradeoff", "Measure error against time over settings of fidelity, and recommend one"), tradeoff},
      {app.add_subcommand("report", "Turn the results of a run into one page: motion, plots, impacts, ledger"), report},
      {app.add_subcommand("plot", "Plot columns of results in the terminal, or as a picture (SVG, PNG, PDF)"), plot},
      {app.add_subcommand("film", "Make a film of a run: MP4, WebM or GIF"), film},
      {app.add_subcommand("picture", "Draw a frame of a run, or a field of a body, as a picture"), picture},
      {app.add_subcommand("view", "Show a scene in the browser while it is being written; move it by hand"), view},
      {app.add_subcommand("fmu", "Export a scene as a co-simulation unit for other programs (FMI 3.0)"), fmu},
      {app.add_subcommand("hdf5", "Turn the tables of results into one HDF5 file"), hdf5},
      {app.add_subcommand("modes", "Find the natural frequencies and mode shapes of one body of elements"), modes},
      {app.add_subcommand("static",
                          "Solve the static load case of one body of elements, or of several in contact (for a whole mechanism: statics)"),
       statics},
      {app.add_subcommand("mesh", "Mesh one body of elements and check the mesh quality"), mesh}};
  for (const auto& [command, unused] : commands) add_options(*command, options);
  const bool passed_on = argc > 1 && is_passed_on(argv[1]);
  if (passed_on) options.passed_on.assign(argv + 2, argv + argc);
  try {
    app.parse(passed_on ? 2 : argc, argv);
  } catch (const CLI::ParseError& e) {
    return end_of(app, e, argc, argv);
  }
  now_doing("reading the input");
  set_bounds(options);
  CLI::App* const command = app.get_subcommands().front();
  const std::string name = command->get_name();
  if (name != "modes" && name != "static" && name != "mesh") hold_library_threads();  // results must not depend on the number of cores
  const int exit = commands.at(command)(options);
  if (std::cout.flush()) return exit;
  std::cerr << "pintle: the output could not be written to standard output\n";
  return exit == ok ? trouble : exit;
}

/// Called if memory is so short that an error cannot be reported normally.
[[noreturn]] void end_without_memory() {
  try {
    if (const std::exception_ptr e = std::current_exception()) std::rethrow_exception(e);
  } catch (const std::bad_alloc&) {
    report_lack_of_memory();
    std::_Exit(trouble);
  } catch (...) {
  }
  std::fprintf(stderr, "pintle: ended by an error in the program while %s%s\n", what_is_done(), where_results_are());
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  tell_of_crashes();
  keep_memory_in_reserve();
  std::set_terminate(end_without_memory);
  return run_program(argc, argv, carry_out);
}
