// Analyses with a trajectory: runs, kinematics, inverse dynamics.
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
  std::shared_ptr<const Prepared> of;
  std::shared_ptr<const Inverse> found;
};

/// Calls compute(prepared, listeners) without holding the interpreter. If a signal handler raises an exception, it gets what was computed.
template <class Compute>
auto watched(const Source& source, Question question, Compute compute) {
  const auto p = aside([=] { return prepared(*source, question); });
  Watch watch;
  auto out = [&] {
    const py::gil_scoped_release free;
    Listeners listeners;
    listeners.progress = [&](double t) { return watch(t); };
    if (question == Question::kinematics)
      listeners.frame = [](const State&, const Equations&) {};  // so that the motion is computed at the times of frames
    return compute(p, listeners);
  }();
  watch.raise(py::cast(out));
  return out;
}

Found run(const Source& source) {
  return watched(source, Question::run, [](const std::shared_ptr<const Prepared>& p, const Listeners& listeners) {
    return std::make_shared<RunResult>(RunResult{p, std::make_shared<Run>(simulate(p->scene, p->model, p->assembly, listeners))});
  });
}

Found driven(const Source& source) {
  return watched(source, Question::kinematics, [](const std::shared_ptr<const Prepared>& p, const Listeners& listeners) {
    require_driven(p->scene, p->model, p->assembly);
    return std::make_shared<RunResult>(RunResult{p, std::make_shared<Run>(kinematics(p->scene, p->model, p->assembly, listeners)), true});
  });
}

std::shared_ptr<InverseResult> inverted(const Source& source) {
  return watched(source, Question::run, [](const std::shared_ptr<const Prepared>& p, const Listeners& listeners) {
    return std::make_shared<InverseResult>(
        InverseResult{p, std::make_shared<Inverse>(inverse(p->scene, p->model, p->assembly, listeners))});
  });
}

py::list impacts(const RunResult& r) {
  py::list out;
  for (const Impact& i : r.run->impacts)
    out.append(py::make_tuple(r.of->model.system.contact_names[static_cast<std::size_t>(i.contact)], i.begin, i.end, i.approach,
                              i.separation, i.deepest, i.peak_force, i.lost, i.impulse));
  return out;
}

py::list happenings(const RunResult& r) {
  py::list out;
  for (const Happening& h : r.run->happenings) out.append(py::make_tuple(h.event, h.t, h.did));
  return out;
}

/// Writes the files of the program into a new folder, except frames and saved states.
template <class Write>
void write_new(const std::string& directory, Write write) {
  const py::gil_scoped_release free;
  ResultsDirectory results(directory);
  write(results.path());
  results.commit();
}

void write(const RunResult& r, const std::string& directory) {
  const Prepared& p = *r.of;
  write_new(directory, [&](const std::filesystem::path& folder) {
    if (r.driven)
      write_kinematics(folder, p.scene, p.model, *r.run);
    else
      write_results(folder, p.scene, p.model, p.assembly, *r.run);
  });
}

std::string info(const RunResult& r) {
  const Prepared& p = *r.of;
  return r.driven ? kinematics_json(p.scene, p.model, *r.run) : run_json(p.scene, p.model, p.assembly, *r.run);
}

py::list efforts(py::object self) {
  py::list out;
  for (const DriverEffort& e : self.cast<const InverseResult&>().found->drivers)
    out.append(py::make_tuple(e.name, e.turns ? "N m" : "N", vector(e.t, self), vector(e.value, self), e.error));
  return out;
}

}  // namespace

void bind_run(py::module_& m) {
  py::class_<RunResult, std::shared_ptr<RunResult>>(m, "Run")
      .def_property_readonly("trajectory", [](py::object self) { return table(self.cast<const RunResult&>().run->trajectory, self); })
      .def_property_readonly("ledger", [](py::object self) { return table(self.cast<const RunResult&>().run->ledger, self); })
      .def_property_readonly("impacts", &impacts)
      .def_property_readonly("events", &happenings)
      .def_property_readonly("title", [](const RunResult& r) { return r.of->scene.title; })
      .def_property_readonly("status", [](const RunResult& r) { return std::string(status_text(r.run->status)); })
      .def_property_readonly("reason", [](const RunResult& r) { return r.run->reason; })
      .def_property_readonly("warnings", [](const RunResult& r) { return r.run->warnings; })
      .def_property_readonly("end", [](const RunResult& r) { return r.run->t_end; })
      .def_property_readonly("steps", [](const RunResult& r) { return r.run->counts.steps; })
      .def_property_readonly("unexplained", [](const RunResult& r) { return r.run->unexplained; })
      .def_property_readonly("energy_in_play", [](const RunResult& r) { return r.run->energy_in_play; })
      .def_property_readonly("info", &info)
      .def("write", &write);
  py::class_<InverseResult, std::shared_ptr<InverseResult>>(m, "Inverse")
      .def_property_readonly("run",
                             [](const InverseResult& r) {
                               return std::make_shared<RunResult>(RunResult{r.of, {r.found, &r.found->run}});
                             })
      .def_property_readonly("how", [](const InverseResult& r) { return r.found->how; })
      .def_property_readonly("efforts", &efforts)
      .def_property_readonly("info", [](const InverseResult& r) { return inverse_json(r.of->scene, r.of->model, *r.found); })
      .def("write", [](const InverseResult& r, const std::string& directory) {
        write_new(directory, [&](const auto& folder) { write_inverse(folder, r.of->scene, r.of->model, r.of->assembly, *r.found); });
      });
  m.def("run", &run);
  m.def("kinematics", &driven);
  m.def("inverse", &inverted);
}

}  // namespace pintle::python
