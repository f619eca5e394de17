// pintle-hdf5 DIR, for `pintle hdf5` and `pintle run --hdf5`: the tables of a folder of results as one HDF5 file.
#include <CLI/CLI.hpp>

#include <iostream>
#include <stdexcept>

#include "app/failure.h"
#include "app/hdf5/convert.h"
#include "app/mistyped.h"
#include "app/options.h"
#include "app/progress.h"
#include "framework/common/file_names.h"
#include "framework/common/text.h"
#include "framework/output/results_directory.h"
#include "framework/report/csv_reader.h"
#include "framework/report/description.h"
#include "framework/scene/error.h"

namespace {

namespace fs = std::filesystem;
using namespace pintle;
using namespace pintle::app;

/// @throws SceneError  the command line is wrong   @throws std::runtime_error
void validate_places(const fs::path& directory, const fs::path& file) {
  if (ending_of(file) != ".h5" && ending_of(file) != ".hdf5")
    throw SceneError(file.string() + ": an HDF5 file is called NAME.h5 or NAME.hdf5");
  if (!fs::exists(directory)) throw ResultsError(directory.string() + ": there is no such folder; name a folder of results");
  if (!fs::is_directory(directory))
    throw ResultsError(directory.string() +
                       ": is not a folder; name the folder of its results, which `pintle run` writes with --out FOLDER");
  std::error_code unseen;  // reported when the file is written
  if (fs::exists(file, unseen) && !fs::is_regular_file(file, unseen))
    throw std::runtime_error(file.string() + ": is " + (fs::is_directory(file, unseen) ? "a folder" : "not an ordinary file") +
                             "; name a file to write");
}

int convert(const fs::path& directory, const fs::path& file, bool quiet) {
  now_doing("writing the HDF5 file");
  validate_places(directory, file);
  handle_signals();  // so that nothing is left of the file
  ConvertedTables done;
  {
    StatusLine line(quiet);
    done = convert_results(directory, file, [&](const std::string& what, double share) {
      if (line.due()) line.show(what + time_left(share, 1, doing_since()));
      return !asked_to_stop();
    });
  }
  if (!done.whole) {
    std::cerr << "pintle: " << stopped_by() << "; there is no " << file.string() << "\n";
    return stopped;
  }
  if (is_unfinished(directory))
    std::cerr << "warning: " << directory.string() << ": "
              << (is_being_filled(directory) ? "the run is still going on; the file holds the rows written so far"
                                             : "the run did not finish; the whole rows of its tables are converted")
              << "\n";
  if (!quiet)
    std::cout << "  " << file.string() << "  " << done.tables << (done.tables == 1 ? " table, " : " tables, ")
              << number_text(static_cast<double>(fs::file_size(file)) / 1e6, 3) << " MB\n";
  return ok;
}

int carry_out(int argc, char** argv) {
  CLI::App command("Turns the tables of results into one HDF5 file", "pintle hdf5");
  std::string directory, out;
  bool quiet = false;
  command.add_option("results", directory, "folder of results, of any command")->required()->type_name("DIR");
  command.add_option("out,-o,--out", out, "the file to write; an existing file is replaced (default: DIR/results.h5)")
      ->type_name("FILE.h5");
  command.add_flag("-q,--quiet", quiet, "print errors only");
  command.footer(
      "Each table (.csv) becomes a group, each column a dataset in it, with its unit; each .json a string. docs/results.md says more.\n"
      "Exit codes: see pintle --help\n");
  return parse_and_run(command, argc, argv, [&] {
    if (command.count("--out") > 0 && out.empty()) throw SceneError("--out is empty; name a file, or leave the option out");
    const fs::path folder = directory;
    return convert(folder, out.empty() ? folder / "results.h5" : fs::path(out), quiet);
  });
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, carry_out); }
