#include "framework/output/results.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/analysis/simulate/run_warnings.h"
#include "framework/output/run_files.h"
#include "framework/output/run_head.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json energies_json(const Energies& e) {
  return {{"kinetic", e.kinetic}, {"gravity", e.gravity}, {"springs", e.springs}, {"contacts", e.contacts},
          {"strain", e.strain},   {"stored", e.stored()}, {"lost", e.lost},       {"work in", e.input}};
}

Json assembly_json(const System& system, const Assembly& a) {
  Json redundant = Json::array();
  for (const Redundancy& r : a.redundant) {
    Json others = Json::array();
    for (int k : r.implied_by) others.push_back(system.joint_names[static_cast<std::size_t>(k)]);
    redundant.push_back({{"joint", system.joint_names[static_cast<std::size_t>(r.joint)]},
                         {"row", row_name(system.joints[static_cast<std::size_t>(r.joint)], r.row)},
                         {"implied by", others},
                         {"permanent", r.permanent}});
  }
  Json shared = Json::array();
  for (std::size_t k = 0; k < system.joints.size() && !a.redundant.empty(); ++k)
    for (int row = system.row_begin[k]; row < system.row_begin[k + 1]; ++row)
      if (a.shared[static_cast<std::size_t>(row)])
        shared.push_back({{"joint", system.joint_names[k]}, {"row", row_name(system.joints[k], row - system.row_begin[k])}});
  return {{"bodies", system.bodies.size()},
          {"coordinates", system.n()},
          {"modal coordinates", system.n() - system.n_rigid()},
          {"constraint rows", system.n_rows()},
          {"rank", a.rank},
          {"mobility", system.n() - a.rank},
          {"contacts", std::ranges::count(system.contacts, 0, &ContactPair::pair)},
          {"forces", system.forces.size()},
          {"ledger integrals", system.n_z()},
          {"redundant rows", redundant},
          {"joint forces not unique", shared}};
}

Json choice_json(const ModalChoice& c) {
  Json modes = Json::array();
  for (const ConsideredMode& m : c.considered)
    modes.push_back({{"frequency [Hz]", m.frequency},
                     {"strain energy", m.energy},
                     {"left out of strain energy", m.left_energy},
                     {"left out of displacement", m.left_displacement},
                     {"kept", m.kept}});
  return {{"count", c.count}, {"reason", c.reason}, {"considered", modes}};
}

Json motion_json(const MotionEstimate& m) {
  return {{"deflection over size", m.deflection},
          {"slope [rad]", m.slope},
          {"spin [rad/s]", m.spin},
          {"excited up to [Hz]", m.excited_up_to},
          {"first frequency changed by inertia", m.by_rotation},
          {"first frequency changed by all loads", m.by_all_loads}};
}

Json flexible_json(const Model& model) {
  Json all = Json::array();
  for (const FlexibleReport& r : model.flexible) {
    Json one = {{"body", r.body},
                {"basis", r.basis},
                {"shapes", r.shapes},
                {"lowest [Hz]", r.lowest},
                {"highest [Hz]", r.highest},
                {"least damping", r.least_damping},
                {"greatest damping", r.most_damping},
                {"frequencies [Hz]", r.frequencies},
                {"damping ratios", r.damping},
                {"mass share", r.mass ? Json{{"x", r.mass->x()}, {"y", r.mass->y()}, {"rotation", r.mass->z()}} : Json(nullptr)},
                {"compliance covered", r.compliance},
                {"compliance covered least at", r.compliance_at}};
    if (r.choice) one["choice"] = choice_json(*r.choice);
    if (r.motion) one["rigid run"] = motion_json(*r.motion);
    all.push_back(std::move(one));
  }
  return all;
}

Json preliminary_run_json(const Model& model) {
  if (!model.preliminary_run) return nullptr;
  const PreliminaryRun& r = *model.preliminary_run;
  return {{"reached [s]", r.until}, {"steps", r.steps}, {"time [s]", r.seconds}, {"trouble", r.trouble}};
}

Json method_json(const Scheme& scheme, const std::string& switched) {
  return {{"name", name(scheme)}, {"reason", scheme.reason}, {"changed in the run", switched.empty() ? Json(nullptr) : Json(switched)}};
}

}  // namespace

