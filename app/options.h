#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/scene/yaml/reader.h"

/// Shared by the commands.
namespace pintle::app {

enum Exit { ok = 0, trouble = 1, bad_scene = 2, no_assembly = 3, run_failed = 4, ledger_over = 5, stopped = 6 };

struct Options {
  std::string scene, out, body;
  std::vector<std::string> set;
  bool quiet = false, json = false;
  int count = 6, frames = -1;
  std::string restart, at;              ///< a saved state; a time
  bool at_rest = false;                 ///< about the equilibrium of the mechanism
  std::optional<std::string> shard;     ///< of a sweep: "3/8", the part of its cases to run
  std::vector<std::string> folders;     ///< of the parts to be merged
  int threads = 0;                      ///< of this process; 0: one per core
  std::vector<std::string> quantities;  ///< of a trade-off study, in words
  std::string wanted_error, wanted_time, budget, markdown;
  int repeats = 0;  ///< 0: as in the study
  bool trust_geo = false;
  std::vector<std::string> allowed;    ///< folders that scenes may read from
  std::string mesh_time;               ///< for one body; empty: the library's default
  double mesh_memory = 0;              ///< [GB]; 0: likewise
  bool report = false;                 ///< for a run: make a page of its results
  bool hdf5 = false;                   ///< for a run: make one HDF5 file of its tables
  std::string against;                 ///< the column on the x axis of plots; empty: the time
  double megabytes = 5;                ///< approximate size of that page
  std::vector<std::string> passed_on;  ///< to the separate program that executes it
};

// One function per command; each returns its exit code.
int check(const Options&);
int run(const Options&);
int modes(const Options&);
int mesh(const Options&);
int statics(const Options&);
int equilibrium(const Options&);
int kinematics(const Options&);
int inverse(const Options&);
int linearize(const Options&);
int sweep(const Options&);
int merge(const Options&);
int tradeoff(const Options&);
int report(const Options&);
int plot(const Options&);
int picture(const Options&);
int film(const Options&);
int view(const Options&);
int fmu(const Options&);
int hdf5(const Options&);
int fit(const Options&);
int sensitivity(const Options&);
int nonlinear(const Options&);

/// Sets limits of access and cost for the files of a scene.  @throws SceneError  an option cannot be read
void set_bounds(const Options&);
Overrides overrides(const Options&);
/// --at, a time ≥ 0 [s]. @throws SceneError  it cannot be read
double instant(const Options&);
std::string number(double x, int digits = 6);
using Rows = std::vector<std::pair<std::string, std::string>>;
void print_rows(std::ostream&, const Rows&);  ///< the second column aligned
/// runs/NAME, or runs/NAME-2, …: never an existing one; `suffix` is added to the scene's name.
std::filesystem::path results_directory(const Options&, const std::string& suffix = "");
/// runs/NAME and the suffix; there the same command continues existing results.
std::filesystem::path study_directory(const Options&, const std::string& suffix);
int thread_count(const Options&);  ///< --threads, or the number of cores

}  // namespace pintle::app
