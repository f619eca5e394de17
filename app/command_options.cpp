#include "app/command_options.h"
#include "framework/common/file_names.h"

#include <charconv>

namespace pintle::app {

namespace {

constexpr const char* what_it_writes =
    "It writes\n"
    "  trajectory.csv   motion of each body, force of each joint, eccentricity and contact of each clearance\n"
    "  ledger.csv       each energy, loss and work over time, and the energy that none of them explains\n"
    "  actions.csv      what the events of the scene did, and when\n"
    "  events.csv       one row per impact: begin, end, speeds, deepest penetration, peak force, energy lost\n"
    "  run.json         the scene with every value filled in, status, counts, timings\n"
    "  mechanism.pvd    the animation for ParaView, with frames/*.vtu; mechanism.py shows it\n"
    "Exit codes: see pintle --help\n";

constexpr const char* what_statics_writes =
    "Finds the equilibrium of the whole mechanism, with drivers held and loads as at that time. For the stresses of one\n"
    "body under given loads see pintle static. It writes\n"
    "  statics.csv, .json   pose of each body, force of each joint, torque or force of each driver, contacts, loads\n"
    "  mechanism.pvd        the mechanism at equilibrium, for ParaView\n"
    "Exit code 4: there is no equilibrium, or none was found. Others: see pintle --help\n";

constexpr const char* what_kinematics_writes =
    "Every degree of freedom must have a driver. Bodies need no mass; bodies with modes stay rigid. It writes\n"
    "  trajectory.csv    position, speed and acceleration of each body and of output.points\n"
    "  kinematics.json   the scene with every value filled in, status, counts\n"
    "  mechanism.pvd     the animation for ParaView, if the scene asks for frames\n"
    "Exit codes: see pintle --help\n";

constexpr const char* what_inverse_writes =
    "Solves rigid, fully driven mechanisms algebraically. With flexible bodies, clearances or free motions it integrates in\n"
    "time, with the drivers as constraints. It writes\n"
    "  trajectory.csv   motion of each body, force of each joint, torque or force of each driver\n"
    "  DRIVER.csv       t and torque (or thrust) of each driver, a table that a force of a scene can follow\n"
    "  inverse.json     the scene with every value filled in, status, counts, extremes\n"
    "  mechanism.pvd    the animation for ParaView, if the scene asks for frames\n"
    "Exit codes: see pintle --help\n";

constexpr const char* what_linearize_writes =
    "Linearizes the motion about a state. Contacts that are closed there count with the slope of their laws. It writes\n"
    "  linearized.csv, .json   frequency, damping ratio, decay, root of each mode, and the part that moves most\n"
    "  shapes.csv              the shapes, coordinate by coordinate\n"
    "  mode_motions.csv        where the bodies are in each mode, enlarged, through a period; pintle report shows it\n"
    "  A.csv B.csv C.csv D.csv x' = A x + B u, y = C x + D u, states, inputs and outputs named\n"
    "  mode_01/mechanism.pvd … with --frames, an animation of each mode for ParaView\n"
    "docs/linearize.md explains each of them. Exit codes: see pintle --help\n";

constexpr const char* what_modes_writes =
    "The body is held by its supports; without supports it is free. It writes\n"
    "  modes.csv, modes.json   frequency, effective mass, damping ratio, residual of each mode\n"
    "  modes.vtu               every mode shape as a vector field, with its modal von Mises stress\n"
    "  mode_01.pvd, …          an animation of each mode for ParaView\n"
    "  drawing.json            the drawing of the first 12 for pintle report\n"
    "  reduced.*, reduced_01…  the same for the reduced body, if the scene gives it `modes`\n"
    "Exit codes: see pintle --help\n";

constexpr const char* what_sweep_writes =
    "A study names a scene, what is measured and what is varied; docs/studies.md describes the format. It writes\n"
    "  sweep.csv               one row per case, the same for any number of workers\n"
    "  warnings.csv            warnings of cases, if there are any\n"
    "  sweep.json, timings.csv counts by status, extremes; time of each case\n"
    "  study.yaml, scene.yaml  what was run\n"
    "  journal-0.txt, …        cases as they end; after an interruption, the same command continues from there\n"
    "A failed case is a row with its reason. On many cores or machines: mpirun pintle sweep STUDY.yaml, one process\n"
    "per core, in a directory that all of them share. In a job array: --shard, then pintle merge.\n"
    "Exit codes: see pintle --help\n";

/// A whole number from 1, or another least, to `most`.
CLI::Validator whole(int least, int most) {
  return CLI::Validator(
      [=](const std::string& written) {
        int n = 0;
        const char* end = written.data() + written.size();
        const auto [stop, error] = std::from_chars(written.data(), end, n);
        if (error == std::errc() && stop == end && n >= least && n <= most) return std::string();
        return "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most) + ", not \"" + written + "\"";
      },
      "");
}

/// For files and folders: `--out ""` does not mean the default; it comes from an unset variable in a script.
CLI::Validator named() {
  return CLI::Validator(
      [](const std::string& path) {
        return path.empty() ? std::string("is empty; name a file or folder, or leave the option out") : std::string();
      },
      "");
}

/// A file with a fixed format, for which another ending of its name would be misleading. @param ending  ".html"   @param what  "a
/// report is one page of HTML"
CLI::Validator ends_in(const std::string& ending, const std::string& what) {
  return CLI::Validator(
      [ending, what](const std::string& path) {
        const std::filesystem::path file = path;
        std::filesystem::path other = file;
        return ending_of(file) == ending ? std::string()
                                         : "is " + path + ", but " + what + "; write " + other.replace_extension(ending).string();
      },
      "");
}

CLI::Validator is_picture() {
  return CLI::Validator(
      [](const std::string& path) {
        const std::string ending = ending_of(path);
        if (ending == ".svg" || ending == ".png" || ending == ".pdf") return std::string();
        return "is " + path + ", but a plot is written as .svg, .png or .pdf; write " +
               std::filesystem::path(path).replace_extension(".svg").string();
      },
      "");
}

/// Options common to sweeps and trade-offs: a study, overrides, the destination of results.
void add_study_options(CLI::App& command, Options& options, const std::string& study, const std::string& all, const std::string& out) {
  command.add_option("study", options.scene, study)->required()->check(named())->type_name("FILE.yaml");
  command.add_option("--set", options.set, "override a parameter or key of the scene in all " + all + "; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME|PATH=VALUE");
  command.add_flag("--json", options.json, "print JSON instead of text");
  command.add_option("-o,--out", options.out, out)->check(named())->type_name("DIR");
  command.add_flag("-q,--quiet", options.quiet, "print errors only");
}

constexpr const char* what_fit_writes =
    "A study names a scene, what may vary, a goal and limits; docs/studies.md describes the format. It writes\n"
    "  fit.csv                 every case that was tried, the same for any number of workers\n"
    "  fitted.yaml             the scene with the best values, ready to run\n"
    "  fit.json                the best values, how each search ended\n"
    "  path.csv                for a path: its points, and where the curve passes them\n"
    "  study.yaml, scene.yaml, journal-0.txt   as for sweep; after an interruption, the same command continues from there\n"
    "Exit code 4: nothing could be measured, no point meets the limits, or the goal is not within its tolerance; the output says\n"
    "which. Others: see pintle --help\n";

constexpr const char* what_sensitivity_writes =
    "A study names a scene, measures and parameters, and how the parameters scatter; docs/studies.md describes the format. It\n"
    "writes\n"
    "  sensitivity.csv         derivatives with their errors, worst case, scatter, Sobol indices with their intervals\n"
    "  sensitivity.json        the same, for programs\n"
    "  sweep.csv, …            the cases, as for sweep; after an interruption, the same command continues from there\n"
    "Exit code 4: a case did not run to its end, or a measure has no value in it. Others: see pintle --help\n";

constexpr const char* what_nonlinear_writes =
    "A study names a scene, a section through its motion or Lyapunov exponents, and optionally a parameter to vary; docs/nonlinear.md\n"
    "describes the format. It writes\n"
    "  section.csv             one row per return: its time and what was recorded\n"
    "  values.csv              one row per parameter value: period, impacts, exponents\n"
    "  lyapunov.csv            the estimates of the exponents over time\n"
    "  nonlinear.json          the same, for programs\n"
    "  section.svg             the section, or the diagram over the parameter, with the exponents below it\n"
    "  study.yaml, scene.yaml, journal-0.txt   as for sweep; after an interruption, the same command continues from there\n"
    "Exit code 4: the run failed for every parameter value. Others: see pintle --help\n";

constexpr const char* what_merge_writes =
    "All parts of one division are needed, in any order: the folders of pintle sweep STUDY --shard I/N for I = 1 … N. It writes what\n"
    "one pintle sweep STUDY would have written: sweep.csv, warnings.csv, sweep.json, timings.csv, curves/, study.yaml, scene.yaml,\n"
    "journal-0.txt.\n"
    "Nothing is written if a part is missing, doubled, unfinished, damaged, or of another study.\n"
    "Exit codes: see pintle --help\n";

void add_merge_options(CLI::App& command, Options& options) {
  command.add_option("parts", options.folders, "folders of all parts of a sweep")->required()->check(named())->type_name("DIR");
  command.add_option("-o,--out", options.out, "directory for the results; it must not exist")->required()->check(named())->type_name("DIR");
  command.add_flag("--json", options.json, "print JSON instead of text");
  command.add_flag("-q,--quiet", options.quiet, "print errors only");
  command.footer(what_merge_writes);
}

/// Only sweeps can be divided: other studies reject the option, and their help does not show it.
void refuse_shard(CLI::App& command, const std::string& why) {
  const std::string name = command.get_name();
  command
      .add_option_function<std::string>(
          "--shard", [=](const std::string& text) { throw SceneError("--shard " + text + ": " + name + " cannot be divided: " + why); })
      ->group("");
}

/// Options common to all studies of cases.
void add_sweep_options(CLI::App& command, Options& options) {
  const std::string name = command.get_name();
  add_study_options(
      command, options, "study file (YAML)", "cases",
      "directory for the results; if it holds an earlier session of this study, that session is continued (default: runs/STUDY-" + name +
          (name == "sweep" ? "; of a part: runs/STUDY-sweep-I-of-N)" : ")"));
  command
      .add_option("-t,--threads", options.threads, "cases that this process runs in parallel (default: the number of cores; under MPI 1)")
      ->type_name("N")
      ->check(whole(1, 4096));
  if (name == "sweep")
    command
        .add_option("--shard", options.shard,
                    "run only part I of N of the cases, in a folder of its own, e.g. 3/8: for job arrays; pintle merge joins the parts")
        ->type_name("I/N");
  else
    refuse_shard(command, name == "fit"           ? "each of its cases depends on those before; leave it out and use --threads"
                          : name == "sensitivity" ? "its results need all cases at once; leave it out and use --threads or mpirun"
                                                  : "its runs may begin where those before ended; leave it out and use --threads");
  command.footer(name == "sweep"       ? what_sweep_writes
                 : name == "fit"       ? what_fit_writes
                 : name == "nonlinear" ? what_nonlinear_writes
                                       : what_sensitivity_writes);
}

constexpr const char* what_tradeoff_writes =
    "A study names the axes of fidelity (docs/studies.md). For a scene alone they are derived from the scene: tolerance, scheme,\n"
    "models of its clearances, modes of its bodies. It writes\n"
    "  tradeoff.csv            one row per setting: times, values, errors, what dominates\n"
    "  tradeoff.svg, .md       error against time; the answers and the front as tables\n"
    "  tradeoff.json           all of it, with the reference and how the reference was verified\n"
    "  recommended.yaml        the scene with the recommended setting, ready to run\n"
    "Exit code 4: nothing is recommended, because no setting was shown to reach the requested error (or time); the output\n"
    "says what is missing and what would help. recommended.yaml is then not written. Others: see pintle --help\n";

void add_tradeoff_options(CLI::App& command, Options& options) {
  add_study_options(command, options, "study file, or a scene with --quantity (YAML)", "settings",
                    "directory for the results; it must not exist (default: runs/NAME-tradeoff, numbered)");
  command.add_option("--quantity", options.quantities, "what matters, e.g. \"peak force at gudgeon pin\"; may be repeated")
      ->allow_extra_args(false)
      ->type_name("WORDS");
  command.add_option("--error", options.wanted_error, "the requested error, e.g. 1%: the cheapest setting that reaches it is recommended")
      ->type_name("SHARE");
  command.add_option("--time", options.wanted_time, "the requested time of a run, e.g. 0.5s: the most accurate setting within it is named")
      ->type_name("TIME");
  command
      .add_option("--budget", options.budget,
                  "limit of the computing time, e.g. 10min: to keep it, clearly dominated settings are not run (default: 1min for a scene; "
                  "a study sets its own)")
      ->type_name("TIME");
  refuse_shard(command, "its settings are timed one after another, on one machine; leave it out");
  command.add_option("--repeats", options.repeats, "timed runs of each setting (default 5)")->type_name("N")->check(whole(1, 1000));
  command.add_option("--markdown", options.markdown, "also write the report to this file, with its picture beside it")
      ->check(named())
      ->type_name("FILE.md");
  command.footer(what_tradeoff_writes);
}

void add_linearize_options(CLI::App& command, Options& options) {
  command
      .add_option("--at", options.at,
                  "linearize about the state of the run at this time, e.g. 20ms; with --equilibrium, take drivers and loads at this time")
      ->type_name("TIME");
  command.add_flag("--equilibrium", options.at_rest,
                   "linearize about the equilibrium, with drivers and loads held; without this option and --at, about the assembled start");
  command.add_option("-n,--count", options.count, "how many modes are printed and drawn (default 6; all are written)")
      ->type_name("N")
      ->check(whole(0, 100'000));
  command.add_option("--frames", options.frames, "frames of an animation of each of these modes (default: none)")
      ->type_name("N")
      ->check(whole(0, 100'000));
  command.footer(what_linearize_writes);
}

/// Limits of access and cost, which a scene cannot set itself: SECURITY.md.
void add_bounds(CLI::App& command, Options& options) {
  command.add_option("--allow-path", options.allowed, "also let the scene read files in this folder and its subfolders; may be repeated")
      ->allow_extra_args(false)
      ->check(named())
      ->type_name("DIR");
  command.add_flag("--trust-geo", options.trust_geo, "let drawings (.geo) run every command in them, shell commands included");
  command.add_option("--mesh-time", options.mesh_time, "limit of the time to mesh one body (default 600 s)")->type_name("TIME");
  command.add_option("--mesh-memory", options.mesh_memory, "limit of the memory to mesh one body, in GB (default 8)")
      ->type_name("GB")
      ->check(CLI::Range(0.1, 1e6));
}

constexpr const char* what_report_writes =
    "Writes one HTML file that needs no other file and no network: the moving mechanism, plots of any columns, impacts, the energy\n"
    "ledger, warnings, and how the results were made. The mechanism is built again from the scene in the folder, so the meshes\n"
    "and drawings that it names must still be in place. If a table is too long for the page, each curve keeps its least and\n"
    "greatest values.\n"
    "docs/report.md says more. Exit codes: see pintle --help\n";

void add_report_options(CLI::App& command, Options& options) {
  command.add_option("results", options.scene, "results folder of run, kinematics or inverse")
      ->required()
      ->check(named())
      ->type_name("DIR");
  command.add_option("-o,--out", options.out, "the page to write; an existing file is replaced (default: DIR/report.html)")
      ->check(named())
      ->check(ends_in(".html", "a report is one page of HTML"))
      ->type_name("FILE.html");
  command.add_option("--size", options.megabytes, "approximate limit of the size of the page, in MB (default 5)")
      ->type_name("MB")
      ->check(CLI::Range(1.0, 200.0));
  command.add_flag("-q,--quiet", options.quiet, "print errors only");
  command.footer(what_report_writes);
}

void add_plot_options(CLI::App& command, Options& options) {
  command.add_option("results", options.scene, "results folder of run, kinematics or inverse")
      ->required()
      ->check(named())
      ->type_name("DIR");
  command.add_option("columns", options.quantities, "columns of trajectory.csv or ledger.csv, e.g. \"gudgeon pin.normal\"")
      ->required()
      ->type_name("COLUMN");
  command.add_option("--against", options.against, "the column along x (default: the time), e.g. \"gudgeon pin.ex\"")->type_name("COLUMN");
  command.add_option("-o,--out", options.out, "write a picture to this file; an existing file is replaced (default: plot in the terminal)")
      ->check(named())
      ->check(is_picture())
      ->type_name("FILE.svg|png|pdf");
  command.add_flag("-q,--quiet", options.quiet, "print errors only");
  command.footer("Exit codes: see pintle --help\n");
}

}  // namespace

bool is_passed_on(const std::string& command) {
  return command == "picture" || command == "film" || command == "view" || command == "fmu" || command == "hdf5";
}

void add_options(CLI::App& command, Options& options) {
  const std::string name = command.get_name();
  if (is_passed_on(name)) {
    command.set_help_flag();
    return;
  }
  if (name == "merge") return add_merge_options(command, options);
  add_bounds(command, options);
  if (name == "report") return add_report_options(command, options);
  if (name == "plot") return add_plot_options(command, options);
  if (name == "sweep" || name == "fit" || name == "sensitivity" || name == "nonlinear") return add_sweep_options(command, options);
  if (name == "tradeoff") return add_tradeoff_options(command, options);
  command.add_option("scene", options.scene, "scene file (YAML)")->required()->check(named())->type_name("SCENE.yaml");
  command
      .add_option("--set", options.set,
                  "override a parameter of the scene, e.g. --set clearance=0.1mm, or any key by its path, e.g. --set run.tolerance=1e-6, "
                  "--set \"joints.pin.clearance=null\" (null removes it); may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME|PATH=VALUE");
  command.add_flag("--json", options.json, "print JSON instead of text");
  if (name == "check") return;
  const std::string folder = name == "run" ? "runs/SCENE" : "runs/SCENE-" + name;
  command.add_option("-o,--out", options.out, "directory for the results; it must not exist (default: " + folder + ", numbered)")
      ->check(named())
      ->type_name("DIR");
  command.add_flag("-q,--quiet", options.quiet, "print errors only");
  if (name == "run")
    command.add_option("--restart", options.restart, "continue from a saved state of this scene, states/NNNNN.state of a run")
        ->check(named())
        ->type_name("FILE.state");
  if (name == "run") command.add_flag("--report", options.report, "also write a page of the results, DIR/report.html");
  if (name == "run") command.add_flag("--hdf5", options.hdf5, "also write the tables as one HDF5 file, DIR/results.h5");
  if (name == "run") command.footer(what_it_writes);
  if (name == "run") return;
  if (name == "linearize") return add_linearize_options(command, options);
  if (name == "kinematics" || name == "inverse") {
    command.add_flag("--report", options.report, "also write a page of the results, DIR/report.html");
    command.footer(name == "inverse" ? what_inverse_writes : what_kinematics_writes);
    return;
  }
  if (name == "statics") {
    command.add_option("--at", options.at, "take drivers and loads at this time, e.g. 20ms (default 0)")->type_name("TIME");
    command.footer(what_statics_writes);
    return;
  }
  command.add_option("-b,--body", options.body, "which body; may be left out if only one body is made of elements")->type_name("NAME");
  if (name == "static")
    command.footer(
        "It writes static.vtu (displacement, stress), points.csv, section_forces.csv (beams), static.json and drawing.json (for pintle "
        "report);\n"
        "for bodies in contact a folder each, and contacts.csv (pressure and gap).\nExit codes: see pintle "
        "--help\n");
  if (name == "mesh") command.footer("It writes mesh.vtu (quality of each cell, groups) and mesh.json.\nExit codes: see pintle --help\n");
  if (name != "modes") return;
  command.add_option("-n,--count", options.count, "how many natural modes (default 6)")->type_name("N")->check(whole(1, 100'000));
  command.add_option("--frames", options.frames, "frames of each animation, 0 for none (default 24, none above 30000 nodes)")
      ->type_name("N")
      ->check(whole(0, 100'000));
  command.footer(what_modes_writes);
}

}  // namespace pintle::app
