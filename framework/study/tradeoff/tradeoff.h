#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/study.h"

/// The cost of accuracy: one scene with many accuracy settings, their time and error, and recommendations.
/// docs/studies.md
namespace pintle {

struct AxisValue {
  std::string label;
  Overrides set;
  std::vector<int> lines = {};  ///< lines of `set` in the study file; empty: not written by the user
};

/// A property that can be made coarser or finer.
struct FidelityAxis {
  std::string name;
  std::vector<AxisValue> values;  ///< from coarse to fine if `ordered`
  bool ordered = true;
  bool numerical = false;  ///< sets only keys of `run`: its error is numerical, not one of the model
  std::size_t finest = 0;  ///< index of the value used in the reference
};

struct TradePlan {
  std::string title;
  double error = 0;         ///< requested, relative; 0: not requested
  double time = 0;          ///< requested [s]; 0: not requested
  int repeats = 5;          ///< timed runs of each setting
  double budget = 0;        ///< computing time [s]; 0: every combination runs
  int ensemble = 12;        ///< runs of each setting where a quantity is chaotic
  double tolerance = 1e-8;  ///< of the unchanged scene
  bool integrates = true;   ///< false: the analysis needs no run, so there are no tolerances and no diverging motions
  std::vector<FidelityAxis> axes;
  Overrides reference = {};  ///< in addition to those of the finest values
  bool suggested = false;    ///< axes are not from the user: suggested_plan
};

/// Section `tradeoff` of a study file. Nothing is run, but every setting is read: a value that the scene's reader accepts in no combination
/// with the others is an error; one that it accepts in some is a row with its reason where it does not.
/// @throws SceneError  naming file, line, key, value and remedy; also for a measure that no setting can have
TradePlan read_tradeoff(const StudyFile&);
/// Checks measures against the scene and the axes before anything runs.
/// @throws SceneError  a measure that no setting can have: something the scene lacks, a stress where nothing bends
void validate_measures(const CaseSource&, const TradePlan&, const std::vector<Measure>&);
/// Axes that follow from the scene itself: tolerances, schemes, models of its clearances, shapes of its flexible bodies. Builds the scene
/// once. @throws SceneError  it cannot be read or built
TradePlan suggested_plan(const CaseSource&);
/// Sets `ordered`, `numerical`, `finest` according to the values, and sorts tolerances.
void validate_axis(FidelityAxis&);

/// How a quantity's reference was found, and how reliable it is.
struct QuantityReference {
  double value = 0;
  double error = 0;        ///< error estimate of the reference itself [unit of the quantity]
  double scale = 1;        ///< scale of relative errors [unit of the quantity]
  bool converged = false;  ///< the differences of refinements fall, or are rounding
  bool chaotic = false;    ///< value: mean of an ensemble, error: its standard error
  bool constant = false;   ///< the same in every run and setting, so it does not distinguish settings
  double ratio = 0;        ///< by which differences fall per decade of tolerance; 0: they do not fall
  double order = 0;        ///< of the model's refinements, log2 of their ratio; 0: none, or not falling
  double spread = 0;       ///< chaotic: standard deviation of single runs [unit of the quantity]
  double rate = 0;         ///< chaotic: growth of a disturbance [1/s]
  std::string words = {};  ///< all of this in one or two sentences
  double warning() const { return error / scale > 1e-14 ? error / scale : 1e-14; }  ///< relative; at least rounding
};

struct ReferenceLevel {
  std::string what;
  Overrides set;
  std::vector<double> values;
  double seconds = 0;
};

struct Reference {
  Overrides set;                       ///< of the finest model with the reference's tolerance
  std::vector<ReferenceLevel> levels;  ///< in the order run
  std::vector<QuantityReference> of;   ///< for each quantity
  std::string trouble;                 ///< why there is none; otherwise empty
  double seconds = 0;                  ///< of the longest run at a tolerance [s]
  bool short_of_time = false;          ///< it is incomplete for lack of time
};

struct TradePoint {
  std::vector<std::size_t> at;  ///< value of each axis; empty: the unchanged scene
  Overrides set;
  std::string status = "not run", reason = {};
  std::vector<double> times = {};        ///< of building and running [s]; timed runs
  double time = 0, least = 0, most = 0;  ///< median and extremes [s]; of the first run if none was timed
  double build = 0;                      ///< part of it for reading and building [s]
  long steps = 0, evaluations = 0;
  std::vector<double> values = {};       ///< for chaotic quantities, the ensemble's mean
  std::vector<double> spread = {};       ///< their standard error; otherwise 0
  std::vector<double> errors = {};       ///< relative, as measured
  std::vector<double> warnings_of = {};  ///< relative: the reference's error, plus that of the ensemble
  std::vector<double> model = {};        ///< relative error of the model at tight tolerance; NaN: not separated
  double error = 0, warning = 0;         ///< of the worst quantity; no error below its uncertainty is claimed
  double surer = 0;     ///< error of the same setting at a finer tolerance, if larger: a smaller error is due to chance and does not count
  bool usable = false;  ///< finished, with a value for every quantity
  bool dominated = false, front = false;
  double counted() const { return error > surer ? error : surer; }
  double claimed() const { return counted() > warning ? counted() : warning; }
  double at_most() const;   ///< error plus uncertainty, of the worst quantity
  double at_least() const;  ///< error minus uncertainty, likewise; not negative
};

/// Comparison of a setting with a requested error: shown to be smaller, shown to be larger, or neither.
enum class Verdict { meets, misses, unknown };
Verdict verdict(const TradePoint&, double wanted);

/// Effect of refining or coarsening a single axis on a point.
struct AxisEffect {
  std::size_t axis = 0, to = 0;
  std::size_t point = 0;  ///< the resulting setting
  double error_factor = 1, time_factor = 1;
};

struct TradeReport {
  TradePlan plan;
  std::vector<std::string> quantities, units;
  Reference reference;
  std::vector<TradePoint> points;                                  ///< the unchanged scene first
  std::vector<std::size_t> front;                                  ///< by time
  std::optional<std::size_t> cheapest, best_in_time, recommended;  ///< only what the reference supports
  std::vector<std::string> said;                                   ///< the answers in words
  double seconds = 0;                                              ///< spent [s]
  bool stopped = false;                                            ///< by the user
  bool cut = false;                                                ///< by the budget: some settings were not run
  std::size_t ran() const;                                         ///< settings with a time and an error
  std::size_t listed() const;                                      ///< all settings
  /// The worst of the quantities that distinguish settings, relative. @pre there is a reference
  double warning() const;
  bool tells() const;  ///< some quantity differs between runs
};
/// If no error is requested, a reference with a larger uncertainty supports no recommendation.
inline constexpr double useful_warning = 0.1;

/// Runs one case: run_case of a source, or a known function in a test.
using CaseRunner = std::function<Outcome(const Overrides&, const std::vector<Measure>&, const CaseLimits&)>;

struct TradeListener {
  std::function<void(const std::string& what, double share)> progress = {};
  std::function<bool()> go_on = {};
};

TradeReport run_tradeoff(const TradePlan&, const std::vector<Measure>&, const CaseRunner&, const TradeListener& = {});

/// The reference of a plan. docs/studies.md describes its justification.
/// @param seconds  available time [s]; 0: unlimited
/// @param most  available time [s] while the reference is not accurate to a third of the requested error
Reference find_reference(const TradePlan&, const std::vector<Measure>&, const CaseRunner&, double seconds = 0, double most = 0);

/// Derives dominance, the front and the answers, including their words, from points with times and errors.
void answer(TradeReport&);
/// Sets each point's `surer`: numerical errors and model errors that cancel at one tolerance do not at the next.
void discount_luck(TradeReport&);
/// The usable points, by time, for which no other is faster and at least as accurate, or as fast and more accurate. Marks them.
std::vector<std::size_t> pareto_front(std::vector<TradePoint>&);
/// Usable points that differ from this one in a single axis.
std::vector<AxisEffect> neighbours(const TradeReport&, std::size_t point);
/// The change of a single axis that lowers a point's error most per time; none if none lowers it.
std::optional<AxisEffect> bottleneck(const TradeReport&, std::size_t point);
/// The first step on that axis that lowers the error.
std::optional<AxisEffect> first_step(const TradeReport&, std::size_t point);
/// Changes of a single axis that save time without a significant loss of accuracy, the best one for each axis.
std::vector<AxisEffect> free_coarsenings(const TradeReport&, std::size_t point);

/// "tolerance 1e-6, coupler rigid"
std::string setting_text(const TradePlan&, const TradePoint&);

/// tradeoff.csv, .json, .md, which shows tradeoff.svg, and recommended.yaml in `directory`.
/// @param final_directory  where they will finally be, for the paths in recommended.yaml
/// @throws std::runtime_error  naming the path that cannot be written
void write_tradeoff(const std::filesystem::path& directory, const std::filesystem::path& final_directory, const CaseSource&,
                    const TradeReport&);
std::string tradeoff_csv(const TradeReport&);
std::string tradeoff_json(const TradeReport&);
/// The report as text for a terminal, or as Markdown; `figure` is the path of the picture, empty: none.
std::string tradeoff_text(const TradeReport&);
std::string tradeoff_markdown(const TradeReport&, const std::string& figure, const std::string& heading = "#");

}  // namespace pintle
