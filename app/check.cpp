// The command check: the contents and requirements of a scene, and the cost estimate of its run.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "app/options.h"
#include "app/cost_text.h"
#include "app/frame_count.h"
#include "app/progress.h"
#include "app/waiting.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/processor_time.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/configuration/unsound_laws.h"
#include "framework/output/results.h"
#include "framework/output/room.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

std::string bodies_text(const System& s) {
  const auto flexible = std::count_if(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.modes() > 0; });
  const auto rigid = static_cast<long>(s.bodies.size()) - flexible;
  std::string text = flexible > 0 ? std::to_string(flexible) + " flexible with " + std::to_string(s.n() - s.n_rigid()) + " shapes" : "";
  if (rigid == 0) return text;
  return std::to_string(rigid) + " rigid" + (flexible > 0 ? ", " + text : "");
}

/// Those in clearance joints, and those of profiles, guides and gears.
std::string contacts_text(const System& s) {
  const int joints = n_clearances(s);
  const auto others = std::ranges::count_if(s.contacts, [](const ContactPair& c) { return c.profiles && c.pair == 0; });
  if (joints + others == 0) return "none";
  const std::string of_joints = joints == 0 ? "" : std::to_string(joints) + " in clearance joints";
  if (others == 0) return of_joints;
  return of_joints + (joints > 0 ? ", " : "") + std::to_string(others) + " between profiles";
}

/// In per cent, with values that are only rounding as 0.
std::string percent(double part) { return number(std::abs(part) < 1e-6 ? 0 : 100 * part, 3); }

/// Prints the modes kept for each flexible body.
void print_flexible(const Model& model) {
  std::size_t width = 4;
  for (const FlexibleReport& r : model.flexible) width = std::max(width, r.body.size());
  const auto line = [&](const std::vector<std::string>& cells) {
    const std::size_t widths[] = {width + 2, 8, 22, 20, 24, 0};
    std::cout << "  ";
    for (std::size_t i = 0; i < cells.size(); ++i)  // at least two blanks, however long the entry
      std::cout << cells[i] << std::string(i + 1 == cells.size() ? 0 : std::max(widths[i], cells[i].size() + 2) - cells[i].size(), ' ');
    std::cout << "\n";
  };
  line({"body", "shapes", "frequencies [Hz]", "damping", "mass x, y, rotation %", "least compliance covered %"});
  for (const FlexibleReport& r : model.flexible)
    line({r.body, std::to_string(r.shapes), number(r.lowest, 5) + " to " + number(r.highest, 5),
          number(r.least_damping, 3) + (r.most_damping > r.least_damping ? " to " + number(r.most_damping, 3) : ""),
          r.mass ? percent(r.mass->x()) + ", " + percent(r.mass->y()) + ", " + percent(r.mass->z()) : "none (mean axes)",
          percent(r.compliance) + (r.compliance_at.empty() ? "" : " (" + r.compliance_at + ")") + "; " + r.basis});
}

/// Prints how `keep: auto` chose its modes.
void print_choice(const FlexibleReport& r) {
  std::cout << "  \"" << r.body << "\": keep auto: " << r.choice->reason << "\n";
  if (r.choice->considered.empty()) return;
  const auto line = [](const std::vector<std::string>& cells) {
    constexpr int widths[] = {6, 16, 21, 0};
    std::cout << "    " << std::left;
    for (std::size_t i = 0; i < cells.size(); ++i) std::cout << std::setw(widths[i]) << cells[i];
    std::cout << "\n";
  };
  line({"mode", "frequency [Hz]", "strain energy %", "left out after this mode: energy %, displacement %"});
  int k = 0;
  for (const ConsideredMode& m : r.choice->considered)
    line({std::to_string(++k), number(m.frequency, 6), percent(m.energy),
          percent(m.left_energy) + ", " + percent(m.left_displacement) + (m.kept ? "  kept" : "")});
}

void print_estimates(const Model& model) {
  for (const FlexibleReport& r : model.flexible)
    if (r.choice) print_choice(r);
  if (!model.preliminary_run) return;
  const PreliminaryRun& run = *model.preliminary_run;
  std::cout << "  rigid run: "
            << (run.steps > 0
                    ? number(run.until, 4) + " s in " + std::to_string(run.steps) + " steps, took " + number(run.seconds, 3) + " s"
                    : "none")
            << (run.trouble.empty() ? "" : "; " + run.trouble) << "\n";
  for (const FlexibleReport& r : model.flexible)
    if (r.motion)
      std::cout << "    \"" << r.body << "\" deflects by about " << percent(r.motion->deflection) << " % of its size, slope "
                << number(r.motion->slope, 3) << " rad; excited up to " << number(r.motion->excited_up_to, 4)
                << " Hz; its loads change its first frequency by " << percent(r.motion->by_all_loads) << " %\n";
}

/// Redundant rows of one joint that the same other joints imply: one line of output.
struct RedundantRows {
  const Redundancy* first;
  std::string rows;
  int count = 1;
};

std::vector<RedundantRows> grouped(const System& s, const std::vector<Redundancy>& all) {
  std::vector<RedundantRows> out;
  for (const Redundancy& r : all) {
    const std::string row = row_name(s.joints[static_cast<std::size_t>(r.joint)], r.row);
    if (!out.empty() && out.back().first->joint == r.joint && out.back().first->permanent == r.permanent &&
        out.back().first->implied_by == r.implied_by)
      out.back().rows += ", " + row, ++out.back().count;
    else
      out.push_back({&r, row});
  }
  return out;
}

