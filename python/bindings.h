#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/body_store.h"
#include "framework/scene/yaml/reader.h"

/// The Python module over the C++ API: each file binds one group of analyses. The user interface in Python, with names and tables,
/// is in pintle/*.py.
namespace pintle::python {

namespace py = pybind11;

/// A Python function that replaces a law of the scene.
struct FunctionLaw {
  std::string owner;               ///< a load, a state or an output
  std::vector<std::string> of;     ///< signals, and "t"
  std::shared_ptr<py::object> is;  ///< freed with the interpreter held
};

/// A scene: its text and what was read from it.
struct SceneSource {
  std::string text, name;
  std::filesystem::path folder;
  Overrides set;
  std::vector<FunctionLaw> functions;
  std::shared_ptr<BodyStore> bodies;  ///< shared with the scenes derived from this one
  Scene scene;
};

/// A scene prepared for an analysis, which its results refer to.
struct Prepared {
  Scene scene;
  Model model;
  Assembly assembly;
};
enum class Question { run, kinematics, statics, small_motion };
/// @throws SceneError, AssemblyError
std::shared_ptr<const Prepared> prepared(const SceneSource&, Question);
using Source = std::shared_ptr<const SceneSource>;

/// Result of a run, of kinematics, or the motion of inverse dynamics. Arrays in Python refer to its memory.
struct RunResult {
  std::shared_ptr<const Prepared> of;
  std::shared_ptr<const Run> run;
  bool driven = false;  ///< by kinematics
};

/// Handles Ctrl-C and other signals several times a second while C++ computes without the interpreter.
class Watch {
 public:
  /// As a listener of a run. @returns false: a signal's handler has raised an exception
  bool operator()(double = 0);
  /// Raises the handler's exception, with `result` as its attribute if there is one.
  void raise(py::object result = py::none());

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::optional<py::error_already_set> raised_;
};

/// compute() on a thread of its own, while this one handles signals without holding the interpreter. What a handler raises is thrown at once;
/// the computation then stops at its next stop_point, so it must own what it uses. The other exceptions are those of compute().
void compute_aside(std::function<void()> compute);
template <class Compute>
auto aside(Compute compute) {
  const auto out = std::make_shared<std::invoke_result_t<Compute>>();
  compute_aside([compute = std::move(compute), out] { *out = compute(); });
  return std::move(*out);
}

/// A read-only array over numbers of C++, which it does not own; keeps `owner` alive.
template <class T>
py::array numbers(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides, py::handle owner) {
  py::array out(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  out.attr("setflags")(py::arg("write") = false);
  return out;
}
template <class Matrix>
py::array matrix(const Matrix& m, py::handle owner) {
  using T = typename Matrix::Scalar;
  constexpr py::ssize_t size = sizeof(T);
  return numbers<T>(m.data(), {m.rows(), m.cols()}, {size * m.rowStride(), size * m.colStride()}, owner);
}
template <class Vector>
py::array vector(const Vector& v, py::handle owner) {
  using T = typename Vector::value_type;
  return numbers<T>(v.data(), {static_cast<py::ssize_t>(v.size())}, {sizeof(T)}, owner);
}
/// (header, rows × columns)
py::tuple table(const Table&, py::handle owner);

/// Replaces laws by Python functions. @throws SceneError  nothing with that name has a law
void put_functions(Scene&, const std::vector<FunctionLaw>&);

void bind_errors(py::module_&);
void bind_aside(py::module_&);
void bind_scene(py::module_&);
void bind_run(py::module_&);
void bind_questions(py::module_&);
void bind_bodies(py::module_&);
void bind_simulation(py::module_&);
void bind_studies(py::module_&);

}  // namespace pintle::python
