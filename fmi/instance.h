#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fmi/contents.h"
#include "fmi/tally.h"
#include "framework/analysis/simulate/simulation.h"
#include "framework/bodies/body_store.h"

namespace pintle::fmi {

/// The request of the importer is impossible; the message gives the reason and the remedy.
struct FmuError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The modes of the standard's state machine of co-simulation.
enum class FmuMode { instantiated, initialization, event, step, terminated };

/// Settings of the importer before the start; everything else follows from them.
struct FmuSettings {
  std::vector<std::optional<double>> values;  ///< of parameters and start values of inputs; by value reference
  std::optional<double> tolerance, stop;
  bool operator==(const FmuSettings&) const = default;
};

/// A scene prepared for a run, with the indices of the variables in it.
struct FmuPrepared {
  FmuSettings settings;
  Scene scene;
  Model model;
  Assembly assembly;
  std::vector<std::size_t> place;  ///< index: of a column in a row, of an input among the states, of a parameter among the scene's
};

/// State from which an instance continues.
struct FmuState {
  FmuMode mode = FmuMode::instantiated;
  FmuSettings settings;
  double time = 0;
  std::vector<double> inputs;       ///< as set by the importer
  std::vector<double> applied;      ///< as applied in the run
  std::vector<int> shown;           ///< discrete values that the importer sees
  std::optional<SavedState> saved;  ///< of a run that continues
  std::vector<double> row;          ///< last row of a run that has ended
  std::string over;
};

/// Where and why a step ended.
struct StepEnd {
  double time = 0;
  bool event = false, terminate = false, early = false;
};

/// A scene that an importer simulates step by step. Members throw FmuError, SceneError or AssemblyError and then leave its state
/// effectively unchanged; if the run itself fails, it is over.
class FmuInstance {
 public:
  using Tell = std::function<void(const std::string& warning)>;
  FmuInstance(FmuContents, std::filesystem::path resources, bool event_mode, bool early_return, Tell);

  void enter_initialization(std::optional<double> tolerance, double start, std::optional<double> stop);
  void exit_initialization();
  void enter_event_mode();
  void enter_step_mode();
  /// @returns whether the run is over. Discrete values become those after the event.
  bool update_discrete();
  StepEnd do_step(double from, double size);
  void terminate();
  void reset();

  double number(std::uint32_t variable);
  int count(std::uint32_t variable) { return discrete(variable, false); }
  bool flag(std::uint32_t variable) { return discrete(variable, true) != 0; }
  void set(std::uint32_t variable, double value);

  FmuState state() const;
  void set_state(const FmuState&);
  std::string text(const FmuState&);
  FmuState state_of(const std::string& text);

 private:
  const FmuVariable& variable(std::uint32_t) const;
  void require(bool allowed, const char* where) const;
  std::shared_ptr<const FmuPrepared> prepared_for(const FmuSettings&);
  void begin(const SavedState* from = nullptr);
  void prepare();
  void apply_inputs();
  void end_here();
  const std::vector<double>& row();
  int discrete(std::uint32_t variable, bool flag);

  FmuContents contents_;
  std::filesystem::path resources_;
  bool event_mode_, early_return_;
  Tell tell_;
  std::vector<std::size_t> input_;  ///< which variables are inputs
  FmuMode mode_ = FmuMode::instantiated;
  FmuSettings settings_;
  double time_ = 0;
  std::vector<double> inputs_, applied_;  ///< by value reference: as set by the importer; as applied in the run
  std::shared_ptr<const FmuPrepared> prepared_;
  BodyStore bodies_;
  std::unique_ptr<Simulation> simulation_;
  Tally tally_;
  std::vector<int> shown_;
  std::vector<double> row_;  ///< at the present time; empty: not yet computed
  std::string over_;         ///< why the run is over; empty: it continues
};

}  // namespace pintle::fmi