/// Prints which rows are redundant, and which joint forces are nevertheless unique. --json lists all of them.
void print_redundancy(const System& s, const Assembly& a) {
  constexpr std::size_t most = 8;
  const std::vector<RedundantRows> groups = grouped(s, a.redundant);
  for (std::size_t k = 0; k < std::min(groups.size(), most); ++k) {
    const Redundancy& r = *groups[k].first;
    std::vector<std::string> others;
    for (int i : r.implied_by) others.push_back("\"" + s.joint_names[static_cast<std::size_t>(i)] + "\"");
    std::cout << "  redundant" << (r.permanent ? "" : " in this pose only") << ": \"" << s.joint_names[static_cast<std::size_t>(r.joint)]
              << "\" (" << groups[k].rows << ")"
              << (others.empty() ? (groups[k].count > 1 ? " constrain" : " constrains") + std::string(" nothing that can move")
                                 : (groups[k].count > 1 ? " are" : " is") + std::string(" implied by ") + some_of(others, false))
              << "\n";
  }
  if (groups.size() > most) std::cout << "  redundant: also rows of " << groups.size() - most << " more joints; --json lists them all\n";
  if (a.redundant.empty()) return;
  const std::string unique = rows_text(s, a.shared, false);
  std::cout << "  joint forces that are unique: " << (unique.empty() ? "none" : unique) << "\n"
            << "  joint forces that are not: " << rows_text(s, a.shared, true) << "\n";
}

void print_check(const Scene& scene, const Model& model, const Assembly& a) {
  const System& s = model.system;
  std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n";
  print_rows(
      std::cout,
      {{"bodies", bodies_text(s) + ", " + std::to_string(s.n()) + " coordinates"},
       {"constraint rows", std::to_string(s.n_rows()) + ", rank " + std::to_string(a.rank) +
                               (a.redundant.empty() ? "" : ", " + std::to_string(a.redundant.size()) + " redundant")},
       {"mobility", std::to_string(s.n() - a.rank)},
       {"contacts", contacts_text(s)},
       {"forces", s.forces.empty() ? "none" : std::to_string(s.forces.size())},
       {"gravity", s.gravity.isZero() ? "off" : number(s.gravity.x()) + ", " + number(s.gravity.y()) + " m/s^2"},
       {"ledger integrals", std::to_string(s.n_z())},
       {"scheme", name(model.scheme) + ", tolerance " + number(model.scheme.tolerance) + ", constraints by " + scene.run.constraints},
       {"method", model.scheme.reason},
       {"constraint equations", Schur(s).solver()},
       {"assembly", "closed in " + std::to_string(a.iterations) + " iterations, worst coordinate moved by " + number(a.moved, 3)}});
  for (std::size_t c = 0; c < static_cast<std::size_t>(n_clearances(s)); ++c) {
    std::cout << "  clearance at \"" << s.contact_names[c] << "\": " << number(s.contacts[c].gap.clearance()) << " m, "
              << model.clearances[c] << "\n";
  }
  std::size_t words = 0;
  for (std::size_t c = 0; c < s.contacts.size(); ++c)
    if (s.contacts[c].profiles && s.contacts[c].pair == 0)
      std::cout << "  contact \"" << s.contact_names[c] << "\": " << model.contacts[words++] << "\n";
  if (!model.flexible.empty()) {
    print_flexible(model);
    print_estimates(model);
  }
  print_redundancy(s, a);
  for (const std::string& w : model.warnings) std::cout << "  warning: " << w << "\n";
  for (const std::string& w : warnings_of(model, a)) std::cout << "  warning: " << w << "\n";
  for (const std::string& w : tables_left(scene, model, a.start)) std::cout << "  warning: " << w << "\n";
}
/// Adds the warnings that `run` would give about disk space for its results.
void foresee_room(const Options& options, const Scene& scene, Model& model) {
  const fs::path out = results_directory(options);
  try {
    for (std::string& warning : validate_room(out, room_needed(scene, model), room_at(out))) model.warnings.push_back(std::move(warning));
  } catch (const std::runtime_error& impossible) {
    model.warnings.push_back(impossible.what());
  }
}
/// Checks a scene that allows kinematics but no computation of forces.
int check_kinematics(const Options& options, Waiting& waiting, const Scene& scene) {
  const Model model = build(scene);
  const Assembly assembly = assemble(scene, model);
  waiting.end();
  if (options.json)
    std::cout << check_json(scene, model, assembly, CostEstimate{});
  else
    print_check(scene, model, assembly);
  return ok;
}

}  // namespace

int check(const Options& options) {
  Waiting waiting(options.quiet || options.json);
  now_doing("reading the scene");
  Scene read = read_scene(options.scene, overrides(options));
  require_run(read);
  Scene scene = with_pieces(std::move(read));
  const FrameCount frames(scene);
  if (const auto moved = for_kinematics_alone(scene)) return check_kinematics(options, waiting, *moved);
  now_doing("building the model");
  const double begin = processor_time();
  Model model = build_with_preliminary_run(scene);
  frames.fit(model, scene);
  const double built = processor_time() - begin - (model.preliminary_run ? model.preliminary_run->seconds : 0);
  now_doing("assembling the mechanism");
  const Assembly assembly = assemble(scene, model);
  foresee_room(options, scene, model);
  now_doing("trying out the run");
  const CostEstimate cost = estimate_cost(scene, model, assembly);
  waiting.end();
  if (options.json) {
    std::cout << check_json(scene, model, assembly, cost);
  } else {
    print_check(scene, model, assembly);
    print_cost(cost, built);
  }
  const std::string& trouble = cost.run.trial.trouble;
  if (!trouble.empty()) std::cerr << scene.file << ": the run fails: " << trouble << "\n";
  return trouble.empty() ? ok : run_failed;
}

}  // namespace pintle::app
