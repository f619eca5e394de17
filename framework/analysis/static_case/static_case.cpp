#include "framework/analysis/static_case/static_case.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include <nlohmann/json.hpp>

#include "framework/bodies/in_body.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/component/reduction/modal_model.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

using Json = nlohmann::ordered_json;

Json json(const Eigen::Vector2d& v) { return {v.x(), v.y()}; }
Json json(const Eigen::Vector3d& v) {
  Json out = {v.x(), v.y()};
  out.push_back(std::isnan(v.z()) ? Json(nullptr) : Json(v.z()));
  return out;
}

Json head(const Scene& scene, const ElasticBody& e, const char* command) {
  return {{"program", "pintle"},     {"version", PINTLE_VERSION}, {"command", command},       {"title", scene.title},
          {"file", scene.file},      {"body", e.scene->name},     {"nodes", e.mesh.x.cols()}, {"cells", e.mesh.cell_count()},
          {"freedoms", e.model.n()}, {"warnings", e.warnings}};
}

}  // namespace

std::vector<Field> static_fields(const BodyDrawing& drawing, const StaticReport& r) {
  const Eigen::Matrix4Xd s = drawing.stress(r.stress);
  Eigen::RowVectorXd mises(s.cols());
  Eigen::Matrix2Xd main(2, s.cols());
  for (Eigen::Index i = 0; i < s.cols(); ++i) {
    mises[i] = von_mises(s.col(i));
    main.col(i) = principal(s.col(i)).head<2>();
  }
  return {{"displacement [m]", drawing.displacement(r.solution.u)},
          {"von Mises [Pa]", mises},
          {"principal 1 [Pa]", main.row(0)},
          {"principal 2 [Pa]", main.row(1)},
          {"stress xx [Pa]", s.row(0)},
          {"stress yy [Pa]", s.row(1)},
          {"stress xy [Pa]", s.row(2)},
          {"stress zz [Pa]", s.row(3)}};
}

std::string section_forces_csv(const ElasticBody& e, const StaticReport& r) {
  const Eigen::Matrix3Xd& forces = r.stress.section_forces;
  std::string out = "element,end,x [m],y [m],N [N],V [N],M [N m]\n";
  const std::vector<int>& nodes = e.mesh.cells.front().nodes;
  for (Eigen::Index c = 0; c < forces.cols(); ++c) {
    out += std::to_string(c / 2 + 1) + "," + std::to_string(c % 2 + 1);
    const auto at = e.mesh.x.col(nodes[static_cast<std::size_t>(c)]);
    for (const double v : {at.x(), at.y(), forces(0, c), forces(1, c), forces(2, c)}) {
      out += ',';
      append_number(out, v);
    }
    out += '\n';
  }
  return out;
}

std::string points_csv(const StaticReport& r) {
  std::string out = "point,x [m],y [m],u_x [m],u_y [m],rotation [rad]\n";
  for (const PortDisplacement& p : r.ports) {
    out += csv_field(p.name);
    for (const double v : {p.x.x(), p.x.y(), p.u.x(), p.u.y(), p.u.z()}) {
      out += ',';
      append_number(out, v);
    }
    out += '\n';
  }
  return out;
}

namespace {

/// Each support's share of the reactions; a degree of freedom held twice counts for the first.
std::vector<SupportReaction> share(const ElasticBody& e, const std::vector<NamedSupport>& supports, Eigen::VectorXd reactions) {
  const Eigen::MatrixX3d rigid = rigid_motions(e.model);
  std::vector<SupportReaction> out;
  for (const NamedSupport& s : supports) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int f : s.held.dofs) {
      sum += rigid.row(f).transpose() * reactions[f];
      reactions[f] = 0;
    }
    out.push_back({s.at, sum});
  }
  return out;
}

/// Section forces are first those of the displacements; loads between the nodes are then subtracted: the end of an element carries K u − p,
/// rotated into its axes, with the opposite sign at end 1.
void take_off(const ElasticBody& e, const Eigen::MatrixXd& on_beams, Eigen::Matrix3Xd& forces) {
  const std::vector<int>& nodes = e.mesh.cells.front().nodes;
  for (Eigen::Index i = 0; i < on_beams.cols(); ++i) {
    const auto node = [&](Eigen::Index end) { return e.mesh.x.col(nodes[static_cast<std::size_t>(2 * i + end)]); };
    const Eigen::Vector2d t = (node(1) - node(0)).normalized();
    for (const int end : {0, 1}) {
      const Eigen::Vector3d p = on_beams.col(i).segment<3>(3 * end);
      const Eigen::Vector3d turned(t.dot(p.head<2>()), t.x() * p.y() - t.y() * p.x(), p.z());
      forces.col(2 * i + end) += end == 0 ? turned : Eigen::Vector3d(-turned);
    }
  }
}

}  // namespace

StaticReport report_of(const Scene& scene, const ElasticBody& e, const std::vector<NamedSupport>& supports, const BodyLoad& load,
                       StaticSolution solution) {
  StaticReport r;
  r.solution = std::move(solution);
  in_body(scene, *e.scene, [&] {
    r.stress = stress_field(e.model, r.solution.u, e.fibres);
    take_off(e, load.on_beams, r.stress.section_forces);
  });
  r.load = rigid_motions(e.model).transpose() * load.independent;
  r.reactions = share(e, supports, r.solution.reactions);
  for (const Port& p : e.model.ports) {
    Eigen::Vector3d u;
    for (int k = 0; k < 3; ++k) u[k] = p.dof[k] < 0 ? std::numeric_limits<double>::quiet_NaN() : r.solution.independent[p.dof[k]];
    r.ports.push_back({p.name, p.x, u});
  }
  const BodyDrawing drawing(e);
  Eigen::Index at = 0;
  r.greatest_displacement = drawing.displacement(r.solution.u).colwise().norm().maxCoeff(&at);
  r.displaced_at = drawing.points.col(at);
  const Eigen::Matrix4Xd s = drawing.stress(r.stress);
  for (Eigen::Index i = 0; i < s.cols(); ++i)
    if (const double v = von_mises(s.col(i)); v > r.greatest_stress) {
      r.greatest_stress = v;
      r.stressed_at = drawing.points.col(i);
    }
  return r;
}

