#include "framework/analysis/simulate/run_warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>
#include <variant>
#include <vector>

#include "framework/common/text.h"

namespace pintle {

void warn_of_depth(const System& system, Run& run) {
  std::vector<double> deepest(system.contacts.size(), 0.0), force(system.contacts.size(), 0.0);
  for (const Impact& i : run.impacts) {
    const auto first = static_cast<std::size_t>(i.contact - system.contacts[static_cast<std::size_t>(i.contact)].pair);
    deepest[first] = std::max(deepest[first], i.deepest);
    force[first] = std::max(force[first], i.peak_force);
  }
  for (std::size_t c = 0; c < deepest.size(); ++c)
    if (const ContactPair& pair = system.contacts[c]; is_rigid(pair)) {
      continue;
    } else if (const double size = contact_size(pair, system.length); deepest[c] > deepest_valid * size) {
      const char* of = size == system.length ? "the length of the mechanism" : "their smallest radius";  // a rope has no radius
      std::ostringstream s;
      s.precision(3);
      s << "\"" << system.contact_names[c] << "\": the " << (pair.profiles ? "surfaces overlapped by " : "journal went ") << deepest[c]
        << (pair.profiles ? std::string(" m, more than a tenth of ") + of : " m into the wall, more than a tenth of its radius")
        << "; no contact law holds there (is the stiffness " << stiffness_text(pair.normal, 3) << " meant?)";
      run.warnings.push_back(s.str());
    } else if (const std::string range = range_warning(pair.normal, deepest[c]); !range.empty()) {
      run.warnings.push_back("\"" + system.contact_names[c] + "\": " + range);
    } else if (pair.pressure && pressure_under(*pair.pressure, force[c]).half_angle > widest(*pair.pressure)) {
      const auto degrees = [](double angle) { return number_text(angle * 180 / std::numbers::pi, 3); };
      run.warnings.push_back("\"" + system.contact_names[c] + "\": under its greatest force it spans " +
                             degrees(pressure_under(*pair.pressure, force[c]).half_angle) +
                             " degrees to either side; its pressure holds up to " + degrees(widest(*pair.pressure)));
    }
}

void warn_of_gap(const System& system, const Model& model, const SavedState& from, Run& run) {
  const bool linked = std::ranges::any_of(system.contacts, [](const ContactPair& c) { return is_held(c); });
  if (!linked && model.bending.empty()) return;
  run.warnings.push_back(
      "this run continues from " + number_text(from.t, 3) + " s: " + (linked ? "whether a massless link pushed" : "how far bodies bent") +
      (linked && !model.bending.empty() ? " and how far bodies bent" : "") + " before that was checked by the run that saved it");
}

void warn_of_pushing(const System& system, Run& run) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    if (!is_held(system.contacts[c])) continue;
    const Run::LinkForce& force = run.links[c];
    if (force.pushing == 0) continue;
    std::ostringstream s;
    s.precision(3);
    s << "\"" << system.contact_names[c] << "\": the massless link pushed, with up to " << -force.least << " N, in " << force.pushing
      << " of " << force.rows << " outputs; a wall cannot pull: contact would be lost there";
    run.warnings.push_back(s.str());
  }
}

void warn_of_lifting(const System& system, Run& run) {
  for (std::size_t k = 0; k < system.joints.size(); ++k) {
    if (!std::holds_alternative<RollsOnDisc>(system.joints[k]) && !std::holds_alternative<RollsOnLine>(system.joints[k])) continue;
    const std::vector<double> normal = run.trajectory.column(system.joint_names[k] + ".normal [N]");
    const auto pulls = std::ranges::count_if(normal, [](double force) { return force < 0; });
    if (pulls == 0) continue;
    run.warnings.push_back("\"" + system.joint_names[k] + "\": the rolling disc was held down, with up to " +
                           number_text(-*std::ranges::min_element(normal), 3) + " N, in " + std::to_string(pulls) + " of " +
                           std::to_string(normal.size()) + " outputs: it would lift off there; model it by a contact");
  }
}

void warn_of_stiffness(const Scene& scene, const Model& model, double share, Run& run) {
  constexpr double most = 0.5;
  if (!(share > most)) return;
  const bool rigid = std::ranges::any_of(model.system.contacts, [](const ContactPair& c) { return is_rigid(c); });
  const std::string remedy = rigid ? "make the fastest part softer or less damped, or give the contacts a law"
                             : scene.run.constraints == "partitioning" ? "remove constraints: partitioning, and take method: auto"
                             : scene.run.method != "auto"              ? "take method: auto, or generalized-alpha"
                                                                       : "take method: generalized-alpha";
  const std::string& fast = model.scheme.stiff;
  run.warnings.push_back("stability, not accuracy, limited " + number_text(std::round(100 * share)) + " % of the explicit steps" +
                         (fast.empty() ? "" : "; the fastest decay is that of " + fast) + ": " + remedy);
}

void warn_of_coarse_forces(const Model& model, bool implicit, Run& run) {
  constexpr double multiple = 5e3, much = 0.1;  // error of forces over the tolerance, as stated in docs/results.md; relative to their peak
  if (!implicit || model.system.joints.empty() || model.scheme.tolerance * multiple <= much) return;
  run.warnings.push_back("generalised-α at a tolerance of " + number_text(model.scheme.tolerance, 2) +
                         " leaves errors of several per cent of their peaks in joint forces and torques of drivers, of tens of per cent "
                         "where a body rings; tighten run.tolerance to 1e-6 if they matter");
}

std::vector<std::string> never_came(const Scene& scene, const Run& run) {
  std::set<std::string> came;
  for (const Happening& h : run.happenings) came.insert(h.event);
  std::vector<std::string> out;
  for (const SceneEvent& event : scene.events)
    if (!came.contains(event.name)) out.push_back(event.name);
  return out;
}

}  // namespace pintle
