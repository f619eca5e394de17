// Commands on one body of elements: modes, mesh and static.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>

#include "app/options.h"
#include "app/progress.h"
#include "app/run_end.h"
#include "app/waiting.h"
#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/analysis/static_case/contact_case.h"
#include "framework/analysis/static_case/static_case.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/common/work_done.h"
#include "framework/drawing/body_drawing.h"
#include "framework/output/results.h"
#include "framework/report/body_report.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

constexpr int default_frames = 24;
constexpr Eigen::Index frames_up_to = 30'000;  ///< nodes; larger bodies are animated only on request

/// x; 0 if it is only rounding relative to `scale`.
double tidy(double x, double scale) { return std::abs(x) < 1e-9 * scale ? 0 : x; }

std::string place(const Eigen::Vector2d& x, double size) {
  return "(" + number(tidy(x.x(), size)) + ", " + number(tidy(x.y(), size)) + ") m";
}

double size_of(const Mesh& mesh) { return (mesh.x.rowwise().maxCoeff() - mesh.x.rowwise().minCoeff()).norm(); }

std::string cells(const Mesh& mesh) {
  std::string out;
  for (const Cells& c : mesh.cells) out += (out.empty() ? "" : " + ") + std::to_string(c.size()) + " " + name_of(c.shape);
  return out;
}

void print_head(const Scene& scene) { std::cout << (scene.title.empty() ? scene.file : scene.title) << "\n"; }

void add_body(Rows& rows, const ElasticBody& e) {
  const RigidInertia inertia = rigid_inertia(e.model, e.M);
  rows.insert(rows.end(), {{"body", e.scene->name},
                           {"mesh", std::to_string(e.mesh.x.cols()) + " nodes, " + cells(e.mesh) + ", " + std::to_string(e.model.n()) +
                                        " degrees of freedom"},
                           {"mass", number(inertia.m) + " kg, centre " + place(inertia.c / inertia.m, 100 * size_of(e.mesh)) +
                                        ", inertia there " + number(inertia.J - inertia.c.squaredNorm() / inertia.m) + " kg m^2"}});
}

void print_warnings(const ElasticBody& e) {
  for (const std::string& w : e.warnings) std::cout << "  warning: " << w << "\n";
}

ElasticBody made(const Scene& scene, const std::string& name) {
  now_doing("meshing and assembling the body");
  ElasticBody e = elastic_body(scene, elastic_of(scene, name));
  if (const std::string warning = size_warning(scene, e); !warning.empty()) e.warnings.push_back(warning);
  return e;
}

std::string percent(double part, double whole) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", whole > 0 ? 100 * part / whole : 0);
  return text;
}

/// `residual`: also prints the remainder of K φ − ω² M φ, which is large for static shapes, since they are not modes of the body.
void print_table(const ModeTable& t, const ModesReport& r, bool residual) {
  std::printf("\n  %s\n  %4s %15s %9s %9s %11s %9s %10s\n", t.title.c_str(), "mode", "frequency [Hz]", "mass x %", "mass y %", "rotation %",
              "damping", residual ? "residual" : "");
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < t.modes.omega.size(); ++i) {
    sum += t.mass.col(i);
    std::printf("  %4d %15.8g %9s %9s %11s %9.4g", static_cast<int>(i + 1), t.modes.omega[i] / (2 * std::numbers::pi),
                percent(t.mass(0, i), r.inertia.m).c_str(), percent(t.mass(1, i), r.inertia.m).c_str(),
                percent(t.mass(2, i), r.centre_inertia).c_str(), t.zeta[i]);
    if (residual) std::printf(" %10.1e", t.modes.residual[i]);
    std::printf("\n");
  }
  if (t.modes.omega.size() == 0) std::printf("  none: the body stays rigid\n");
  std::printf("  %4s %15s %9s %9s %11s\n", "sum", "", percent(sum[0], r.inertia.m).c_str(), percent(sum[1], r.inertia.m).c_str(),
              percent(sum[2], r.centre_inertia).c_str());
  std::fflush(stdout);
}

void write_shapes(const fs::path& directory, const ElasticBody& e, const ModeTable& t, const std::string& prefix, int frames) {
  const BodyDrawing drawing(e);
  write_shapes(directory / (prefix + (prefix == "mode" ? "s.vtu" : ".vtu")), drawing, t.modes.shapes);
  if (frames < 1) return;
  for (Eigen::Index i = 0; i < t.modes.omega.size(); ++i) {
    char name[64];
    std::snprintf(name, sizeof name, "%s_%02d", prefix.c_str(), static_cast<int>(i + 1));
    write_shape_animation(directory, name, drawing, t.modes.shapes.col(i), frames);
    work_done = static_cast<double>(i + 1) / static_cast<double>(t.modes.omega.size());
  }
}

}  // namespace