Json run_head(const Scene& scene, const Run& run) {
  return {{"program", "pintle"},      {"version", PINTLE_VERSION},         {"title", scene.title},
          {"file", scene.file},       {"status", status_text(run.status)}, {"reason", run.reason},
          {"warnings", run.warnings}, {"reached [s]", run.t_end}};
}

std::string run_json(const Scene& scene, const Model& model, const Assembly& assembly, const Run& run) {
  const System& system = model.system;
  Json losses = Json::object();
  for (std::size_t i = 0; i < run.integrals.size(); ++i) losses[integral_name(system, system.integrals[i])] = run.integrals[i];
  Json contacts = Json::object();
  std::size_t profiles = 0;
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& p = system.contacts[c];
    if (p.pair > 0) continue;
    Json& out = contacts[system.contact_names[c]] = {{"model", p.profiles ? model.contacts[profiles++] : model.clearances[c]}};
    if (is_rigid(p)) {
      out["restitution"] = p.rigid->restitution;
    } else if (!is_held(p)) {
      for (const auto& [name, value] : constants_of(p.normal)) out[name] = value;
      if (!begins_with_jump(p.normal)) out["restitution delivered"] = restitution_of(p.normal, 1);  // for any mass
    }
    if (p.profiles) {
      out["pairs of pieces"] = p.pairs;
      continue;
    }
    out["journal radius [m]"] = journal_radius(p.gap);
    out["bearing radius [m]"] = bearing_radius(p.gap);
  }
  Json out = run_head(scene, run);
  if (!scene.events.empty()) {
    Json& events = out["events"] = Json::array();
    for (const Happening& h : run.happenings) events.push_back({{"event", h.event}, {"t [s]", h.t}, {"did", h.did}});
    if (const auto never = never_came(scene, run); !never.empty()) out["events that never came"] = never;
  }
  out.update(Json{{"model", assembly_json(system, assembly)},
                  {"method", method_json(model.scheme, run.switched)},
                  {"flexible bodies", flexible_json(model)},
                  {"rigid run", preliminary_run_json(model)},
                  {"contacts", contacts},
                  {"energy at start [J]", energies_json(run.first)},
                  {"energy at end [J]", energies_json(run.last)},
                  {"ledger [J]", losses},
                  {"unexplained [J]", run.unexplained},
                  {"worst unexplained [J]", run.worst_unexplained},
                  {"energy in play [J]", run.energy_in_play},
                  {"ledger bound", {{"share of the energy in play", run.ledger_bound}, {"and of rounding [J]", run.ledger_floor}}},
                  {"worst scaled violation", {{"position", run.worst_position}, {"velocity", run.worst_velocity}}},
                  {"counts",
                   {{"steps", run.counts.steps},
                    {"rejected", run.counts.rejected},
                    {"evaluations", run.counts.evaluations},
                    {"factorizations", run.counts.factorizations},
                    {"events", run.counts.events},
                    {"impacts", run.impacts.size()},
                    {"partitions chosen", run.counts.partitions}}},
                  {"timings [s]", {{"integration", run.seconds}}}});
  return text_with_scene(out, scene);
}

std::string begun_json(const Scene& scene) {
  const Json out = {{"program", "pintle"},      {"version", PINTLE_VERSION}, {"title", scene.title},
                    {"file", scene.file},       {"status", "unfinished"},    {"reason", "the run is going on, or the program was killed"},
                    {"warnings", Json::array()}};
  return text_with_scene(out, scene);
}

std::string check_json(const Scene& scene, const Model& model, const Assembly& assembly, const CostEstimate& cost) {
  std::vector<std::string> warnings = model.warnings;
  for (std::string& w : warnings_of(model, assembly)) warnings.push_back(std::move(w));
  const Json out = {{"title", scene.title},
                    {"file", scene.file},
                    {"model", assembly_json(model.system, assembly)},
                    {"method", method_json(model.scheme, "")},
                    {"clearances", model.clearances},
                    {"flexible bodies", flexible_json(model)},
                    {"rigid run", preliminary_run_json(model)},
                    {"cost", Json::parse(cost_json(cost))},
                    {"warnings", warnings}};
  return text_with_scene(out, scene);
}

void write_results(const fs::path& directory, const Scene& scene, const Model& model, const Assembly& assembly, const Run& run) {
  RunFiles files(directory, scene, model);
  files.add(run.trajectory, run.ledger, run.impacts, run.happenings);
  files.finish(run.impacts, run.happenings);
  write_text(directory / "run.json", run_json(scene, model, assembly, run));
}

}  // namespace pintle
