#include "framework/study/nonlinear/orbit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>

#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/body_store.h"
#include "framework/build/build.h"
#include "framework/common/processor_time.h"
#include "framework/common/text.h"
#include "framework/configuration/assemble.h"
#include "framework/mechanism/result_tables.h"
#include "framework/study/nonlinear/attractors.h"
#include "framework/study/nonlinear/cycle.h"
#include "framework/study/nonlinear/dimension.h"
#include "framework/study/nonlinear/follower.h"
#include "framework/study/nonlinear/lyapunov.h"
#include "framework/study/nonlinear/zero_one.h"

namespace pintle {

namespace {

constexpr const char* event_name = "return to the section";

std::string output_name(std::size_t k) { return "return " + std::to_string(k + 1); }

/// The scene of one value, in which only the section's event asks for rows.
Scene recording_scene(const CaseSource& source, const Overrides& set) {
  Scene scene = case_scene(source, set);
  for (SceneEvent& event : scene.events)
    if (event.name != event_name) event.then.row = event.otherwise.row = false;
  return scene;
}

/// The recorded columns of the trajectory.
struct RecordedColumns {
  Table row;
  std::vector<std::size_t> at;
  std::vector<std::string> units;

  RecordedColumns(const Model& model, const OrbitQuestion& question) : row(trajectory_table(model)) {
    const std::size_t n = question.section ? question.section->record.size() : 0;
    for (std::size_t k = 0; k < n; ++k) {
      const std::string name = output_name(k);
      const auto found = std::ranges::find_if(row.header, [&](const std::string& h) { return h == name || h.starts_with(name + " ["); });
      at.push_back(static_cast<std::size_t>(found - row.header.begin()));
      const auto open = found->find('[');
      units.push_back(open == std::string::npos ? "" : found->substr(open + 1, found->size() - open - 2));
    }
  }
  std::vector<double> read(const Model& model, Integrator& integrator, State& sampled) {
    row.data.clear();
    if (!integrator.sample(integrator.state().t, sampled)) throw OrbitTrouble{"failed", "a return cannot be evaluated"};
    record(model, sampled, integrator.sampled(), row);
    std::vector<double> out;
    for (const std::size_t k : at) out.push_back(row.data[k]);
    return out;
  }
};

double time_of(const CaseSource& source, Overrides set, const std::string& text) {
  set.emplace_back("output", "null");
  set.emplace_back("run.until", text);
  return case_scene(source, set).run.until;
}

/// The start of a value: the scene's own, with the coordinates, speeds and states at the end of another value. Integrals of the ledger start
/// at 0; contacts follow from the positions.
State start_of(const System& system, const Assembly& assembly, const Orbit* before, bool clock_goes_on) {
  State start = assembly.start;
  if (!before || before->end.size() != static_cast<std::size_t>(system.z_begin())) return start;
  for (int k = 0; k < system.z_begin(); ++k) start.y[k] = before->end[static_cast<std::size_t>(k)];
  if (clock_goes_on) start.t = before->end_t;
  return start;
}

ImpactFigures figures(const std::vector<Impact>& all, double from, double to) {
  ImpactFigures out;
  std::vector<double> speeds, begins;
  for (const Impact& impact : all) {
    const double end = std::isnan(impact.end) ? to : std::min(impact.end, to);
    out.contact_share += std::max(0.0, end - std::max(impact.begin, from)) / (to - from);
    if (impact.begin <= from || impact.begin > to) continue;
    speeds.push_back(impact.approach), begins.push_back(impact.begin);
  }
  out.count = static_cast<double>(speeds.size());
  if (speeds.empty()) return out;
  if (begins.size() > 1) {
    const auto [first, last] = std::ranges::minmax(begins);
    out.interval = (last - first) / static_cast<double>(begins.size() - 1);
  }
  std::ranges::sort(speeds);
  out.least_approach = speeds.front(), out.most_approach = speeds.back();
  const std::size_t half = speeds.size() / 2;
  out.median = speeds.size() % 2 == 1 ? speeds[half] : (speeds[half - 1] + speeds[half]) / 2;
  out.grazing = static_cast<double>(std::ranges::count_if(speeds, [&](double v) { return v < grazing_share * out.median; }));
  return out;
}

/// Whether a rigid contact has been closed after a time, for longer than an impact.
bool has_rested(const System& system, const std::vector<Impact>& all, double from) {
  return std::ranges::any_of(all, [&](const Impact& impact) {
    return is_rigid(system.contacts[static_cast<std::size_t>(impact.contact)]) && !(impact.end <= std::max(impact.begin, from));
  });
}

/// The 0–1 test of the first signal. Differences within the section's tolerance count as 0.
double zero_one_of(const std::vector<std::vector<double>>& signals, double tolerance) {
  std::vector<double> first;
  double most = 0;
  for (const std::vector<double>& one : signals) first.push_back(one[0]), most = std::max(most, std::abs(one[0]));
  return zero_one_test(first, tolerance * most);
}

/// Computes one value, from its scene to its results.
class Following {
 public:
  Following(const CaseSource& source, const Overrides& set, const OrbitQuestion& question, const Orbit* before, double x, BodyStore& bodies,
            const OrbitLimits& limits, OrbitEnd& out)
      : question_(question), before_(before), x_(x), limits_(limits), out_(out), scene_(recording_scene(source, set)) {
    const auto time = [&](const std::string& text) { return time_of(source, set, text); };
    const bool by_time = question.section && !question.section->every.empty();
    if (by_time) out.orbit.interval = time(question.section->every);
    if (question.lyapunov) times_ = lyapunov_times(source, set, *question.lyapunov);
    const bool clock_goes_on = before && (!by_time || before->interval == out.orbit.interval);
    const double from = clock_goes_on ? before->end_t : 0;
    scene_.run.until += from;
    if (by_time) scene_.run.until = from + out.orbit.interval * (question.section->transient + question.section->returns);
    first_ = from, last_ = scene_.run.until;
    longest_ = by_time ? question.section->returns * out.orbit.interval : last_ - from;
    if (question.cycle)
      scene_.run.until += longest_ + question.cycle->period * out_.orbit.interval;  // also started a period later, to check the laws
    if (question.lyapunov) scene_.run.until += times_.whole();
    model_ = build(scene_, bodies);
    out_.warnings = model_.warnings;
    if (question.lyapunov) model_.scheme.switch_below = 0;  // neighbours are compared, so one method integrates all of them to the end
    start_ = start_of(model_.system, assemble(scene_, model_), before, clock_goes_on);
  }