int modes(const Options& options) {
  constexpr Eigen::Index most_drawn = 12;  // on the page of a report
  Waiting waiting(options.quiet || options.json);
  const Scene scene = read_scene(options.scene, overrides(options));
  const fs::path out = results_directory(options, "-modes");
  require_place(out);
  const ElasticBody e = made(scene, options.body);
  now_doing("finding the modes");
  const ModesReport report = modes_of(scene, e, options.count);
  const bool large = e.mesh.x.cols() > frames_up_to;
  const int frames = options.frames >= 0 ? options.frames : large ? 0 : default_frames;
  now_doing("writing the results");
  write_whole(options, out, [&](const fs::path& folder) {
    write_text(folder / "modes.csv", modes_csv(report.natural, report));
    write_text(folder / "modes.json", modes_json(scene, e, report));
    write_shapes(folder, e, report.natural, "mode", frames);
    const Eigen::MatrixXd& shapes = report.natural.modes.shapes;
    write_text(folder / "drawing.json", body_drawing(e, shapes.leftCols(std::min<Eigen::Index>(most_drawn, shapes.cols()))));
    if (!report.reduced) return;
    now_doing("writing the modes of the reduced body");
    write_text(folder / "reduced.csv", modes_csv(*report.reduced, report));
    write_shapes(folder, e, *report.reduced, "reduced", frames);
  });
  waiting.end();
  if (options.json) {
    std::cout << modes_json(scene, e, report);
  } else if (!options.quiet) {
    print_head(scene);
    Rows rows;
    add_body(rows, e);
    rows.emplace_back("rigid motions", std::to_string(report.rigid) + ", at 0 Hz, not listed");
    if (report.natural.modes.sturm)
      rows.emplace_back("Sturm count", std::to_string(*report.natural.modes.sturm) + " up to the last mode: none is missed");
    print_rows(std::cout, rows);
    print_table(report.natural, report, true);
    if (report.rigid == 3) std::cout << "  (free modes carry no momentum: their effective masses are zero)\n";
    if (report.reduced) print_table(*report.reduced, report, e.scene->elastic->modes->method == SceneModes::Method::normal);
    std::cout << "\n";
    print_warnings(e);
    if (frames == 0 && options.frames < 0) std::cout << "  no animations: the mesh is large; to write them, add --frames 24\n";
    print_rows(std::cout, {{"time", number(e.mesh_seconds, 3) + " s mesh, " + number(e.assembly_seconds, 3) + " s assembly, " +
                                        number(report.seconds, 3) + " s modes"},
                           {"results", out.string() + (frames > 0 ? ", animations " + (out / "mode_01.pvd").string() + " …" : "")}});
  }
  return ok;
}

int mesh(const Options& options) {
  Waiting waiting(options.quiet || options.json);
  const Scene scene = read_scene(options.scene, overrides(options));
  const fs::path out = results_directory(options, "-mesh");
  require_place(out);
  const ElasticBody e = made(scene, options.body);
  now_doing("writing the results");
  write_whole(options, out, [&](const fs::path& folder) { write_mesh_report(folder, scene, e); });
  waiting.end();
  if (options.json) {
    std::cout << mesh_json(scene, e);
  } else if (!options.quiet) {
    print_head(scene);
    Rows rows;
    add_body(rows, e);
    if (e.plate()) {
      const double degrees = 180 / std::numbers::pi;
      rows.emplace_back("scaled Jacobian", number(e.quality.least_jacobian, 3) + " least, " + number(e.quality.mean_jacobian, 3) +
                                               " mean (1 is best, at 0 a cell folds)");
      rows.emplace_back("aspect ratio", number(e.quality.greatest_aspect, 3) + " at most");
      rows.emplace_back("corner angles",
                        number(e.quality.least_angle * degrees, 3) + " to " + number(e.quality.greatest_angle * degrees, 3) + " deg");
    }
    for (const Group& g : e.mesh.groups) rows.emplace_back("group \"" + g.name + "\"", std::to_string(g.nodes.size()) + " nodes");
    for (const Port& p : e.model.ports) rows.emplace_back("point \"" + p.name + "\"", place(p.x, size_of(e.mesh)));
    rows.emplace_back("results", (out / "mesh.vtu").string());
    print_rows(std::cout, rows);
    print_warnings(e);
  }
  return ok;
}

