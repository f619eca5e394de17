// Runs, driven motions, inverse problems: analyses with a trajectory.
#include "framework/analysis/kinematics/inverse.h"
#include "framework/analysis/kinematics/kinematics.h"
#include "framework/output/results.h"
#include "framework/output/results_directory.h"
#include "framework/output/run_files.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

using Found = std::shared_ptr<RunResult>;

struct InverseResult {
  Found run;
  std::string how;
  std::vector<DriverEffort> efforts;
};

/// compute(prepared, listeners) without the interpreter; a signal's exception is raised with what was computed.
template <class Compute>
auto watched(const SceneSource& source, Question question, Compute compute) {
  Watch watch;
  const auto out = [&] {
    const py::gil_scoped_release free;
    Listeners listeners;
    listeners.progress = [&](double t) { return watch(t); };
    if (question == Question::kinematics)
      listeners.frame = [](const State&, const Equations&) {};  // the motion goes through its frames' times
    return compute(prepared(source, question), listeners);
  }();
  watch.raise(py::cast(out));
  return out;
}

Found run(const SceneSource& source) {
  return watched(source, Question::run, [](std::shared_ptr<const Prepared> p, const Listeners& listeners) {
    return std::make_shared<RunResult>(RunResult{p, simulate(p->scene, p->model, p->assembly, listeners)});
  });
}

Found driven(const SceneSource& source) {
  return watched(source, Question::kinematics, [](std::shared_ptr<const Prepared> p, const Listeners& listeners) {
    require_driven(p->scene, p->model, p->assembly);
    return std::make_shared<RunResult>(RunResult{p, kinematics(p->scene, p->model, p->assembly, listeners)});
  });
}

std::shared_ptr<InverseResult> inverted(const SceneSource& source) {
  return watched(source, Question::run, [](std::shared_ptr<const Prepared> p, const Listeners& listeners) {
    Inverse found = inverse(p->scene, p->model, p->assembly, listeners);
    const auto run = std::make_shared<RunResult>(RunResult{p, std::move(found.run)});
    return std::make_shared<InverseResult>(InverseResult{run, found.how, std::move(found.drivers)});
  });
}

py::list impacts(const RunResult& r) {
  py::list out;
  for (const Impact& i : r.run.impacts)
    out.append(py::make_tuple(r.of->model.system.contact_names[static_cast<std::size_t>(i.contact)], i.begin, i.end, i.approach,
                              i.separation, i.deepest, i.peak_force, i.lost, i.impulse));
  return out;
}

py::list happenings(const RunResult& r) {
  py::list out;
  for (const Happening& h : r.run.happenings) out.append(py::make_tuple(h.event, h.t, h.did));
  return out;
}

/// What `pintle run` leaves in a folder, but for frames and saved states.
void write(const RunResult& r, const std::filesystem::path& directory) {
  const py::gil_scoped_release free;
  ResultsDirectory results(directory);
  write_results(results.path(), r.of->scene, r.of->model, r.of->assembly, r.run);
  results.commit();
}

std::string info(const RunResult& r) { return run_json(r.of->scene, r.of->model, r.of->assembly, r.run); }

}  // namespace

void bind_run(py::module_& m) {
  py::class_<RunResult, std::shared_ptr<RunResult>>(m, "Run")
      .def_property_readonly("trajectory", [](py::object self) { return table(self.cast<const RunResult&>().run.trajectory, self); })
      .def_property_readonly("ledger", [](py::object self) { return table(self.cast<const RunResult&>().run.ledger, self); })
      .def_property_readonly("impacts", &impacts)
      .def_property_readonly("events", &happenings)
      .def_property_readonly("title", [](const RunResult& r) { return r.of->scene.title; })
      .def_property_readonly("status", [](const RunResult& r) { return std::string(status_text(r.run.status)); })
      .def_property_readonly("reason", [](const RunResult& r) { return r.run.reason; })
      .def_property_readonly("warnings", [](const RunResult& r) { return r.run.warnings; })
      .def_property_readonly("end", [](const RunResult& r) { return r.run.t_end; })
      .def_property_readonly("steps", [](const RunResult& r) { return r.run.counts.steps; })
      .def_property_readonly("unexplained", [](const RunResult& r) { return r.run.unexplained; })
      .def_property_readonly("energy_in_play", [](const RunResult& r) { return r.run.energy_in_play; })
      .def_property_readonly("info", &info)
      .def("write", [](const RunResult& r, const std::string& directory) { write(r, directory); });
  py::class_<InverseResult, std::shared_ptr<InverseResult>>(m, "Inverse")
      .def_property_readonly("run", [](const InverseResult& r) { return r.run; })
      .def_property_readonly("how", [](const InverseResult& r) { return r.how; })
      .def_property_readonly("efforts", [](py::object self) {
        py::list out;
        for (const DriverEffort& e : self.cast<const InverseResult&>().efforts)
          out.append(py::make_tuple(e.name, e.turns ? "N m" : "N", vector(e.t, self), vector(e.value, self), e.error));
        return out;
      });
  m.def("run", &run);
  m.def("kinematics", &driven);
  m.def("inverse", &inverted);
}

}  // namespace pintle::python