  void follow() {
    Integrator integrator(model_.system, model_.scheme, start_);
    if (!integrator.failure().empty()) throw OrbitTrouble{"failed", integrator.failure()};
    integrator_ = &integrator, begin_ = processor_time();
    try {
      if (question_.section) {
        returns(integrator);
        keep_end(integrator);  // at a return, so that the next value starts in the same phase
      }
      if (question_.cycle && out_.status.empty()) cycle(integrator);
      if (question_.lyapunov) exponents(integrator);
    } catch (...) {
      count(integrator);
      throw;
    }
    count(integrator);
    if (!question_.section) keep_end(integrator);
  }

 private:
  void keep_end(const Integrator& integrator) {
    out_.orbit.end_t = integrator.state().t;
    const Eigen::VectorXd& y = integrator.state().y;
    out_.orbit.end.assign(y.data(), y.data() + model_.system.z_begin());
  }

  static constexpr const char* out_of_time = "over its limit";

  /// Reports the progress. @returns whether to continue @throws OrbitTrouble  the time limit is exceeded
  bool report_progress() const {
    const std::string at = place();
    const double seconds = processor_time() - begin_;
    if (limits_.seconds > 0 && seconds > limits_.seconds)
      throw OrbitTrouble{out_of_time, "stopped after " + number_text(seconds, 3) + " s of computing, at " + at};
    return !limits_.go_on || limits_.go_on(share(), at);
  }
  std::string place() const {
    if (neighbours_begin_) return "t = " + number_text(integrator_->state().t, 6) + " s with neighbours";
    if (cycle_begun_) return "the periodic orbit";
    return "return " + std::to_string(came_) + " of " + std::to_string(all_returns());
  }
  int all_returns() const { return question_.section ? question_.section->transient + question_.section->returns : 0; }
  /// Share of the work, if every second of motion costs the same and each neighbour costs as much again.
  double share() const {
    const double t = integrator_->state().t, alone = question_.section ? last_ - first_ : 0;
    const double beside = question_.lyapunov ? times_.whole() * (1 + question_.lyapunov->exponents) : 0;
    const double with_neighbours = neighbours_begin_ ? std::min(1.0, (t - *neighbours_begin_) / times_.whole()) : 0;
    const double by_count = static_cast<double>(came_) / std::max(1, all_returns());
    const double of_section = neighbours_begin_ ? 1 : std::max(by_count, std::min(1.0, (t - first_) / alone));
    return (alone * of_section + beside * with_neighbours) / (alone + beside);
  }