namespace {

void add_case(Rows& rows, const ElasticBody& e, const StaticReport& r) {
  const double size = size_of(e.mesh), force = r.load.norm(), motion = r.greatest_displacement;
  const auto resultant = [&](const Eigen::Vector3d& f) {
    return number(tidy(f[0], force)) + " N, " + number(tidy(f[1], force)) + " N, " + number(tidy(f[2], force * size)) +
           " N m about the origin";
  };
  rows.emplace_back("loads together", resultant(r.load));
  for (const SupportReaction& s : r.reactions) rows.emplace_back("reaction at " + s.at, resultant(s.resultant));
  for (const PortDisplacement& p : r.ports)
    rows.emplace_back("moved: " + p.name, number(tidy(p.u[0], motion)) + " m, " + number(tidy(p.u[1], motion)) + " m" +
                                              (std::isnan(p.u[2]) ? "" : ", " + number(tidy(p.u[2], motion / size)) + " rad"));
  rows.emplace_back("greatest displacement", number(r.greatest_displacement) + " m at " + place(r.displaced_at, size));
  rows.emplace_back("greatest von Mises stress", number(r.greatest_stress * 1e-6) + " MPa at " + place(r.stressed_at, size));
  if (e.plate()) rows.emplace_back("stress jump", percent(r.stress.jump, 1) + " % between neighbouring elements (a sign of mesh error)");
  rows.emplace_back("strain energy", number(r.solution.strain_energy) + " J");
}

void add_contact(Rows& rows, const ContactReport& c) {
  const double force = c.force.norm(), turn = c.straight ? 1 : 180 / std::numbers::pi;
  rows.emplace_back(
      "contact " + c.scene->name,
      force == 0 ? "open" : number(tidy(c.force.x(), force)) + " N, " + number(tidy(c.force.y(), force)) + " N on " + c.scene->first.body);
  if (force == 0) return;
  rows.emplace_back("it touches", "from " + number(turn * c.from, 4) + " to " + number(turn * c.to, 4) +
                                      (c.straight ? " m along " : " deg round ") + c.scene->first.body + "." + c.scene->first.group);
  rows.emplace_back("greatest pressure", number(c.greatest_pressure * 1e-6) + " MPa");
}

int contact_statics(const Options& options, Waiting& waiting, const Scene& scene, const fs::path& out) {
  std::vector<ElasticBody> bodies;
  for (const std::string& name : bodies_of(*scene.statics)) bodies.push_back(made(scene, name));
  std::vector<const ElasticBody*> all;
  for (const ElasticBody& e : bodies) all.push_back(&e);
  now_doing("solving the static case");
  const ContactCase c = solve_contact_case(scene, all);
  now_doing("writing the results");
  write_whole(options, out, [&](const fs::path& folder) { write_contact_case(folder, scene, all, c); });
  waiting.end();
  if (options.json) {
    std::cout << contact_json(scene, all, c);
  } else if (!options.quiet) {
    print_head(scene);
    Rows rows;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      add_body(rows, bodies[b]);
      add_case(rows, bodies[b], c.bodies[b]);
    }
    for (const ContactReport& r : c.contacts) add_contact(rows, r);
    rows.emplace_back("results", (out / "contacts.csv").string());
    print_rows(std::cout, rows);
    for (const ElasticBody& e : bodies) print_warnings(e);
  }
  return ok;
}

}  // namespace

int statics(const Options& options) {
  Waiting waiting(options.quiet || options.json);
  const Scene scene = read_scene(options.scene, overrides(options));
  const fs::path out = results_directory(options, "-static");
  require_place(out);
  if (scene.statics && !scene.statics->contacts.empty()) return contact_statics(options, waiting, scene, out);
  const std::string name = !options.body.empty() || !scene.statics ? options.body : scene.statics->body;
  ElasticBody e = made(scene, name);
  if (const std::string warning = fibre_warning(e); !warning.empty()) e.warnings.push_back(warning);
  now_doing("solving the static case");
  const StaticReport r = solve_case(scene, e);
  now_doing("writing the results");
  write_whole(options, out, [&](const fs::path& folder) {
    write_case(folder, scene, e, r);
    write_text(folder / "drawing.json", body_drawing(e, r.solution.u, &r.stress));
  });
  waiting.end();
  if (options.json) {
    std::cout << static_json(scene, e, r);
  } else if (!options.quiet) {
    print_head(scene);
    Rows rows;
    add_body(rows, e);
    add_case(rows, e, r);
    rows.emplace_back("results", (out / "static.vtu").string());
    print_rows(std::cout, rows);
    print_warnings(e);
  }
  return ok;
}

}  // namespace pintle::app