StaticReport solve_case(const Scene& scene, const ElasticBody& e) {
  if (!scene.statics)
    throw SceneError(scene.file, {0, "static"},
                     "the scene has no static case; add one: static: {loads: {pull: {at: A, force: [100 N, 0]}}}");
  const std::vector<NamedSupport> supports = supports_of(scene, e);
  if (supports.empty())
    throw SceneError(scene.file, e.scene->place,
                     "\"" + e.scene->name + "\" has no supports, so a load would move it without limit; add supports: {A: fixed}");
  const BodyLoad load = loads_of(scene, e);
  const auto start = std::chrono::steady_clock::now();
  StaticSolution solution = in_body(scene, *e.scene, [&] { return solve_static(e.model, e.K, together(supports), load.independent); });
  StaticReport r = report_of(scene, e, supports, load, std::move(solution));
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return r;
}

std::string static_json(const Scene& scene, const ElasticBody& e, const StaticReport& r) {
  Json out = head(scene, e, "static"), reactions = Json::object(), ports = Json::object();
  for (const SupportReaction& s : r.reactions) reactions[s.at] = json(s.resultant);
  for (const PortDisplacement& p : r.ports) ports[p.name] = {{"at [m]", json(p.x)}, {"displacement [m, m, rad]", json(p.u)}};
  out["strain energy [J]"] = r.solution.strain_energy;
  out["residual"] = r.solution.residual;
  out["greatest displacement"] = {{"value [m]", r.greatest_displacement}, {"at [m]", json(r.displaced_at)}};
  out["greatest von Mises stress"] = {{"value [Pa]", r.greatest_stress}, {"at [m]", json(r.stressed_at)}};
  if (e.plate()) out["greatest stress jump between elements"] = r.stress.jump;
  out["load [N, N, N m]"] = json(r.load);
  out["reactions [N, N, N m]"] = reactions;
  out["points"] = ports;
  out["timings [s]"] = {{"mesh", e.mesh_seconds}, {"assembly", e.assembly_seconds}, {"solution", r.seconds}};
  return text_with_scene(out, scene);
}

void write_case(const std::filesystem::path& directory, const Scene& scene, const ElasticBody& e, const StaticReport& r) {
  const BodyDrawing drawing(e);
  write_grid(directory / "static.vtu", drawing.points, drawing.cells, static_fields(drawing, r));
  write_text(directory / "points.csv", points_csv(r));
  if (!e.plate()) write_text(directory / "section_forces.csv", section_forces_csv(e, r));
  write_text(directory / "static.json", static_json(scene, e, r));
}

std::string mesh_json(const Scene& scene, const ElasticBody& e) {
  Json out = head(scene, e, "mesh"), groups = Json::object();
  for (const Group& g : e.mesh.groups) groups[g.name] = g.nodes.size();
  const RigidInertia inertia = rigid_inertia(e.model, e.M);
  out["mass [kg]"] = inertia.m;
  out["centre [m]"] = json(Eigen::Vector2d(inertia.c / inertia.m));
  out["inertia about the centre [kg m^2]"] = inertia.J - inertia.c.squaredNorm() / inertia.m;
  out["nodes of each group"] = groups;
  if (e.plate())
    out["quality"] = {{"least scaled Jacobian", e.quality.least_jacobian},
                      {"mean scaled Jacobian", e.quality.mean_jacobian},
                      {"greatest aspect ratio", e.quality.greatest_aspect},
                      {"least corner angle [deg]", e.quality.least_angle * 180 / std::numbers::pi},
                      {"greatest corner angle [deg]", e.quality.greatest_angle * 180 / std::numbers::pi}};
  out["timings [s]"] = {{"mesh", e.mesh_seconds}, {"assembly", e.assembly_seconds}};
  return text_with_scene(out, scene);
}

void write_mesh_report(const std::filesystem::path& directory, const Scene& scene, const ElasticBody& e) {
  std::vector<Field> on_points, on_cells;
  for (const Group& g : e.mesh.groups) {
    Eigen::RowVectorXd in = Eigen::RowVectorXd::Zero(e.mesh.x.cols());
    for (const int node : g.nodes) in[node] = 1;
    on_points.push_back({"group " + g.name, in});
  }
  if (e.plate()) {
    Eigen::MatrixXd q(4, static_cast<Eigen::Index>(e.quality.cells.size()));
    for (Eigen::Index i = 0; i < q.cols(); ++i) {
      const CellQuality& c = e.quality.cells[static_cast<std::size_t>(i)];
      q.col(i) << c.jacobian, c.aspect, c.angle_min * 180 / std::numbers::pi, c.angle_max * 180 / std::numbers::pi;
    }
    on_cells = {
        {"scaled Jacobian", q.row(0)}, {"aspect ratio", q.row(1)}, {"least angle [deg]", q.row(2)}, {"greatest angle [deg]", q.row(3)}};
  }
  write_grid(directory / "mesh.vtu", e.mesh.x, e.mesh.cells, on_points, on_cells);
  write_text(directory / "mesh.json", mesh_json(scene, e));
}

}  // namespace pintle
