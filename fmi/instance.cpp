#include "fmi/instance.h"

#include <algorithm>
#include <cmath>

#include "framework/bodies/segments.h"
#include "framework/build/build.h"
#include "framework/common/index.h"
#include "framework/common/text.h"
#include "framework/mechanism/result_tables.h"

namespace pintle::fmi {

namespace {

bool is_set_before(FmuVariable::Kind kind) { return kind == FmuVariable::parameter || kind == FmuVariable::input; }

Scene scene_of(const FmuContents& contents, const std::filesystem::path& resources, const FmuSettings& settings) {
  Overrides set = contents.set;
  for (std::size_t v = 0; v < contents.variables.size(); ++v)
    if (contents.variables[v].kind == FmuVariable::parameter && settings.values[v])
      set.emplace_back(contents.variables[v].of, number_exactly(*settings.values[v]));
  if (settings.tolerance) set.emplace_back("run.tolerance", number_exactly(*settings.tolerance));
  if (settings.stop) set.emplace_back("run.until", number_exactly(*settings.stop));
  Scene scene = read_scene(resources / "scene" / contents.scene, set);
  for (std::size_t v = 0; v < contents.variables.size(); ++v)
    for (SceneState& state : scene.states)
      if (contents.variables[v].kind == FmuVariable::input && contents.variables[v].of == state.name && settings.values[v])
        state.start = *settings.values[v];
  return scene;
}

/// Index of a variable among names.
std::size_t found(const std::string& of, const std::vector<std::string>& names) {
  const auto at = std::ranges::find(names, of);
  if (at == names.end())
    throw FmuError("with these parameters the scene has no \"" + of +
                   "\", which the unit was made with; keep those that change what the "
                   "mechanism is made of as they were, or export the scene again with --set");
  return static_cast<std::size_t>(at - names.begin());
}

}  // namespace

FmuInstance::FmuInstance(FmuContents contents, std::filesystem::path resources, bool event_mode, bool early_return, Tell tell)
    : contents_(std::move(contents)),
      resources_(std::move(resources)),
      event_mode_(event_mode),
      early_return_(early_return),
      tell_(std::move(tell)) {
  for (std::size_t v = 0; v < contents_.variables.size(); ++v)
    if (contents_.variables[v].kind == FmuVariable::input) input_.push_back(v);
  scene_of(contents_, resources_, {std::vector<std::optional<double>>(contents_.variables.size()), {}, {}});  // throws if not readable
  reset();
}

void FmuInstance::require(bool allowed, const char* where) const {
  static constexpr const char* names[] = {"instantiated", "in Initialization Mode", "in Event Mode", "in Step Mode", "terminated"};
  if (!allowed) throw FmuError(std::string("the instance is ") + names[static_cast<int>(mode_)] + "; this is called " + where);
}

const FmuVariable& FmuInstance::variable(std::uint32_t v) const {
  if (v >= contents_.variables.size()) throw FmuError("there is no variable of value reference " + std::to_string(v));
  return contents_.variables[v];
}

std::shared_ptr<const FmuPrepared> FmuInstance::prepared_for(const FmuSettings& settings) {
  if (prepared_ && prepared_->settings == settings) return prepared_;
  Scene scene = scene_of(contents_, resources_, settings);
  require_run(scene);
  scene = with_pieces(std::move(scene));
  Model model = build(scene, bodies_);
  Assembly assembly = assemble(scene, model);
  std::vector<std::string> states, parameters;
  for (const OwnState& state : model.system.states) states.push_back(state.name);
  for (const SceneParameter& p : scene.parameters) parameters.push_back(p.name);
  const std::vector<std::string> columns = trajectory_table(model).header;
  std::vector<std::size_t> place;
  for (const FmuVariable& v : contents_.variables)
    place.push_back(v.kind == FmuVariable::column      ? found(v.of, columns)
                    : v.kind == FmuVariable::input     ? found(v.of, states)
                    : v.kind == FmuVariable::parameter ? found(v.of, parameters)
                                                       : 0);
  return prepared_ = std::make_shared<const FmuPrepared>(
             FmuPrepared{settings, std::move(scene), std::move(model), std::move(assembly), std::move(place)});
}

void FmuInstance::begin(const SavedState* from) {
  Listeners listeners;
  listeners.rows = [](const Table&, const Table&, const std::vector<Impact>&, const std::vector<Happening>&) {};  // rows are not kept
  simulation_ = std::make_unique<Simulation>(prepared_->scene, prepared_->model, prepared_->assembly, listeners, from);
  tally_ = {};
  tally_.look(contents_.variables, prepared_->model.system.contact_names, simulation_->happenings(), simulation_->impacts());
}

void FmuInstance::prepare() {
  if (simulation_ && prepared_->settings == settings_) return;
  simulation_.reset();
  row_.clear();
  prepared_for(settings_);
  begin();
}

void FmuInstance::enter_initialization(std::optional<double> tolerance, double start, std::optional<double> stop) {
  require(mode_ == FmuMode::instantiated, "after fmi3InstantiateCoSimulation or fmi3Reset");
  if (start != 0) throw FmuError("startTime = " + number_text(start, 9) + ": a scene starts at 0 s; take that");
  if (stop && !(*stop > 0 && std::isfinite(*stop))) throw FmuError("stopTime = " + number_text(*stop, 9) + " is not after the start");
  if (tolerance && !(*tolerance > 0 && *tolerance < 1))
    throw FmuError("tolerance = " + number_text(*tolerance, 9) + ": a relative error, above 0 and below 1");
  settings_.tolerance = tolerance, settings_.stop = stop;
  mode_ = FmuMode::initialization;
}

void FmuInstance::exit_initialization() {
  require(mode_ == FmuMode::initialization, "in Initialization Mode");
  prepare();
  for (std::size_t v = 0; v < inputs_.size(); ++v)
    if (settings_.values[v]) inputs_[v] = *settings_.values[v];
  applied_ = inputs_;
  if (!simulation_->advance(0)) {
    const std::string reason = simulation_->finish().reason;
    simulation_.reset();
    throw FmuError(reason);
  }
  tally_.look(contents_.variables, prepared_->model.system.contact_names, simulation_->happenings(), simulation_->impacts());
  shown_ = tally_.values();
  row_.clear();
  mode_ = event_mode_ ? FmuMode::event : FmuMode::step;
}

void FmuInstance::enter_event_mode() {
  require(mode_ == FmuMode::step, "in Step Mode");
  if (!event_mode_) throw FmuError("the instance was made without event mode; set eventModeUsed in fmi3InstantiateCoSimulation");
  mode_ = FmuMode::event;
}

void FmuInstance::enter_step_mode() {
  require(mode_ == FmuMode::event, "in Event Mode");
  mode_ = FmuMode::step;
}

bool FmuInstance::update_discrete() {
  require(mode_ == FmuMode::event, "in Event Mode");
  shown_ = tally_.values();
  return !over_.empty();
}

void FmuInstance::apply_inputs() {
  for (const std::size_t v : input_)
    if (inputs_[v] != applied_[v])
      simulation_->set(static_cast<int>(prepared_->place[v]), inputs_[v]), applied_[v] = inputs_[v], row_.clear();
}

/// Called if the run ends before the importer ends it.
void FmuInstance::end_here() {
  row();
  const Run run = simulation_->finish();
  simulation_.reset();
  over_ = run.reason.empty() ? "the run has ended" : run.reason;
  for (const std::string& warning : run.warnings) tell_(warning);
  if (run.status == Status::failed || run.status == Status::out_of_memory) throw FmuError(over_);
}

StepEnd FmuInstance::do_step(double from, double size) {
  require(mode_ == FmuMode::step, "in Step Mode");
  if (!over_.empty()) throw FmuError("the run is over: " + over_);
  if (!(size > 0) || !std::isfinite(size)) throw FmuError("communicationStepSize = " + number_text(size, 9) + " s: must be above 0");
  if (!(std::abs(from - time_) <= 1e-6 * size + 1e-12 * std::abs(time_)))
    throw FmuError("currentCommunicationPoint = " + number_text(from, 12) + " s, but the instance is at " + number_text(time_, 12) + " s");
  const double until = prepared_->scene.run.until, asked = from + size,
               target = std::abs(asked - until) <= 1e-12 * until ? until : std::min(asked, until);
  if (asked - until > 1e-6 * size + 1e-12 * until)
    throw FmuError("a step to " + number_text(asked, 12) + " s: the run ends at " + number_text(until, 12) +
                   " s, as laws of time are looked at beforehand; give fmi3EnterInitializationMode a later stopTime");
  apply_inputs();
  row_.clear();
  StepEnd out{asked, false, false, false};
  for (;;) {
    const std::vector<int> before = tally_.values();
    const bool on = simulation_->advance_to_event(target);
    tally_.look(contents_.variables, prepared_->model.system.contact_names, simulation_->happenings(), simulation_->impacts());
    out.event = event_mode_ && tally_.values() != before;
    const double t = simulation_->time();
    const bool there = t >= target;
    out.terminate = !on && t < until;
    if (on && !there && !(out.event && early_return_)) continue;
    if (!there) out.time = t, out.early = true;
    break;
  }
  time_ = out.time;
  if (!out.event) shown_ = tally_.values();
  if (out.terminate) end_here();
  return out;
}

void FmuInstance::terminate() {
  require(mode_ == FmuMode::event || mode_ == FmuMode::step, "in Event Mode or Step Mode");
  if (simulation_) {
    row();
    for (const std::string& warning : simulation_->finish().warnings) tell_(warning);
    simulation_.reset();
  }
  mode_ = FmuMode::terminated;
}

void FmuInstance::reset() {
  mode_ = FmuMode::instantiated;
  settings_ = {std::vector<std::optional<double>>(contents_.variables.size()), {}, {}};
  time_ = 0;
  simulation_.reset();
  tally_ = {};
  shown_.assign(contents_.variables.size(), 0);
  row_.clear(), over_.clear();
  inputs_.clear();
  for (const FmuVariable& v : contents_.variables) inputs_.push_back(v.start);
  applied_ = inputs_;
}

const std::vector<double>& FmuInstance::row() {
  if (mode_ == FmuMode::initialization) prepare();
  if (!simulation_) return row_;
  if (mode_ != FmuMode::initialization) apply_inputs();
  if (row_.empty()) row_ = simulation_->now();
  if (row_.empty()) throw FmuError("the motion here cannot be evaluated (a singular configuration, or numbers beyond what a double holds)");
  return row_;
}

double FmuInstance::number(std::uint32_t index) {
  const FmuVariable& v = variable(index);
  if (v.kind == FmuVariable::time) return time_;
  if (v.kind == FmuVariable::input)
    return settings_.values[index] && mode_ <= FmuMode::initialization ? *settings_.values[index] : inputs_[index];
  if (v.kind == FmuVariable::parameter) {
    if (settings_.values[index]) return *settings_.values[index];
    if (std::ranges::none_of(settings_.values, [](const auto& value) { return value.has_value(); })) return v.start;
    return prepared_for(settings_)->scene.parameters[prepared_->place[index]].value;  // it may depend on a parameter that is set
  }
  if (v.kind != FmuVariable::column)
    throw FmuError("\"" + v.name + "\" is no Float64 but counts; ask for it as modelDescription.xml types it");
  require(mode_ != FmuMode::instantiated, "from Initialization Mode on");
  const std::vector<double>& now = row();
  return now.empty() ? std::nan("") : now[prepared_->place[index]];
}

int FmuInstance::discrete(std::uint32_t index, bool flag) {
  const FmuVariable& v = variable(index);
  const bool counts = v.kind == FmuVariable::happened || v.kind == FmuVariable::contacts;
  if (flag ? v.kind != FmuVariable::touching : !counts)
    throw FmuError("\"" + v.name + "\" is no " + (flag ? "Boolean" : "Int32") + "; ask for it as modelDescription.xml types it");
  require(mode_ != FmuMode::instantiated, "from Initialization Mode on");
  return shown_[index];
}

void FmuInstance::set(std::uint32_t index, double value) {
  const FmuVariable& v = variable(index);
  if (!is_set_before(v.kind)) throw FmuError("\"" + v.name + "\" is neither parameter nor input, and follows from the motion");
  if (!std::isfinite(value)) throw FmuError("\"" + v.name + "\" cannot be " + number_text(value) + ": it must be a finite number");
  if (mode_ <= FmuMode::initialization) {
    settings_.values[index] = value;
    return;
  }
  require(v.kind == FmuVariable::input, "for a parameter before fmi3ExitInitializationMode");
  require(mode_ != FmuMode::terminated, "before fmi3Terminate");
  inputs_[index] = value;
}

}  // namespace pintle::fmi
