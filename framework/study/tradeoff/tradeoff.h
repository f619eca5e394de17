#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/study.h"

/// What accuracy costs: one scene at many fidelities, time and error of each, and what follows for its user.
/// docs/studies.md
namespace pintle {

struct AxisValue {
  std::string label;
  Overrides set;
  std::vector<int> lines = {};  ///< of the study file, where each of `set` stands; empty: nobody wrote it
};

/// One thing that can be made coarser or finer.
struct FidelityAxis {
  std::string name;
  std::vector<AxisValue> values;  ///< from coarse to fine if `ordered`
  bool ordered = true;
  bool numerical = false;  ///< sets keys of `run` alone: its error is one of computing, not of the model
  std::size_t finest = 0;  ///< the value that the reference has
};

struct TradePlan {
  std::string title;
  double error = 0;         ///< wanted, relative; 0: not asked
  double time = 0;          ///< wanted [s]; 0: not asked
  int repeats = 5;          ///< timed runs of each setting
  double budget = 0;        ///< of computing [s]; 0: every combination runs
  int ensemble = 12;        ///< runs of each setting where a quantity is chaotic
  double tolerance = 1e-8;  ///< of the scene as it stands
  bool integrates = true;   ///< false: no run is needed for what is asked, so there are no tolerances and no motions that part
  std::vector<FidelityAxis> axes;
  Overrides reference = {};  ///< over those of the finest values
  bool suggested = false;    ///< axes that nobody named: suggested_plan
};

/// Section `tradeoff` of a study file. Nothing is run, but every setting is read: a value that the scene's reader takes in no
/// combination with the others is an error, one that it takes in some is a row with its reason where it does not.
/// @throws SceneError  naming file, line, key, value and remedy; also of a measure that no setting can have
TradePlan read_tradeoff(const StudyFile&);
/// Judges measures against the scene and what the axes vary, before anything runs.
/// @throws SceneError  a measure that no setting can have: what the scene has not, a stress where nothing bends
void validate_measures(const CaseSource&, const TradePlan&, const std::vector<Measure>&);
/// Axes that the scene itself suggests: tolerances, schemes, models of its clearances, shapes of its flexible bodies.
/// Builds the scene once. @throws SceneError  it cannot be read or built
TradePlan suggested_plan(const CaseSource&);
/// Sets `ordered`, `numerical`, `finest` from what the values set, and sorts tolerances.
void validate_axis(FidelityAxis&);

/// How a quantity's reference was found, and how far it is to be trusted.
struct QuantityReference {
  double value = 0;
  double error = 0;        ///< estimate of the reference's own [unit of the quantity]
  double scale = 1;        ///< what relative errors are relative to [unit of the quantity]
  bool converged = false;  ///< the refinements' differences fall, or are rounding
  bool chaotic = false;    ///< value: mean of an ensemble, error: its standard error
  bool constant = false;   ///< the same in every run, whatever the setting: nothing can be told from it
  double ratio = 0;        ///< by which differences fall from one tolerance to a tenth of it; 0: they do not fall
  double order = 0;        ///< of the model's refinements, log2 of their ratio; 0: none, or not falling
  double spread = 0;       ///< chaotic: standard deviation of single runs [unit of the quantity]
  double rate = 0;         ///< chaotic: growth of a disturbance [1/s]
  std::string words = {};  ///< all of this, in a sentence or two
  double warning() const { return error / scale > 1e-14 ? error / scale : 1e-14; }  ///< relative; rounding at the least
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
  std::vector<QuantityReference> of;   ///< each quantity
  std::string trouble;                 ///< why there is none; else empty
  double seconds = 0;                  ///< of the longest run at a tolerance
  bool short_of_time = false;          ///< what it lacks is for want of time
};

struct TradePoint {
  std::vector<std::size_t> at;  ///< value of each axis; empty: the scene as it stands
  Overrides set;
  std::string status = "not run", reason = {};
  std::vector<double> times = {};        ///< of building and running [s]; timed runs
  double time = 0, least = 0, most = 0;  ///< median and extremes [s]; of the first run if none was timed
  double build = 0;                      ///< of it, reading and building [s]
  long steps = 0, evaluations = 0;
  std::vector<double> values = {};       ///< of chaotic quantities, the ensemble's mean
  std::vector<double> spread = {};       ///< of them, standard error; else 0
  std::vector<double> errors = {};       ///< relative, as measured
  std::vector<double> warnings_of = {};  ///< relative: the reference's error, with the ensemble's
  std::vector<double> model = {};        ///< relative error of the model at tight tolerance; NaN: not told apart
  double error = 0, warning = 0;         ///< of the worst quantity; no error below the doubt is claimed
  double surer = 0;     ///< what the same setting errs at a finer tolerance, if that is more: less is luck, and does not count
  bool usable = false;  ///< finished, with a value of every quantity
  bool dominated = false, front = false;
  double counted() const { return error > surer ? error : surer; }
  double claimed() const { return counted() > warning ? counted() : warning; }
  double at_most() const;   ///< error and doubt together, of the worst quantity
  double at_least() const;  ///< error less doubt, likewise; not below 0
};

/// What can be said of a setting when an error is wanted: a smaller one is shown, a larger one is shown, or neither.
enum class Verdict { meets, misses, unknown };
Verdict verdict(const TradePoint&, double wanted);

/// What refining or coarsening one axis alone does to a point.
struct AxisEffect {
  std::size_t axis = 0, to = 0;
  std::size_t point = 0;  ///< the setting it leads to
  double error_factor = 1, time_factor = 1;
};

struct TradeReport {
  TradePlan plan;
  std::vector<std::string> quantities, units;
  Reference reference;
  std::vector<TradePoint> points;                                  ///< the scene as it stands first
  std::vector<std::size_t> front;                                  ///< by time
  std::optional<std::size_t> cheapest, best_in_time, recommended;  ///< only what the reference supports
  std::vector<std::string> said;                                   ///< the answers in words
  double seconds = 0;                                              ///< spent
  bool stopped = false;                                            ///< by the user
  bool cut = false;                                                ///< by the budget: settings remain that nobody ran
  std::size_t ran() const;                                         ///< settings with a time and an error
  std::size_t listed() const;                                      ///< all settings
  /// The worst of the quantities from which something can be told, relative. @pre there is a reference
  double warning() const;
  bool tells() const;  ///< some quantity is not the same in every run
};
/// Where no error is asked for, a reference in more doubt than this supports no recommendation.
inline constexpr double useful_warning = 0.1;

/// Runs one case: run_case of a source, or something known in a test.
using CaseRunner = std::function<Outcome(const Overrides&, const std::vector<Measure>&, const CaseLimits&)>;

struct TradeListener {
  std::function<void(const std::string& what, double share)> progress = {};
  std::function<bool()> go_on = {};
};

TradeReport run_tradeoff(const TradePlan&, const std::vector<Measure>&, const CaseRunner&, const TradeListener& = {});

/// The reference of a plan. docs/studies.md says how it is proved.
/// @param seconds  to spend; 0: no bound
/// @param most  to spend as long as the reference is not known to a third of the error that is wanted
Reference find_reference(const TradePlan&, const std::vector<Measure>&, const CaseRunner&, double seconds = 0, double most = 0);

/// What follows from points with times and errors: dominance, the front, the answers. Words included.
void answer(TradeReport&);
/// Sets what each point's `surer` is: errors of computing and of the model that cancel at one tolerance do not at the next.
void discount_luck(TradeReport&);
/// Of usable points, by time: none other is both faster and no less accurate, or as fast and more accurate. Marks them.
std::vector<std::size_t> pareto_front(std::vector<TradePoint>&);
/// Usable points that differ from this one in one axis alone.
std::vector<AxisEffect> neighbours(const TradeReport&, std::size_t point);
/// The change of one axis alone that lowers a point's error most per time; none if none lowers it.
std::optional<AxisEffect> bottleneck(const TradeReport&, std::size_t point);
/// The first step on that axis that lowers it.
std::optional<AxisEffect> first_step(const TradeReport&, std::size_t point);
/// Changes of one axis alone that cost no accuracy to speak of and save time, the most saving one of each axis.
std::vector<AxisEffect> free_coarsenings(const TradeReport&, std::size_t point);

/// "tolerance 1e-6, coupler rigid"
std::string setting_text(const TradePlan&, const TradePoint&);

/// tradeoff.csv, .json, .md, which shows tradeoff.svg, and recommended.yaml in `directory`.
/// @param final_directory  where they will stand, for the paths in recommended.yaml
/// @throws std::runtime_error  naming the path that cannot be written
void write_tradeoff(const std::filesystem::path& directory, const std::filesystem::path& final_directory, const CaseSource&,
                    const TradeReport&);
std::string tradeoff_csv(const TradeReport&);
std::string tradeoff_json(const TradeReport&);
/// The report as text for a terminal, or as Markdown; `figure` is the path of the picture, empty: none.
std::string tradeoff_text(const TradeReport&);
std::string tradeoff_markdown(const TradeReport&, const std::string& figure, const std::string& heading = "#");

}  // namespace pintle
