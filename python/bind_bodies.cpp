// One body of elements, or several in contact: the mesh, the static case.
#include "framework/analysis/static_case/contact_case.h"
#include "framework/analysis/static_case/static_case.h"
#include "framework/bodies/mesh_file_warnings.h"
#include "framework/common/library_threads.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

struct BodyMesh {
  Scene scene;
  ElasticBody body = {};
};

struct StaticCase {
  Scene scene;
  std::vector<ElasticBody> bodies = {};
  ContactCase found = {};
  std::vector<Table> fields = {};  ///< one per body, at the points of its drawing
  std::string info = {};
};

ElasticBody checked_body(const Scene& scene, const std::string& name) {
  ElasticBody e = elastic_body(scene, elastic_of(scene, name));
  if (std::string warning = size_warning(scene, e); !warning.empty()) e.warnings.push_back(std::move(warning));
  return e;
}

std::shared_ptr<BodyMesh> mesh(const Source& source, const std::string& name) {
  return aside([=] {
    hold_library_threads();
    auto out = std::make_shared<BodyMesh>(BodyMesh{source->scene});
    out->body = checked_body(out->scene, name);
    return out;
  });
}

/// The contents of static.vtu, a row for each point.
Table point_table(const ElasticBody& e, const StaticReport& report) {
  const BodyDrawing drawing(e);
  std::vector<Field> fields = static_fields(drawing, report);
  fields.insert(fields.begin(), {"position [m]", drawing.points});
  Table out;
  for (const Field& f : fields) {
    const bool vector = f.values.rows() == 2;
    const std::size_t unit = f.name.find(" [");
    for (const char* axis : {" x", " y"})
      if (vector) out.header.push_back(f.name.substr(0, unit) + axis + f.name.substr(unit));
    if (!vector) out.header.push_back(f.name);
  }
  out.data.reserve(out.header.size() * static_cast<std::size_t>(drawing.points.cols()));
  for (Eigen::Index i = 0; i < drawing.points.cols(); ++i)
    for (const Field& f : fields)
      for (Eigen::Index k = 0; k < f.values.rows(); ++k) out.data.push_back(f.values(k, i));
  return out;
}

std::shared_ptr<StaticCase> solved(const SceneSource& source, const std::string& name) {
  hold_library_threads();
  auto out = std::make_shared<StaticCase>(StaticCase{source.scene});
  const Scene& scene = out->scene;
  const bool touching = scene.statics && !scene.statics->contacts.empty();
  if (touching)
    for (const std::string& one : bodies_of(*scene.statics)) out->bodies.push_back(checked_body(scene, one));
  else
    out->bodies.push_back(checked_body(scene, name.empty() && scene.statics ? scene.statics->body : name));
  std::vector<const ElasticBody*> all;
  for (const ElasticBody& e : out->bodies) all.push_back(&e);
  if (touching)
    out->found = solve_contact_case(scene, all);
  else
    out->found.bodies.push_back(solve_case(scene, out->bodies.front()));
  for (std::size_t b = 0; b < all.size(); ++b) out->fields.push_back(point_table(*all[b], out->found.bodies[b]));
  out->info = touching ? contact_json(scene, all, out->found) : static_json(scene, out->bodies.front(), out->found.bodies.front());
  return out;
}

std::shared_ptr<StaticCase> static_case(const Source& source, const std::string& name) {
  return aside([=] { return solved(*source, name); });
}

/// One tuple per body: (name, (header, points × columns), points.csv, section_forces.csv or None)
py::list bodies(py::object self) {
  const auto& c = self.cast<const StaticCase&>();
  py::list out;
  for (std::size_t b = 0; b < c.bodies.size(); ++b) {
    const ElasticBody& e = c.bodies[b];
    const StaticReport& r = c.found.bodies[b];
    out.append(py::make_tuple(e.scene->name, table(c.fields[b], self), points_csv(r),
                              e.plate() ? std::nullopt : std::optional(section_forces_csv(e, r))));
  }
  return out;
}

py::list warnings(const StaticCase& c) {
  py::list out;
  for (const ElasticBody& e : c.bodies)
    for (const std::string& w : e.warnings) out.append(w);
  return out;
}

py::object nodes(py::object self) {
  const Eigen::Matrix2Xd& x = self.cast<const BodyMesh&>().body.mesh.x;
  constexpr py::ssize_t size = sizeof(double);
  return numbers<double>(x.data(), {x.cols(), 2}, {2 * size, size}, self);
}

/// (shape, cells × nodes)
py::list cells(py::object self) {
  py::list out;
  constexpr py::ssize_t size = sizeof(int);
  for (const Cells& c : self.cast<const BodyMesh&>().body.mesh.cells) {
    const py::ssize_t each = nodes_of(c.shape);
    out.append(py::make_tuple(name_of(c.shape),
                              numbers<int>(c.nodes.data(), {static_cast<py::ssize_t>(c.size()), each}, {each * size, size}, self)));
  }
  return out;
}

py::dict groups(py::object self) {
  py::dict out;
  for (const Group& g : self.cast<const BodyMesh&>().body.mesh.groups) out[py::str(g.name)] = vector(g.nodes, self);
  return out;
}

}  // namespace

void bind_bodies(py::module_& m) {
  py::class_<BodyMesh, std::shared_ptr<BodyMesh>>(m, "BodyMesh")
      .def_property_readonly("body", [](const BodyMesh& b) { return b.body.scene->name; })
      .def_property_readonly("nodes", &nodes)
      .def_property_readonly("cells", &cells)
      .def_property_readonly("groups", &groups)
      .def_property_readonly("warnings", [](const BodyMesh& b) { return b.body.warnings; })
      .def_property_readonly("info", [](const BodyMesh& b) { return mesh_json(b.scene, b.body); });
  py::class_<StaticCase, std::shared_ptr<StaticCase>>(m, "StaticCase")
      .def_property_readonly("bodies", &bodies)
      .def_property_readonly(
          "contacts", [](const StaticCase& c) { return c.found.contacts.empty() ? std::nullopt : std::optional(contacts_csv(c.found)); })
      .def_property_readonly("warnings", &warnings)
      .def_readonly("info", &StaticCase::info);
  m.def("mesh", &mesh);
  m.def("static_case", &static_case);
}

}  // namespace pintle::python
