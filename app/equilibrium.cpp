// The command statics: the equilibrium of a mechanism.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "app/waiting.h"
#include "framework/analysis/simulate/identity.h"
#include "framework/analysis/simulate/saved_state.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/file.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/configuration/equilibrium.h"
#include "framework/output/results.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

std::string stability_text(const Stability& s) {
  if (!s.judged) return "not determined: " + s.why_not;
  if (s.dofs == 0) return "held in every direction by joints and drivers";
  const auto bodies = [&](int begin, int count) {
    std::vector<std::string> seen;
    for (int i = begin; i < begin + count; ++i)
      if (const std::string& name = s.moving[static_cast<std::size_t>(i)]; std::find(seen.begin(), seen.end(), name) == seen.end())
        seen.push_back(name);
    return " (" + some_of(seen) + ")";
  };
  std::string out =
      s.unstable > 0 ? "UNSTABLE in " + counted(static_cast<std::size_t>(s.unstable), "direction") + bodies(0, s.unstable) : "";
  if (s.neutral > 0)
    out += (out.empty() ? "" : ", ") + std::string("neutral in ") + counted(static_cast<std::size_t>(s.neutral), "direction") +
           bodies(s.unstable, s.neutral);
  if (out.empty()) out = "stable";
  out += ", of " + counted(static_cast<std::size_t>(s.dofs), "degree") + " of freedom";
  return out + (s.circulatory ? "; follower loads may cause flutter, which statics cannot detect" : "");
}

struct Column {
  std::string name, quantity, unit;  ///< "crank pin on coupler", "fx", "N"
};
// "crank pin.fx on coupler [N]"
Column split(const std::string& header) {
  const auto bracket = header.rfind(" [");
  const std::string plain = header.substr(0, bracket);
  const auto dot = plain.rfind('.');
  if (dot == std::string::npos) return {"", plain, header.substr(bracket + 2, header.size() - bracket - 3)};
  const auto on = plain.find(" on ", dot);
  const std::string subject = on == std::string::npos ? "" : plain.substr(on);
  return {plain.substr(0, dot) + subject, plain.substr(dot + 1, on == std::string::npos ? on : on - dot - 1),
          header.substr(bracket + 2, header.size() - bracket - 3)};
}

/// A row for each body, joint, clearance and load with its values in the table; rates are omitted, rounding is shown as 0.
void add_values(const Table& table, Rows& rows) {
  std::map<std::string, double> greatest;
  for (std::size_t c = 0; c < table.data.size(); ++c) {
    double& most = greatest[split(table.header[c]).unit];
    most = std::max(most, std::abs(table.data[c]));
  }
  std::string last;
  for (std::size_t c = 1; c < table.data.size(); ++c) {
    const Column column = split(table.header[c]);
    if (column.unit.find("/s") != std::string::npos) continue;
    const double value = std::abs(table.data[c]) <= 1e-12 * greatest[column.unit] ? 0 : table.data[c];
    const std::string text = column.quantity + " = " + number(value) + " " + column.unit;
    if (column.name != last || rows.empty())
      rows.emplace_back(last = column.name, text);
    else
      rows.back().second += ", " + text;
  }
}

constexpr const char* rest_file = "rest.state";
bool runs_from_rest(const Scene& scene, const Equilibrium& e) { return e.found && scene.has_run; }

void print(const Scene& scene, const Equilibrium& e, const fs::path& out) {
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  Rows rows;
  if (!e.method.empty())
    rows.emplace_back(e.found ? "found by" : "tried", e.method + ", " + counted(static_cast<std::size_t>(e.iterations), "iteration") +
                                                          "; residual " + number(e.residual, 2) + " of the greatest force");
  if (e.found) {
    rows.emplace_back("equilibrium", stability_text(e.stability));
    if (e.state.t != 0) rows.emplace_back("at", number(e.state.t, 9) + " s, with drivers held and loads as at this time");
    add_values(e.table, rows);
  }
  rows.emplace_back("results", out.string() + ", drawing " + (out / "mechanism.pvd").string());
  if (runs_from_rest(scene, e)) rows.emplace_back("to start from it", "pintle run SCENE --restart " + (out / rest_file).string());
  print_rows(std::cout, rows);
  for (const std::string& w : e.warnings) std::cout << "  warning: " << w << "\n";
  std::cout << "  " << (e.found ? "at rest" : "NOT AT REST: " + e.reason) << "\n";
}

}  // namespace

int equilibrium(const Options& options) {
  Waiting waiting(options.quiet || options.json);
  now_doing("reading the scene");
  Scene scene = with_pieces(ready_for_statics(read_scene(options.scene, overrides(options))));
  scene.output.frames = 2;  // so that flexible bodies can be drawn
  const double at = options.at.empty() ? 0 : instant(options);
  const fs::path out = results_directory(options, "-statics");
  require_place(out);
  now_doing("building the model");
  const Model model = build(scene);
  now_doing("assembling the mechanism");
  const Assembly assembly = assemble(scene, model);
  now_doing("finding the equilibrium");
  const Equilibrium found = find_equilibrium(scene, model, assembly, at);

  now_doing("writing the results");
  write_whole(options, out, [&](const fs::path& folder) {
    write_equilibrium(folder, scene, model, found);
    if (runs_from_rest(scene, found))
      write_text(folder / rest_file, state_text(identity(scene, model, assembly), beginning(model, found.state)));
    FrameWriter writer(folder);
    Equations eq(model.system);
    Eigen::VectorXd dy(model.system.n_y());
    evaluate(model.system, found.state, eq, dy);
    writer.add(draw(model, Drafting(scene, model), found.state, eq));
    writer.finish();
  });
  waiting.end();

  if (options.json)
    std::cout << equilibrium_json(scene, model, found);
  else if (!options.quiet)
    print(scene, found, out);
  if (!found.found && (options.quiet || options.json)) std::cerr << scene.file << ": no equilibrium: " << found.reason << "\n";
  return found.found ? ok : run_failed;
}

}  // namespace pintle::app
