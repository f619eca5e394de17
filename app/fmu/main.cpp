// pintle-fmu SCENE, for `pintle fmu`: exports a scene as an FMU, which other programs simulate step by step (FMI 3.0).
#include <CLI/CLI.hpp>

#include <iostream>

#include "app/failure.h"
#include "app/fmu/export.h"
#include "app/mistyped.h"
#include "app/options.h"
#include "app/progress.h"
#include "framework/common/file_names.h"
#include "framework/common/library_threads.h"
#include "framework/scene/error.h"

namespace {

using namespace pintle;
using namespace pintle::app;
using fmi::FmuVariable;

std::string listed_names(const std::vector<FmuVariable>& variables, bool (*wanted)(const FmuVariable&)) {
  constexpr std::size_t most = 6;
  std::vector<std::string> names;
  for (const FmuVariable& v : variables)
    if (wanted(v)) names.push_back(v.name + (v.unit.empty() ? "" : " [" + v.unit + "]"));
  std::string out = std::to_string(names.size());
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) out += (i == 0 ? ": " : ", ") + names[i];
  return out + (names.size() > most ? ", …" : "");
}

int export_scene(const FmuOrder& order, bool quiet) {
  now_doing("exporting the scene");
  const ExportedFmu made = export_fmu(order);
  if (quiet) return ok;
  const std::vector<FmuVariable>& all = made.contents.variables;
  std::string files;
  for (const std::string& file : made.files) files += (files.empty() ? "" : ", ") + file;
  std::cout << made.contents.title << "\n";
  print_rows(std::cout, {{"inputs", listed_names(all, [](const FmuVariable& v) { return v.kind == FmuVariable::input; })},
                         {"outputs", listed_names(all, [](const FmuVariable& v) { return v.output; })},
                         {"events", listed_names(all, [](const FmuVariable& v) { return v.kind >= FmuVariable::happened; })},
                         {"parameters", listed_names(all, [](const FmuVariable& v) { return v.kind == FmuVariable::parameter; })},
                         {"files", files}});
  for (const std::string& warning : made.warnings) std::cout << "  warning: " << warning << "\n";
  std::cout << "  " << made.file.string() << "\n";
  return ok;
}

int carry_out(int argc, char** argv) {
  hold_library_threads();
  CLI::App command("Exports a scene as a co-simulation unit with event mode (FMI 3.0), which other programs step.", "pintle fmu");
  FmuOrder order;
  Options options;
  std::string scene, out;
  bool quiet = false;
  command.add_option("scene", scene, "scene file (YAML)")->required()->type_name("SCENE.yaml");
  command.add_option("-o,--out", out, "the unit to write; an existing file is replaced (default: SCENE.fmu in the current folder)")
      ->type_name("FILE.fmu");
  command
      .add_option("--input", order.inputs,
                  "a state of the scene whose rate is 0, for the importer to set; may be repeated (default: all such states that no "
                  "event of the scene sets)")
      ->allow_extra_args(false)
      ->type_name("STATE");
  command
      .add_option("--output", order.outputs,
                  "a column of trajectory.csv, e.g. \"gudgeon pin.normal\"; may be repeated (default: the scene's outputs, or all columns "
                  "if it has none). The others can be read too, as local variables")
      ->allow_extra_args(false)
      ->type_name("COLUMN");
  command.add_option("--set", options.set, "override a parameter or key of the scene, fixed in the unit; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME|PATH=VALUE");
  command.add_flag("-q,--quiet", quiet, "print errors only");
  command.footer(
      "The unit holds the scene, the files that it reads, and Pintle as a shared library for Linux on x86-64. docs/fmu.md says what an\n"
      "importer sees. Exit codes: see pintle --help\n");
  return parse_and_run(command, argc, argv, [&] {
    order.scene = scene, order.out = out;
    order.set = overrides(options);
    if (!order.out.empty() && ending_of(order.out) != ".fmu") throw SceneError("--out " + out + ": a unit is called NAME.fmu");
    return export_scene(order, quiet);
  });
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, carry_out); }
