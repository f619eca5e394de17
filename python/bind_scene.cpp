// Scenes: read from text and prepared for an analysis.
#include "files/trust.h"
#include "framework/analysis/cost/cost_estimate.h"
#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/library_threads.h"
#include "framework/output/results.h"
#include "framework/scene/text_file.h"
#include "python/bindings.h"

namespace pintle::python {

namespace {

SceneSource read(std::string text, std::string name, std::filesystem::path folder, Overrides set, std::vector<FunctionLaw> functions,
                 std::shared_ptr<BodyStore> bodies) {
  Scene scene = read_scene_text(text, name, set, folder);
  put_functions(scene, functions);
  return {std::move(text), std::move(name), std::move(folder), std::move(set), std::move(functions), std::move(bodies), std::move(scene)};
}

SceneSource read_file(const std::filesystem::path& file, Overrides set) {
  constexpr std::size_t most_bytes = std::size_t{100} << 20;
  return read(read_text_file(file, most_bytes), file.string(), file.parent_path(), std::move(set), {}, std::make_shared<BodyStore>());
}

SceneSource read_text(std::string text, std::string name, const std::filesystem::path& folder, Overrides set) {
  return read(std::move(text), std::move(name), folder, std::move(set), {}, std::make_shared<BodyStore>());
}

SceneSource with_set(const SceneSource& of, const Overrides& more) {
  Overrides set = of.set;
  set.insert(set.end(), more.begin(), more.end());
  return read(of.text, of.name, of.folder, std::move(set), of.functions, of.bodies);
}

SceneSource with_law(const SceneSource& of, const std::string& owner, py::object function, std::vector<std::string> signals) {
  const auto free = [](py::object* object) {
    const py::gil_scoped_acquire held;
    delete object;
  };
  SceneSource out = of;
  out.functions.push_back({owner, std::move(signals), {new py::object(std::move(function)), free}});
  put_functions(out.scene, {out.functions.back()});
  return out;
}

std::string check(const Source& source) {
  return aside([source] {
    hold_library_threads();
    Scene scene = source->scene;
    require_run(scene);
    scene = with_pieces(std::move(scene));
    const std::optional<Scene> moved = for_kinematics_alone(scene);
    if (moved) scene = *moved;
    const Model model = moved ? build(scene) : build_with_preliminary_run(scene);
    const Assembly assembly = assemble(scene, model);
    return check_json(scene, model, assembly, moved ? CostEstimate{} : estimate_cost(scene, model, assembly));
  });
}

/// As check, without a run and its cost.
std::string assembled(const Source& source) {
  return aside([source] {
    const auto p = prepared(*source, Question::statics);
    return check_json(p->scene, p->model, p->assembly, {});
  });
}

void trust(const std::vector<std::string>& folders, bool geo) {
  Trust out;
  out.geo = geo;
  for (const std::string& folder : folders) {
    if (!std::filesystem::is_directory(folder)) throw SceneError(folder + ": there is no such folder; name an existing one");
    out.folders.emplace_back(folder);
  }
  set_trust(std::move(out));
}

}  // namespace

std::shared_ptr<const Prepared> prepared(const SceneSource& source, Question question) {
  hold_library_threads();  // so that results do not depend on the number of cores
  Scene scene = source.scene;
  if (question == Question::run || question == Question::kinematics) require_run(scene);
  if (question == Question::kinematics) scene = ready_for_kinematics(std::move(scene));
  if (question == Question::statics) scene = ready_for_statics(std::move(scene));
  if (question != Question::kinematics) scene = with_pieces(std::move(scene));
  Model model = build(scene, *source.bodies);
  Assembly assembly = assemble(scene, model);
  return std::make_shared<const Prepared>(Prepared{std::move(scene), std::move(model), std::move(assembly)});
}

void bind_scene(py::module_& m) {
  py::class_<SceneSource, std::shared_ptr<SceneSource>>(m, "Scene")
      .def_static("of_file", [](const std::string& file, Overrides set) { return read_file(file, std::move(set)); })
      .def_static("of_text", [](std::string text, std::string name, const std::string& folder,
                                Overrides set) { return read_text(std::move(text), std::move(name), folder, std::move(set)); })
      .def("set", &with_set)
      .def("with_law", &with_law)
      .def("check", &check)
      .def("assembled", &assembled)
      .def_property_readonly("title", [](const SceneSource& s) { return s.scene.title; })
      .def_property_readonly("name", [](const SceneSource& s) { return s.name; })
      .def_property_readonly("parameters",
                             [](const SceneSource& s) {
                               std::vector<std::pair<std::string, double>> out;
                               for (const SceneParameter& p : s.scene.parameters) out.emplace_back(p.name, p.value);
                               return out;
                             })
      .def_property_readonly("warnings", [](const SceneSource& s) { return s.scene.warnings; })
      .def_property_readonly("filled_in", [](const SceneSource& s) { return s.scene.filled_in; });
  m.def("trust", &trust);
}

}  // namespace pintle::python
