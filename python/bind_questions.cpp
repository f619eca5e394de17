// Analyses without a run: static equilibrium, linearisation, modes of one body.
#include <numbers>

#include "framework/analysis/linearize/linearize.h"
#include "framework/analysis/natural_modes/natural_modes.h"
#include "framework/common/library_threads.h"
#include "framework/configuration/equilibrium.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

struct Rest {
  std::shared_ptr<const Prepared> of;
  Equilibrium found;
};

struct SmallMotionResult {
  std::shared_ptr<const Prepared> of;
  Linearization found;
  std::string trouble = {};  ///< why there is no result
};

struct BodyModes {
  ModesReport found;
  std::string body;
};

std::shared_ptr<Rest> rest(const Source& source, double at) {
  return aside([source, at] {
    const auto p = prepared(*source, Question::statics);
    return std::make_shared<Rest>(Rest{p, find_equilibrium(p->scene, p->model, p->assembly, at)});
  });
}

/// The state to linearise about, as in `pintle linearize`.
State about(const SceneSource& source, const Prepared& p, std::optional<double> at, bool at_rest, SmallMotionResult& out) {
  if (at_rest) {
    const Equilibrium found = find_equilibrium(p.scene, p.model, p.assembly, at.value_or(0));
    if (!found.found) out.trouble = "no equilibrium to linearize about: " + found.reason;
    return found.state;
  }
  if (!at) {
    LinearizedStart start = linearized_start(p.scene, p.model, p.assembly);
    if (!start.note.empty()) out.found.notes.push_back(start.note);
    return std::move(start.state);
  }
  require_run(source.scene);
  return state_at(p.model, p.assembly.start, *at);
}

std::shared_ptr<SmallMotionResult> linearized(const SceneSource& source, std::optional<double> at, bool at_rest) {
  const auto p = prepared(source, Question::small_motion);
  auto out = std::make_shared<SmallMotionResult>(SmallMotionResult{p, {}});
  const State state = about(source, *p, at, at_rest, *out);
  if (!out->trouble.empty()) return out;
  const std::vector<std::string> notes = std::move(out->found.notes);
  out->found = linearize(p->scene, p->model, state, at_rest ? Laws::hold : Laws::go_on);
  out->found.notes.insert(out->found.notes.end(), notes.begin(), notes.end());
  return out;
}

std::shared_ptr<SmallMotionResult> small_motion(const Source& source, std::optional<double> at, bool at_rest) {
  return aside([=] { return linearized(*source, at, at_rest); });
}

std::shared_ptr<BodyModes> modes(const Source& source, const std::string& body, int count) {
  return aside([=] {
    hold_library_threads();
    const ElasticBody e = elastic_body(source->scene, elastic_of(source->scene, body));
    return std::make_shared<BodyModes>(BodyModes{modes_of(source->scene, e, count), e.scene->name});
  });
}

py::list small_modes(py::object self) {
  py::list out;
  for (const LinearMode& m : self.cast<const SmallMotionResult&>().found.modes)
    out.append(
        py::make_tuple(kind_text(m.kind), m.frequency(), m.natural(), m.damping(), m.root, m.carrier, m.share, vector(m.shape, self)));
  return out;
}

/// (title, frequencies [Hz], damping ratios, effective masses 3 × k, shapes)
py::object mode_table(const ModeTable& t, py::handle self) {
  const Eigen::VectorXd hertz = t.modes.omega / (2 * std::numbers::pi);
  return py::make_tuple(t.title, py::array_t<double>(hertz.size(), hertz.data()), vector(t.zeta, self), matrix(t.mass, self),
                        matrix(t.modes.shapes, self));
}

}  // namespace

void bind_questions(py::module_& m) {
  py::class_<Rest, std::shared_ptr<Rest>>(m, "Rest")
      .def_property_readonly("table", [](py::object self) { return table(self.cast<const Rest&>().found.table, self); })
      .def_property_readonly("found", [](const Rest& r) { return r.found.found; })
      .def_property_readonly("reason", [](const Rest& r) { return r.found.reason; })
      .def_property_readonly("warnings", [](const Rest& r) { return r.found.warnings; })
      .def_property_readonly("method", [](const Rest& r) { return r.found.method; })
      .def_property_readonly("judged", [](const Rest& r) { return r.found.stability.judged; })
      .def_property_readonly("unstable", [](const Rest& r) { return r.found.stability.unstable; })
      .def_property_readonly("neutral", [](const Rest& r) { return r.found.stability.neutral; })
      .def_property_readonly("freedoms", [](const Rest& r) { return r.found.stability.dofs; })
      .def_property_readonly("info", [](const Rest& r) { return equilibrium_json(r.of->scene, r.of->model, r.found); });

  using Small = SmallMotionResult;
  const auto of_space = [](Eigen::MatrixXd StateSpace::*part) {
    return [part](py::object self) { return matrix(self.cast<const Small&>().found.space.*part, self); };
  };
  py::class_<Small, std::shared_ptr<Small>>(m, "SmallMotion")
      .def_property_readonly("trouble", [](const Small& r) { return r.trouble; })
      .def_property_readonly("A", of_space(&StateSpace::A))
      .def_property_readonly("B", of_space(&StateSpace::B))
      .def_property_readonly("C", of_space(&StateSpace::C))
      .def_property_readonly("D", of_space(&StateSpace::D))
      .def_property_readonly("states", [](const Small& r) { return r.found.space.states; })
      .def_property_readonly("inputs", [](const Small& r) { return r.found.space.inputs; })
      .def_property_readonly("outputs", [](const Small& r) { return r.found.space.outputs; })
      .def_property_readonly("coordinates", [](const Small& r) { return r.found.coordinates; })
      .def_property_readonly("modes", &small_modes)
      .def_property_readonly("time", [](const Small& r) { return r.found.about.t; })
      .def_property_readonly("notes", [](const Small& r) { return r.found.notes; })
      .def_property_readonly("warnings", [](const Small& r) { return r.of->model.warnings; })
      .def_property_readonly("info", [](const Small& r) { return linearized_json(r.of->scene, r.found); });

  py::class_<BodyModes, std::shared_ptr<BodyModes>>(m, "BodyModes")
      .def_property_readonly("body", [](const BodyModes& r) { return r.body; })
      .def_property_readonly("rigid", [](const BodyModes& r) { return r.found.rigid; })
      .def_property_readonly("mass", [](const BodyModes& r) { return r.found.inertia.m; })
      .def_property_readonly("natural", [](py::object self) { return mode_table(self.cast<const BodyModes&>().found.natural, self); })
      .def_property_readonly("reduced", [](py::object self) {
        const auto& reduced = self.cast<const BodyModes&>().found.reduced;
        return reduced ? mode_table(*reduced, self) : py::object(py::none());
      });

  m.def("statics", &rest);
  m.def("linearize", &small_motion);
  m.def("modes", &modes);
}

}  // namespace pintle::python
