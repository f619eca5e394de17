// A run step by step: advance to a time, read, set, advance again.
#include "framework/analysis/simulate/simulation.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

class ByHand {
 public:
  explicit ByHand(std::shared_ptr<const Prepared> p)
      : of_(std::move(p)), run_(std::make_unique<Simulation>(of_->scene, of_->model, of_->assembly, listeners())) {}

  bool advance(double t) {
    Simulation& simulation = under_way();
    bool on = false;
    try {
      const py::gil_scoped_release free;
      on = simulation.advance(t);
    } catch (...) {  // an exception of a Python function during a step
      run_.reset();
      throw;
    }
    watch_.raise();
    return on;
  }
  double time() const { return run_ || !found_ ? under_way().time() : found_->run->t_end; }
  void set(int state, double value) { under_way().set(state, value); }
  std::vector<double> now() { return under_way().now(); }
  std::vector<std::string> header() const { return trajectory_table(of_->model).header; }
  std::vector<std::pair<std::string, std::string>> states() const {
    std::vector<std::pair<std::string, std::string>> out;
    for (const OwnState& s : of_->model.system.states) out.emplace_back(s.name, s.unit);
    return out;
  }
  std::shared_ptr<RunResult> finish() {
    if (!found_) {
      found_ = std::make_shared<RunResult>(RunResult{of_, std::make_shared<Run>(under_way().finish())});
      run_.reset();
    }
    return found_;
  }

 private:
  Listeners listeners() {
    Listeners out;
    out.progress = [this](double t) { return watch_(t); };
    return out;
  }
  Simulation& under_way() const {
    if (!run_) throw std::runtime_error("the simulation has ended; make another one");
    return *run_;
  }

  std::shared_ptr<const Prepared> of_;
  Watch watch_;
  std::unique_ptr<Simulation> run_;  ///< empty when it has finished
  std::shared_ptr<RunResult> found_;
};

std::unique_ptr<ByHand> begin(const Source& source) {
  auto p = aside([source] { return prepared(*source, Question::run); });
  const py::gil_scoped_release free;
  return std::make_unique<ByHand>(std::move(p));
}

}  // namespace

void bind_simulation(py::module_& m) {
  py::class_<ByHand>(m, "Simulation")
      .def(py::init(&begin))
      .def("advance", &ByHand::advance)
      .def("set", &ByHand::set)
      .def("now", &ByHand::now)
      .def("finish", &ByHand::finish)
      .def_property_readonly("time", &ByHand::time)
      .def_property_readonly("header", &ByHand::header)
      .def_property_readonly("states", &ByHand::states);
}

}  // namespace pintle::python
