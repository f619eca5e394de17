#include "framework/run/results.h"

#include <unistd.h>

#include <cmath>

#include <nlohmann/json.hpp>

#include "framework/run/text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string events_csv(const System& system, const std::vector<Impact>& impacts) {
  std::string out =
      "joint,begin [s],end [s],approach speed [m/s],separation speed [m/s],deepest penetration [m],"
      "peak force [N],energy lost [J]\n";
  for (const Impact& i : impacts) {
    out += csv_field(system.contact_names[static_cast<std::size_t>(i.contact)]);
    for (double x : {i.begin, i.end, i.approach, i.separation, i.deepest, i.peak_force, i.lost}) {
      out += ',';
      append_number(out, x);
    }
    out += '\n';
  }
  return out;
}

Json energies_json(const Energies& e) {
  return {{"kinetic", e.kinetic}, {"gravity", e.gravity}, {"springs", e.springs}, {"contacts", e.contacts}, {"strain", e.strain},
          {"stored", e.stored()}, {"lost", e.lost},       {"work in", e.input}};
}

Json assembly_json(const System& system, const Assembly& a) {
  Json redundant = Json::array();
  for (const Redundancy& r : a.redundant) {
    Json others = Json::array();
    for (int k : r.implied_by) others.push_back(system.joint_names[static_cast<std::size_t>(k)]);
    redundant.push_back({{"joint", system.joint_names[static_cast<std::size_t>(r.joint)]},
                         {"row", row_name(system.joints[static_cast<std::size_t>(r.joint)], r.row)},
                         {"implied by", others},
                         {"lasting", r.lasting}});
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
          {"contacts", system.contacts.size()},
          {"forces", system.forces.size()},
          {"ledger integrals", system.n_z()},
          {"redundant rows", redundant},
          {"joint forces not unique", shared}};
}

Json choice_json(const ModalChoice& c) {
  Json modes = Json::array();
  for (const ConsideredMode& m : c.considered)
    modes.push_back({{"frequency [Hz]", m.frequency}, {"strain energy", m.energy}, {"left out of strain energy", m.left_energy},
                     {"left out of displacement", m.left_displacement}, {"kept", m.kept}});
  return {{"count", c.count}, {"reason", c.reason}, {"considered", modes}};
}

Json motion_json(const MotionEstimate& m) {
  return {{"deflection over size", m.deflection}, {"slope [rad]", m.slope}, {"spin [rad/s]", m.spin},
          {"excited up to [Hz]", m.excited_up_to},
          {"first frequency changed by inertia", m.by_rotation},
          {"first frequency changed by all loads", m.by_all_loads}};
}

Json flexible_json(const Model& model) {
  Json all = Json::array();
  for (const FlexibleReport& r : model.flexible) {
    Json one = {{"body", r.body}, {"basis", r.basis}, {"shapes", r.shapes}, {"lowest [Hz]", r.lowest}, {"highest [Hz]", r.highest},
                {"least damping", r.least_damping}, {"greatest damping", r.most_damping},
                {"mass share", r.mass ? Json{{"x", r.mass->x()}, {"y", r.mass->y()}, {"rotation", r.mass->z()}} : Json(nullptr)},
                {"compliance covered", r.compliance}, {"compliance covered least at", r.compliance_at}};
    if (r.choice) one["choice"] = choice_json(*r.choice);
    if (r.motion) one["rigid run"] = motion_json(*r.motion);
    all.push_back(std::move(one));
  }
  return all;
}

Json rehearsal_json(const Model& model) {
  if (!model.rehearsal) return nullptr;
  const Rehearsal& r = *model.rehearsal;
  return {{"reached [s]", r.until}, {"steps", r.steps}, {"time [s]", r.seconds}, {"trouble", r.trouble}};
}

Json method_json(const Scheme& scheme, const std::string& switched) {
  return {{"name", name(scheme)}, {"reason", scheme.reason}, {"changed in the run", switched.empty() ? Json(nullptr) : Json(switched)}};
}

Json scene_json(const Scene& scene) {
  return scene.filled_in.empty() ? Json(nullptr) : Json::parse(scene.filled_in, nullptr, false);
}

}  // namespace

std::string csv(const Table& table) {
  std::string out;
  for (std::size_t c = 0; c < table.columns(); ++c) {
    if (c) out += ',';
    out += csv_field(table.header[c]);
  }
  out += '\n';
  for (std::size_t r = 0; r < table.rows(); ++r)
    for (std::size_t c = 0; c < table.columns(); ++c) {
      if (c) out += ',';
      append_number(out, table.data[r * table.columns() + c]);
      if (c + 1 == table.columns()) out += '\n';
    }
  return out;
}

