// The module pintle._core.
#include "framework/common/file.h"
#include "framework/common/stop_point.h"
#include "framework/report/csv_reader.h"
#include "meshes/limits.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

/// Raises pintle.errors.NAME with the parts of the message as attributes.
template <class Error>
void raise_placed(const char* name, const Error& e) {
  const py::object type = py::module_::import("pintle.errors").attr(name);
  const bool of_dict = e.file == "<dict>";  // whose text and lines nobody has seen
  const py::object error = type(of_dict ? e.file + ": " + (e.place.key.empty() ? "" : e.place.key + ": ") + e.message : e.what());
  const auto set = [&](const char* attribute, const std::string& text) {
    error.attr(attribute) = text.empty() ? py::object(py::none()) : py::object(py::str(text));
  };
  set("file", of_dict ? "" : e.file), set("key", e.place.key);
  error.attr("message") = e.message.empty() ? e.what() : e.message;
  error.attr("line") = e.place.line > 0 && !of_dict ? py::object(py::int_(e.place.line)) : py::object(py::none());
  PyErr_SetObject(type.ptr(), error.ptr());
}

bool stop_meshing() {
  if (is_asked_to_stop()) return true;
  const py::gil_scoped_acquire held;
  if (PyErr_CheckSignals() == 0) return false;
  PyErr_Clear();  // MeshingStopped reports it
  return true;
}

}  // namespace

void bind_errors(py::module_& m) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const SceneError& e) {
      raise_placed("SceneError", e);
    } catch (const AssemblyError& e) {
      raise_placed("AssemblyError", e);
    } catch (const FileError& e) {
      PyErr_SetString(PyExc_OSError, e.what());
    } catch (const ResultsError& e) {
      PyErr_SetString(PyExc_OSError, e.what());
    } catch (const MeshingStopped& e) {
      PyErr_SetString(PyExc_KeyboardInterrupt, e.what());
    }
  });
  MesherLimits limits = mesher_limits();
  limits.stop = stop_meshing;
  set_mesher_limits(limits);
  m.attr("version") = PINTLE_VERSION;
}

bool Watch::operator()(double) {
  constexpr std::chrono::milliseconds between{50};
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < between) return true;
  last_ = now;
  const py::gil_scoped_acquire held;
  if (PyErr_CheckSignals() == 0) return true;
  raised_.emplace();
  return false;
}

void Watch::raise(py::object result) {
  if (!raised_) return;
  if (!result.is_none()) raised_->value().attr("result") = std::move(result);
  raised_->restore();
  throw py::error_already_set();
}

py::tuple table(const Table& t, py::handle owner) {
  constexpr py::ssize_t size = sizeof(double);
  const auto rows = static_cast<py::ssize_t>(t.rows()), columns = static_cast<py::ssize_t>(t.columns());
  return py::make_tuple(t.header, numbers<double>(t.data.data(), {rows, columns}, {size * columns, size}, owner));
}

}  // namespace pintle::python

PYBIND11_MODULE(_core, m) {
  using namespace pintle::python;
  m.doc() = "Pintle's C++ API as the package pintle uses it.";
  bind_errors(m);
  bind_aside(m);
  bind_scene(m);
  bind_run(m);
  bind_questions(m);
  bind_bodies(m);
  bind_simulation(m);
  bind_studies(m);
}
