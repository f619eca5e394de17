// Python functions as laws of the scene.
#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "framework/common/nearest.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

/// Value of a Python function: one number, or for a force one of its two components. Called with the interpreter held, from any thread.
class Called {
 public:
  Called(const FunctionLaw& law, int component) : is_(law.is), owner_(law.owner), component_(component) {
    for (const std::string& name : law.of) times_.push_back(name == "t");
  }
  double operator()(double t, const std::vector<double>& in) const {
    const py::gil_scoped_acquire held;
    py::tuple arguments(times_.size());
    std::size_t next = 0;
    for (std::size_t i = 0; i < times_.size(); ++i) arguments[i] = times_[i] ? t : in[next++];
    return number((*is_)(*arguments));
  }

 private:
  double number(const py::object& given) const {
    try {
      if (component_ < 0) return given.cast<double>();
      if (py::isinstance<py::sequence>(given) && py::len(given) == 2) return py::object(given[py::int_(component_)]).cast<double>();
    } catch (const py::cast_error&) {  // reported below
    }
    throw py::type_error("the function that replaces the law of \"" + owner_ + "\" returned " + py::repr(given).cast<std::string>() +
                         "; it must return " + (component_ < 0 ? "a number" : "two numbers, the force along x and along y"));
  }

  std::shared_ptr<py::object> is_;
  std::string owner_;
  int component_;                 ///< −1: the function returns one number
  std::vector<bool> times_ = {};  ///< which arguments are the time
};

/// Central differences with steps of the cube root of rounding, relative to the argument or, if that is smaller, to `least`.
double step_of(double x) {
  constexpr double part = 6e-6, least = 1e-3;
  return part * std::max(std::abs(x), least);
}

SignalFunction of_signals(const FunctionLaw& law, int component) {
  const auto n = static_cast<std::size_t>(std::ranges::count_if(law.of, [](const std::string& name) { return name != "t"; }));
  return [called = Called(law, component), n](double t, const double* in, double* slope) {
    std::vector<double> x(in, in + n);
    if (slope) {
      for (std::size_t i = 0; i < n; ++i) {
        const double h = step_of(in[i]);
        x[i] = in[i] + h;
        const double above = called(t, x);
        x[i] = in[i] - h;
        slope[i] = (above - called(t, x)) / (2 * h);
        x[i] = in[i];
      }
    }
    return called(t, x);
  };
}

Law law_of(const FunctionLaw& function, int component = -1) {
  Law law;
  law.text = "by the Python function " + py::str(py::getattr(*function.is, "__name__", *function.is)).cast<std::string>();
  law.constant = false;
  for (const std::string& name : function.of)
    if (name == "t")
      law.uses_time = true;
    else
      law.signals.push_back(name);
  if (law.signals.empty())
    law.at = [called = Called(function, component)](double t) { return Jet{called(t, {})}; };
  else
    law.of_signals = of_signals(function, component);
  return law;
}

void put(SceneLoad& load, const FunctionLaw& function, const std::string& file) {
  if (auto* force = std::get_if<SceneForce>(&load.what)) {
    force->x = law_of(function, 0), force->y = law_of(function, 1);
  } else if (auto* torque = std::get_if<SceneTorque>(&load.what)) {
    torque->law = law_of(function);
  } else if (auto* spring = std::get_if<SceneSpring>(&load.what)) {
    spring->law = law_of(function);
  } else if (auto* torsion = std::get_if<SceneTorsionSpring>(&load.what)) {
    torsion->law = law_of(function);
  } else {
    throw SceneError(file, load.place, "has no law that a function can replace; name a force, a torque, a spring or a torsion spring");
  }
}

}  // namespace

void put_functions(Scene& scene, const std::vector<FunctionLaw>& functions) {
  for (const FunctionLaw& function : functions) {
    std::vector<std::string> known;
    bool found = false;
    const auto see = [&](auto& all, const auto& act) {
      for (auto& one : all) {
        known.push_back(one.name);
        if (one.name == function.owner) act(one), found = true;
      }
    };
    see(scene.loads, [&](SceneLoad& load) { put(load, function, scene.file); });
    see(scene.states, [&](SceneState& state) { state.rate = law_of(function); });
    see(scene.outputs, [&](SceneOutput& output) { output.law = law_of(function); });
    if (!found)
      throw SceneError(scene.file, {0, function.owner},
                       "is not a force, state or output of the scene." + did_you_mean(function.owner, known));
  }
}

}  // namespace pintle::python
