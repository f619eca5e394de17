// The command linearize: small motion about a state of a mechanism.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <optional>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "app/waiting.h"
#include "framework/analysis/linearize/linearize.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/common/work_done.h"
#include "framework/configuration/assemble.h"
#include "framework/configuration/equilibrium.h"
#include "framework/mechanism/drawing.h"
#include "framework/output/results.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

std::string about_text(const Options& options, const Linearization& lin) {
  if (options.at_rest)
    return "the equilibrium" + (lin.about.t > 0 ? ", drivers and loads as at t = " + number(lin.about.t, 9) + " s" : std::string());
  if (!options.at.empty()) return "the run's state at t = " + number(lin.about.t, 9) + " s";
  return "the assembled start";
}

void print_modes(const Linearization& lin, int count) {
  std::printf("\n  %4s %-11s %15s %15s %10s %13s  %s\n", "mode", "", "frequency [Hz]", "natural [Hz]", "damping", "decay [1/s]",
              "moves most (share of its body in the kinetic energy)");
  int k = 0, left_out = 0;
  for (const LinearMode& m : lin.modes) {
    ++k;
    if (k > count && m.kind != LinearMode::Kind::growing) {
      ++left_out;
      continue;
    }
    std::printf("  %4d %-11s ", k, kind_text(m.kind));
    if (m.kind == LinearMode::Kind::zero)
      std::printf("%15s %15s %10s %13s", "0", "0", "", "");
    else  // values within rounding are shown as zero
      std::printf("%15.9g %15.9g %10.4g %13.6g", m.frequency(), m.natural(), std::abs(m.root.real()) <= m.uncertainty ? 0 : m.damping(),
                  std::abs(m.root.real()) <= m.uncertainty ? 0 : -m.root.real());
    std::printf("  %s (%.3g %%)%s\n", m.carrier.c_str(), 100 * m.share,
                m.kind == LinearMode::Kind::zero                                                  ? ": moves freely"
                : m.kind == LinearMode::Kind::growing && lin.coefficients != Coefficients::frozen ? ": UNSTABLE"
                                                                                                  : "");
  }
  if (left_out > 0) std::printf("  %4s %d more in linearized.csv\n", "", left_out);
  std::printf("\n");
  std::fflush(stdout);
}

void write_animations(const fs::path& out, const Scene& scene, const Model& model, const Linearization& lin, int count, int frames) {
  const Drafting drafting(scene, model);
  Equations eq(model.system);
  Eigen::VectorXd dy(model.system.n_y());
  const int modes = std::min(count, static_cast<int>(lin.modes.size()));
  for (int k = 0; k < modes; ++k) {
    char name[32];
    std::snprintf(name, sizeof name, "mode_%02d", k + 1);
    FrameWriter writer(out / name);
    for (int i = 0; i <= frames; ++i) {
      const State state = displaced(model, lin, lin.modes[static_cast<std::size_t>(k)], 2 * std::numbers::pi * i / frames);
      evaluate(model.system, state, eq, dy);
      Drawing drawing = draw(model, drafting, state, eq);
      drawing.forces.clear();  // forces of the enlarged shape are not forces of the mechanism
      writer.add(drawing);
      work_done = (k + static_cast<double>(i) / frames) / modes;
    }
    writer.finish();
  }
}

/// The state to linearize about. @returns nothing if it was not found, which has been reported
std::optional<LinearizedStart> state_about(const Options& options, const Scene& scene, const Model& model, double t) {
  now_doing("assembling the mechanism");
  const Assembly assembly = assemble(scene, model);
  if (options.at_rest) {
    now_doing("finding the equilibrium");
    const Equilibrium rest = find_equilibrium(scene, model, assembly, t);
    if (rest.found) return LinearizedStart{rest.state, ""};
    std::cerr << scene.file << ": no equilibrium to linearize about: " << rest.reason << "\n";
    return std::nullopt;
  }
  if (options.at.empty()) return linearized_start(scene, model, assembly);
  now_doing("running to the state");
  try {
    return LinearizedStart{state_at(model, assembly.start, t), ""};
  } catch (const std::runtime_error& e) {
    std::cerr << scene.file << ": " << e.what() << "\n";
    return std::nullopt;
  }
}

void print_linearization(const Options& options, const Scene& scene, const Model& model, const Linearization& lin, const fs::path& out) {
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  print_rows(std::cout, {{"about", about_text(options, lin)},
                         {"free coordinates", std::to_string(lin.independent.size()) + " of " + std::to_string(lin.coordinates.size())},
                         {"state space", std::to_string(lin.space.states.size()) + " states, " + std::to_string(lin.space.inputs.size()) +
                                             " inputs, " + std::to_string(lin.space.outputs.size()) + " outputs"}});
  std::cout << std::flush;
  if (!lin.modes.empty()) print_modes(lin, options.count);
  for (const std::string& n : lin.notes) std::cout << "  note: " << n << "\n";
  for (const std::string& w : model.warnings) std::cout << "  warning: " << w << "\n";
  print_rows(std::cout, {{"results", out.string() + (options.frames > 0 && !lin.modes.empty()
                                                         ? ", animations " + (out / "mode_01/mechanism.pvd").string() + " …"
                                                         : "")}});
}

}  // namespace

int linearize(const Options& options) {
  Waiting waiting(options.quiet || options.json);
  now_doing("reading the scene");
  Scene scene = read_scene(options.scene, overrides(options));
  if (!options.at.empty() && !options.at_rest) require_run(scene);
  const double t = options.at.empty() ? 0 : instant(options);
  if (!options.at.empty() && !options.at_rest && t > scene.run.until)
    std::cerr << "warning: --at " << options.at << ": the run ends at " << number(scene.run.until)
              << " s (run.until); it is continued to the state\n";
  scene = with_pieces(std::move(scene));
  const fs::path out = results_directory(options, "-linearize");
  require_place(out);
  if (options.frames > 0) scene.output.frames = std::max(2, scene.output.frames);  // keeps the data needed to draw flexible bodies
  now_doing("building the model");
  const Model model = build(scene);
  const std::optional<LinearizedStart> start = state_about(options, scene, model, t);
  if (!start) return run_failed;
  now_doing("linearizing about the state");
  Linearization lin = linearize(scene, model, start->state, options.at_rest ? Laws::hold : Laws::go_on);
  if (!start->note.empty()) lin.notes.push_back(start->note);
  now_doing("writing the results");
  write_whole(options, out, [&](const fs::path& folder) {
    write_linearization(folder, scene, model, lin, options.count);
    if (options.frames > 0) write_animations(folder, scene, model, lin, options.count, options.frames);
  });
  waiting.end();
  if (options.json) {
    std::cout << linearized_json(scene, lin);
  } else if (!options.quiet) {
    print_linearization(options, scene, model, lin, out);
  }
  return ok;
}

}  // namespace pintle::app
