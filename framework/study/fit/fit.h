#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/fit/goal.h"
#include "framework/study/sweep/sweep.h"

/// Parameters that achieve a goal: docs/studies.md.
namespace pintle {

/// A parameter that may change.
struct Variable {
  std::string name;
  ValueSpan span;
};

struct FitPlan {
  Sweep base;         ///< the study, and as its cases the first points: the start, then a Latin hypercube
  CaseSource source;  ///< of the scene as it will be written: without settings that apply only to the search
  std::vector<Variable> variables;
  Goal goal;
  std::optional<Optimiser> method;  ///< none: default
  std::size_t starts = 1;           ///< number of searches, each from another of the first points
  std::size_t evaluations = 1000;   ///< total number of cases, at most
  std::uint64_t seed = 1;
  double precision = 1e-6, step = 1e-4;  ///< relative to the variables' spans: precision of the result, and step of differences

  BoxPoint point(std::size_t k) const;  ///< of case k of the first points
  Overrides overrides(const BoxPoint&) const;
  /// Methods of a search, in sequence.
  std::vector<Optimiser> methods() const;
  std::size_t share() const;  ///< evaluations per start
};

/// Reads a study with `vary`, `goal` and `fit`. @throws SceneError
FitPlan read_fit(const std::filesystem::path&, const Overrides& set = {});

/// A case that was evaluated.
struct FitCase {
  std::string phase;  ///< "first points", "start 2", "last search"
  Row row;            ///< its values: those of the variables (SI), then of the measures
  Worth worth;
};

struct FitEnd {
  bool stopped = false;
  std::size_t workers = 1;
  std::vector<std::string> notes;
  std::vector<FitCase> tried;                       ///< in an order independent of the worker threads
  std::optional<std::size_t> best;                  ///< index into these
  std::vector<std::string> ends;                    ///< of each search, the reason for its end
  std::vector<std::optional<std::size_t>> best_of;  ///< of each search
  std::size_t before = 0;                           ///< cases of earlier sessions
  double seconds = 0;

  bool meets(const FitPlan&) const;  ///< the best satisfies all bounds, and the goal if it has a tolerance
};

struct FitSettings {
  int threads = 1;
  std::function<bool(std::size_t done, std::size_t most)> progress = {};  ///< false: stop
};

/// Searches, and writes into `folder`: fit.csv, fit.json, fitted.yaml, study.yaml, scene.yaml, journal-0.txt. Identical to the bit for any
/// number of threads and interruptions.
/// @throws SceneError, std::runtime_error  as run_sweep
FitEnd run_fit(const FitPlan&, const std::filesystem::path& folder, const FitSettings&);

/// Values of an evaluated case: of a variable, of the measures.
double variable_value(const FitCase&, std::size_t variable);
std::vector<double> measured_values(const FitPlan&, const FitCase&);
/// The best point as overrides of the scene. @pre it exists
Overrides best_point(const FitPlan&, const FitEnd&);
/// Headers with units.
std::string variable_header(const Variable&);
std::string measured_header(const FitPlan&, const FitEnd&, std::size_t measure);
/// Number of searches that ended at the best point, to a thousandth of each span.
std::size_t agreeing(const FitPlan&, const FitEnd&);

std::string fit_csv(const FitPlan&, const FitEnd&);
std::string fit_json(const FitPlan&, const FitEnd&);
/// The scene with the best point. @pre it exists
std::string fitted_scene(const FitPlan&, const FitEnd&, const std::filesystem::path& folder);

}  // namespace pintle