  void count(const Integrator& integrator) {
    out_.steps = integrator.counts().steps;
    out_.impacts = static_cast<long>(integrator.impacts().size());
  }

  void returns(Integrator& integrator) {
    const SectionQuestion& section = *question_.section;
    RecordedColumns columns(model_, question_);
    out_.units = columns.units;
    const double from = integrator.state().t;
    double begin = from;
    for (int k = 1; k <= section.transient + section.returns; ++k) {
      if (section.every.empty()) {
        if (!go_to_return(integrator, last_, go_on_)) {
          too_few(k - 1, from);
          break;
        }
      } else {
        go_to(integrator, from + k * out_.orbit.interval, go_on_);
      }
      came_ = k;
      const std::vector<double> signals = columns.read(model_, integrator, sampled_);
      out_.orbit.largest.resize(signals.size(), 0.0);
      for (std::size_t i = 0; i < signals.size(); ++i) out_.orbit.largest[i] = std::max(out_.orbit.largest[i], std::abs(signals[i]));
      if (k <= section.transient) begin = integrator.state().t;
      if (k <= section.transient) continue;
      out_.orbit.t.push_back(integrator.state().t);
      out_.orbit.signals.push_back(signals);
    }
    out_.orbit.zero_one = zero_one_of(out_.orbit.signals, section.tolerance);
    out_.orbit.dimension = correlation_dimension(out_.orbit.signals, section.tolerance);
    if (integrator.state().t > begin) out_.orbit.impacts = figures(integrator.impacts(), begin, integrator.state().t);
  }

  /// Finds the periodic orbit from those of previous values; if that fails, from the motion.
  void cycle(const Integrator& integrator) {
    const CycleQuestion& asked = *question_.cycle;
    cycle_begun_ = true;
    const std::vector<double>& t = out_.orbit.t;
    CycleRun run{.period = asked.period, .interval = out_.orbit.interval, .longest = longest_, .distance = asked.distance};
    run.expected = t.back() - t[t.size() - 1 - static_cast<std::size_t>(asked.period)];
    run.tolerance = asked.tolerance > 0 ? asked.tolerance : 100 * model_.scheme.tolerance;
    RecordedColumns columns(model_, question_);
    const auto read = [&](Integrator& at) { return columns.read(model_, at, sampled_); };
    const Cycle* branch = before_ && before_->cycle.found() ? &before_->cycle : nullptr;
    const auto find = [&](const CycleGuess& guess) { out_.orbit.cycle = find_cycle(model_, integrator.state(), guess, run, read, go_on_); };
    std::string trouble;
    if (branch && !tried([&] { find(continued_guess(model_.system, *branch, x_)); }, trouble)) branch = nullptr;
    if (!branch && !tried([&] { find(integrator.state().y.head(model_.system.z_begin())); }, trouble)) {
      out_.status = "no periodic orbit", out_.reason = trouble;
      return;
    }
    Cycle& found = out_.orbit.cycle;
    found.x = x_, found.continued = branch ? 1 : 0;
    if (branch) found.point_before = branch->point, found.x_before = branch->x;
  }

  template <class F>
  static bool tried(const F& f, std::string& trouble) {
    try {
      f();
      return true;
    } catch (const OrbitTrouble& what) {
      if (what.status == status_text(Status::interrupted) || what.status == out_of_time) throw;
      trouble = what.reason;
      return false;
    }
  }

  void too_few(int came, double begin) {
    const SectionQuestion& section = *question_.section;
    out_.status = "too few returns";
    out_.reason = std::to_string(came) + " of " + std::to_string(section.transient + section.returns) + " within run.until, " +
                  number_text(last_ - begin, 6) + " s of this value; lengthen it, or ask for fewer";
  }

