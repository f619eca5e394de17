// pintle-view SCENE, for `pintle view`: a page that shows a scene as written, to inspect and move by hand.
#include <CLI/CLI.hpp>

#include <iostream>

#include "app/failure.h"
#include "app/mistyped.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/view/server.h"
#include "framework/common/library_threads.h"
#include "framework/scene/error.h"

namespace {

using namespace pintle;
using namespace pintle::app;

int view(const std::string& scene, const Options& options, int port) {
  if (!std::filesystem::is_regular_file(scene)) throw SceneError(scene + ": no such file; name a scene (YAML)");
  set_bounds(options);
  ViewSession session(scene, overrides(options));
  ViewServer server(session, port);
  handle_signals();
  std::cout << "  " << server.address() << "\n  open it in a browser on this machine; Ctrl-C ends it" << std::endl;
  server.serve(asked_to_stop);
  return ok;
}

int carry_out(int argc, char** argv) {
  hold_library_threads();
  CLI::App command(
      "Shows a scene in the browser while it is being written: assembled, with its degrees of freedom, to be dragged through its motion.",
      "pintle view");
  std::string scene;
  Options options;
  int port = 0;
  command.add_option("scene", scene, "scene file (YAML); the page is updated whenever it or a file that it reads is saved")
      ->required()
      ->type_name("SCENE.yaml");
  command.add_option("--set", options.set, "override a parameter or key of the scene; may be repeated")
      ->allow_extra_args(false)
      ->type_name("NAME|PATH=VALUE");
  command.add_option("--allow-path", options.allowed, "also let the scene read files in this folder and its subfolders; may be repeated")
      ->allow_extra_args(false)
      ->type_name("DIR");
  command.add_option("--port", port, "port of 127.0.0.1 (default: any free port)")->type_name("N")->check(CLI::Range(1, 65535));
  command.footer(
      "The page is served to this machine only, under an address that nobody can guess, and nothing is written. Bodies are rigid\n"
      "there, drivers are released, clearances are closed. Exit codes: see pintle --help\n");
  return parse_and_run(command, argc, argv, [&] { return view(scene, options, port); });
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, carry_out); }