ResultsDirectory::ResultsDirectory(const fs::path& directory) : final_(directory) {
  std::error_code error;
  if (fs::exists(fs::symlink_status(final_, error)))
    throw std::runtime_error(final_.string() + ": exists already; name another directory with --out, or remove it");
  staging_ = final_;
  staging_ += ".part-" + std::to_string(::getpid());
  fs::create_directories(staging_ / "frames", error);
  if (error) throw std::runtime_error(staging_.string() + ": cannot be made (" + error.message() + "); name another place with --out");
}

ResultsDirectory::~ResultsDirectory() {
  std::error_code error;
  if (!committed_) fs::remove_all(staging_, error);
}

void ResultsDirectory::commit() {
  std::error_code error;
  if (fs::is_empty(staging_ / "frames", error)) fs::remove(staging_ / "frames", error);
  fs::rename(staging_, final_, error);
  if (error) {
    committed_ = true;  // keep what there is
    throw std::runtime_error(final_.string() + ": cannot be made (" + error.message() + "); the results are in " + staging_.string());
  }
  committed_ = true;
}

std::string run_json(const Scene& scene, const Model& model, const Assembly& assembly, const Run& run) {
  const System& system = model.system;
  Json losses = Json::object();
  for (int i = 0; i < system.n_z(); ++i) {
    const std::size_t last = run.ledger.rows();
    if (last > 0)
      losses[integral_name(system, system.integrals[static_cast<std::size_t>(i)])] =
          run.ledger.data[(last - 1) * run.ledger.columns() + first_integral(system) + static_cast<std::size_t>(i)];
  }
  Json contacts = Json::object();
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& p = system.contacts[c];
    Json& out = contacts[system.contact_names[c]] = {{"model", model.clearances[c]}};
    if (p.link < 0) {
      out["stiffness [N/m^n]"] = p.normal.k;
      out["exponent"] = p.normal.n;
      out["hysteresis factor"] = p.normal.chi;
      out["damping [N s/m]"] = p.normal.d;
      if (p.normal.d == 0) out["restitution delivered"] = effective_restitution(p.normal.chi);
    }
    out["journal radius [m]"] = p.gap.journal;
    out["bearing radius [m]"] = p.gap.bearing;
  }
  const Json out = {
      {"program", "pintle"},
      {"version", PINTLE_VERSION},
      {"title", scene.title},
      {"file", scene.file},
      {"status", status_text(run.status)},
      {"reason", run.reason},
      {"warnings", run.warnings},
      {"reached [s]", run.t_end},
      {"model", assembly_json(system, assembly)},
      {"method", method_json(model.scheme, run.switched)},
      {"flexible bodies", flexible_json(model)},
      {"rigid run", rehearsal_json(model)},
      {"contacts", contacts},
      {"energy at start [J]", energies_json(run.first)},
      {"energy at end [J]", energies_json(run.last)},
      {"ledger [J]", losses},
      {"unexplained [J]", run.unexplained},
      {"worst unexplained [J]", run.worst_unexplained},
      {"energy in play [J]", run.energy_in_play},
      {"worst scaled violation", {{"position", run.worst_position}, {"velocity", run.worst_velocity}}},
      {"counts",
       {{"steps", run.counts.steps},
        {"rejected", run.counts.rejected},
        {"evaluations", run.counts.evaluations},
        {"factorizations", run.counts.factorizations},
        {"events", run.counts.events},
        {"impacts", run.impacts.size()},
        {"partitions chosen", run.counts.partitions}}},
      {"timings [s]", {{"integration", run.seconds}}},
      {"scene", scene_json(scene)}};
  return out.dump(2) + "\n";
}

std::string check_json(const Scene& scene, const Model& model, const Assembly& assembly, const Price& price) {
  std::vector<std::string> warnings = model.warnings;
  for (std::string& w : doubts(model, assembly)) warnings.push_back(std::move(w));
  const Json out = {{"title", scene.title}, {"file", scene.file}, {"model", assembly_json(model.system, assembly)},
                    {"method", method_json(model.scheme, "")},
                    {"clearances", model.clearances},
                    {"flexible bodies", flexible_json(model)},
                    {"rigid run", rehearsal_json(model)},
                    {"price", Json::parse(price_json(price))},
                    {"warnings", warnings},
                    {"scene", scene_json(scene)}};
  return out.dump(2) + "\n";
}

void write_results(const fs::path& directory, const Scene& scene, const Model& model, const Assembly& assembly,
                   const Run& run) {
  write_text(directory / "trajectory.csv", csv(run.trajectory));
  write_text(directory / "ledger.csv", csv(run.ledger));
  write_text(directory / "events.csv", events_csv(model.system, run.impacts));
  write_text(directory / "run.json", run_json(scene, model, assembly, run));
}

}  // namespace pintle