  void exponents(Integrator& integrator) {
    const LyapunovRun run{.count = question_.lyapunov->exponents,
                          .interval = times_.every,
                          .transient = times_.transient,
                          .intervals = times_.intervals,
                          .distance = question_.lyapunov->distance};
    neighbours_begin_ = integrator.state().t;
    out_.reason = lyapunov_exponents(model_, integrator, run, go_on_, out_.orbit);
    if (has_rested(model_.system, integrator.impacts(), *neighbours_begin_))
      out_.reason =
          "a rigid contact stayed closed for a time, where deviations across it vanish: exponents are -infinity, and their finite values "
          "show only the effect of rounding";
  }

  const OrbitQuestion& question_;
  const Orbit* before_;
  double x_;
  const OrbitLimits& limits_;
  const std::function<bool()> go_on_ = [this] { return report_progress(); };
  OrbitEnd& out_;
  Scene scene_;
  Model model_;
  State start_, sampled_;
  double first_ = 0;    ///< time at which the value begins [s]
  double last_ = 0;     ///< time limit for returns [s]
  double longest_ = 0;  ///< longest time of a periodic orbit [s]
  LyapunovTimes times_;
  const Integrator* integrator_ = nullptr;
  double begin_ = 0;  ///< of the processor time [s]
  bool cycle_begun_ = false;
  int came_ = 0;                            ///< returns so far, including those that are not recorded
  std::optional<double> neighbours_begin_;  ///< [s]; empty before they begin
};

}  // namespace

LyapunovTimes lyapunov_times(const CaseSource& source, const Overrides& set, const LyapunovQuestion& question) {
  constexpr double tenth = 0.1, nearly = 1e-9;
  LyapunovTimes out;
  out.every = time_of(source, set, question.every);
  const double over = time_of(source, set, question.over);
  const double transient = question.transient.empty() ? tenth * over : time_of(source, set, question.transient);
  if (over < (1 - nearly) * out.every)
    throw std::invalid_argument("over is " + number_text(over, 6) + " s, less than one interval `every` of " + number_text(out.every, 6) +
                                " s; take many of them");
  out.intervals = std::lround(over / out.every);
  out.transient = static_cast<long>(std::ceil(transient / out.every - nearly));
  return out;
}

Overrides recording(const OrbitQuestion& question) {
  Overrides out;
  if (!question.section) return out;
  const SectionQuestion& section = *question.section;
  for (std::size_t k = 0; k < section.record.size(); ++k) out.emplace_back("outputs." + output_name(k), section.record[k].expression);
  if (section.when.empty()) return out;
  const std::string event = std::string("events.") + event_name;
  out.emplace_back(event + ".when", section.when);
  out.emplace_back(event + ".from start", "false");
  out.emplace_back(event + ".do", "{row: true}");
  return out;
}

OrbitEnd follow_orbit(const CaseSource& source, const Overrides& set, const OrbitQuestion& question, const Orbit* before, double x,
                      BodyStore& bodies, const OrbitLimits& limits) {
  OrbitEnd out;
  try {
    Following(source, set, question, before, x, bodies, limits, out).follow();
    if (out.status.empty()) out.status = status_text(Status::finished);
  } catch (const OrbitTrouble& trouble) {
    out.status = trouble.status, out.reason = trouble.reason;
  } catch (const AssemblyError& error) {
    out.status = "not assembled", out.reason = error.what();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    out.status = "refused", out.reason = error.what();
  }
  std::ranges::replace_if(
      out.reason, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return out;
}

std::size_t period_of(const Orbit& orbit, const std::vector<std::string>& units, double tolerance) {
  constexpr double nothing = 1e-6;
  const std::vector<std::vector<double>>& signals = orbit.signals;
  if (signals.empty()) return 0;
  std::vector<double> size = orbit.largest;
  std::map<std::string, double> largest;
  const auto unit = [&](std::size_t i) { return i < units.size() ? units[i] : ""; };
  for (std::size_t i = 0; i < size.size(); ++i) largest[unit(i)] = std::max(largest[unit(i)], size[i]);
  for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::max(size[i], nothing * largest[unit(i)]);
  const auto comes_again = [&](std::size_t period) {
    for (std::size_t k = period; k < signals.size(); ++k)
      for (std::size_t i = 0; i < size.size(); ++i)
        if (!(std::abs(signals[k][i] - signals[k - period][i]) <= std::max(tolerance * size[i], least_motion))) return false;
    return true;
  };
  for (std::size_t period = 1; 2 * period <= signals.size(); ++period)
    if (comes_again(period)) return period;
  return 0;
}

}  // namespace pintle
