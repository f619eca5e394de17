#include <algorithm>
#include <numbers>
#include <set>

#include <nlohmann/json.hpp>

#include "framework/analysis/linearize/linearize.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/mechanism/drawing.h"
#include "framework/mechanism/result_tables.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Eigen::Index;

const char* coefficients_text(Coefficients c) {
  switch (c) {
    case Coefficients::constant: return "constant";
    case Coefficients::turning: return "constant in turning axes";
    case Coefficients::frozen: return "frozen at this instant";
  }
  return "";
}

/// Appends a row of a text field and numbers.
void append_row(std::string& out, const std::string& name, const Eigen::VectorXd& values) {
  out += csv_field(name);
  for (const double x : values) {
    out += ',';
    append_number(out, x);
  }
  out += '\n';
}

std::string matrix_csv(const std::string& corner, const std::vector<std::string>& rows, const std::vector<std::string>& columns,
                       const Eigen::MatrixXd& A) {
  std::string out = csv_field(corner);
  for (const std::string& c : columns) out += ',' + csv_field(c);
  out += '\n';
  for (std::size_t i = 0; i < rows.size(); ++i) append_row(out, rows[i], A.row(static_cast<Index>(i)));
  return out;
}

std::string modes_csv(const Linearization& lin) {
  std::string out =
      "kind,frequency [Hz],natural frequency [Hz],damping ratio,decay [1/s],root real [1/s],root imaginary [1/s],"
      "uncertainty of root [1/s],roots,share of kinetic energy,moves most\n";
  for (const LinearMode& m : lin.modes) {
    out += kind_text(m.kind);
    for (const double x : {m.frequency(), m.natural(), m.damping(), 0 - m.root.real(), m.root.real(), m.root.imag(), m.uncertainty,
                           static_cast<double>(m.roots), m.share}) {
      out += ',';
      append_number(out, x);
    }
    out += ',' + csv_field(m.carrier) + '\n';
  }
  return out;
}

std::string shapes_csv(const Linearization& lin, int count) {
  const auto modes = std::min(lin.modes.size(), static_cast<std::size_t>(std::max(count, 0)));
  std::string out = "coordinate";
  for (std::size_t k = 1; k <= modes; ++k) out += ",mode " + std::to_string(k) + " real,mode " + std::to_string(k) + " imaginary";
  out += '\n';
  for (std::size_t i = 0; i < lin.coordinates.size(); ++i) {
    Eigen::VectorXd row(2 * static_cast<Index>(modes));
    for (std::size_t k = 0; k < modes; ++k) {
      const std::complex<double> x = lin.modes[k].shape[static_cast<Index>(i)];
      row.segment<2>(2 * static_cast<Index>(k)) << x.real(), x.imag();
    }
    append_row(out, lin.coordinates[i], row);
  }
  return out;
}

/// The enlarged motion of the first modes through a period each: where the bodies are, in the columns of trajectory.csv.
Table mode_motions(const Model& model, const Linearization& lin, int count) {
  constexpr int phases = 24;
  const Table all = trajectory_table(model);
  Table out{{"mode", "phase [rad]"}, {}};
  std::vector<std::size_t> kept;
  const std::vector<std::string> names = pose_columns(model);
  const std::set<std::string> wanted(names.begin(), names.end());
  for (std::size_t c = 0; c < all.columns(); ++c)
    if (wanted.contains(all.header[c].substr(0, all.header[c].rfind(" [")))) kept.push_back(c), out.header.push_back(all.header[c]);
  Equations eq(model.system);
  Eigen::VectorXd dy(model.system.n_y());
  for (std::size_t k = 0; k < std::min(lin.modes.size(), static_cast<std::size_t>(std::max(count, 0))); ++k)
    for (int i = 0; i <= phases; ++i) {
      const double phase = 2 * std::numbers::pi * i / phases;
      const State state = displaced(model, lin, lin.modes[k], phase);
      evaluate(model.system, state, eq, dy);
      Table row = all;
      record(model, state, eq, row);
      out.data.push_back(static_cast<double>(k + 1)), out.data.push_back(phase);
      for (const std::size_t c : kept) out.data.push_back(row.data[c]);
    }
  return out;
}

}  // namespace

std::string linearized_json(const Scene& scene, const Linearization& lin) {
  Json modes = Json::array(), contacts = Json::array();
  for (const LinearMode& m : lin.modes)
    modes.push_back({{"kind", kind_text(m.kind)},
                     {"frequency [Hz]", m.frequency()},
                     {"natural frequency [Hz]", m.natural()},
                     {"damping ratio", m.damping()},
                     {"decay [1/s]", 0 - m.root.real()},
                     {"root [1/s]", {m.root.real(), m.root.imag()}},
                     {"uncertainty of root [1/s]", m.uncertainty},
                     {"roots", m.roots},
                     {"moves most", m.carrier},
                     {"share of kinetic energy", m.share}});
  for (const LinearContact& c : lin.contacts)
    contacts.push_back({{"joint", c.name},
                        {"closed", c.closed},
                        {"depth [m]", c.depth},
                        {"normal force [N]", c.force},
                        {"stiffness [N/m]", c.stiffness},
                        {"damping [N s/m]", c.damping},
                        {"impact rate [m/s]", c.impact_rate}});
  const Json out = {{"program", "pintle"},
                    {"version", PINTLE_VERSION},
                    {"title", scene.title},
                    {"file", scene.file},
                    {"time [s]", lin.about.t},
                    {"coefficients", coefficients_text(lin.coefficients)},
                    {"axes turn at [rad/s]", lin.turn},
                    {"change of coefficients", lin.drift},
                    {"within [s]", lin.window},
                    {"free coordinates", lin.independent.size()},
                    {"modes", modes},
                    {"contacts", contacts},
                    {"states", lin.space.states},
                    {"inputs", lin.space.inputs},
                    {"outputs", lin.space.outputs},
                    {"notes", lin.notes}};
  return text_with_scene(out, scene);
}

void write_linearization(const fs::path& directory, const Scene& scene, const Model& model, const Linearization& lin, int shapes) {
  const StateSpace& s = lin.space;
  write_text(directory / "linearized.csv", modes_csv(lin));
  write_text(directory / "shapes.csv", shapes_csv(lin, shapes));
  write_csv(directory / "mode_motions.csv", mode_motions(model, lin, shapes));
  write_text(directory / "A.csv", matrix_csv("rate of", s.states, s.states, s.A));
  write_text(directory / "B.csv", matrix_csv("rate of", s.states, s.inputs, s.B));
  write_text(directory / "C.csv", matrix_csv("output", s.outputs, s.states, s.C));
  write_text(directory / "D.csv", matrix_csv("output", s.outputs, s.inputs, s.D));
  write_text(directory / "linearized.json", linearized_json(scene, lin));
}

}  // namespace pintle
