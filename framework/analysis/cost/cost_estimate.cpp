#include "framework/analysis/cost/cost_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include <unistd.h>

#include "framework/analysis/cost/simpler.h"
#include "framework/analysis/simulate/explain_failure.h"
#include "framework/build/choose_method.h"
#include "framework/common/processor_time.h"
#include "framework/common/stop_point.h"
#include "framework/common/text.h"
#include "framework/common/work_done.h"
#include "framework/integration/integrator.h"
#include "framework/mechanism/drawing.h"
#include "framework/mechanism/table.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

namespace {

namespace fs = std::filesystem;
double since(double begin) { return processor_time() - begin; }

/// Rough computing time of a step [s], from the size of the model. It sets the number of steps of a trial, so that this number is
/// reproducible; the actual time of a step is measured.
double rough_step_seconds(const System& s, const Scheme& scheme) {
  const double rows = s.n_rows(), bodies = static_cast<double>(s.bodies.size());
  double evaluation = 0.2e-6 + 0.06e-6 * bodies + 0.015e-6 * static_cast<double>(s.markers.size()) + 0.06e-6 * rows +
                      0.06e-6 * static_cast<double>(s.forces.size() + s.contacts.size()) +
                      (Schur(s).sparse() ? 0.05e-6 * rows : 0.1e-9 * rows * rows * (rows / 3 + 3));
  double shapes = 0;
  for (const Body& b : s.bodies) {
    const double n = b.modes();
    evaluation += n > 0 ? 0.5e-6 + 0.1e-6 * n + (b.flex->second ? 8e-9 : 2e-9) * n * n : 0;
    shapes += n;
  }
  if (scheme.tableau) return evaluation * static_cast<double>(scheme.tableau->c.size());
  return 5 * evaluation + 1e-6 * (3 * bodies + shapes + rows);
}

/// A trial and the end times of its steps.
struct Tried {
  Trial trial;
  std::vector<double> ends;
};

Tried try_out(Integrator& run, double until, long most_steps, double most_seconds) {
  Tried out;
  Trial& t = out.trial;
  const double begin = processor_time();
  while (run.failure().empty() && run.state().t < until && t.steps < most_steps && !t.by_clock) {
    stop_point();
    if (!run.advance(until)) break;
    ++t.steps;
    out.ends.push_back(run.state().t);
    t.by_clock = since(begin) > most_seconds;
    work_done =
        std::max({run.state().t / until, static_cast<double>(t.steps) / static_cast<double>(most_steps), since(begin) / most_seconds});
  }
  t.seconds = since(begin);
  t.reached = run.state().t;
  t.whole = t.reached >= until || !run.ended().empty();
  if (t.whole) t.by_clock = false;
  const Counts counts = run.counts();
  t.rejected = counts.rejected, t.evaluations = counts.evaluations;
  t.impacts = static_cast<long>(run.impacts().size());
  t.trouble = run.failure();
  return out;
}

RunCost cost_of(const Tried& tried, double until) {
  RunCost c;
  c.trial = tried.trial;
  c.steps = steps_of_run(tried.ends, until);
  c.step = c.steps.likely > 0 ? until / c.steps.likely : 0;
  const double each = tried.trial.steps > 0 ? tried.trial.seconds / static_cast<double>(tried.trial.steps) : 0;
  c.seconds = {c.steps.low * each, c.steps.likely * each, c.steps.high * each};
  return c;
}

constexpr double clock_factor = 3;  // a trial may take this many times its intended time before the clock ends it
constexpr long least_steps = 16;

Tried try_for(Integrator& run, const System& system, const Scheme& scheme, double until, double seconds) {
  const double steps = seconds / rough_step_seconds(system, scheme);
  return try_out(run, until, std::max(least_steps, static_cast<long>(steps)), clock_factor * seconds);
}

/// Measures the cost of rows by making some within the last step of a trial.
void estimate_rows(const Scene& scene, const Model& model, Integrator& run, OutputCost& out) {
  const double until = scene.run.until, every = scene.output.every > 0 ? scene.output.every : until / 1000;
  out.rows = static_cast<long>(std::ceil(until / every - 1e-9)) + 1;
  Table trajectory = trajectory_table(model), ledger = ledger_table(model.system);
  out.columns = trajectory.columns() + ledger.columns();
  if (run.last().h <= 0) return;
  constexpr int samples = 20;
  constexpr double enough = 0.1;
  State at;
  const double begin = processor_time();
  int made = 0;
  for (; made < samples && since(begin) < enough; ++made) {
    if (!run.sample(run.last().from.state.t + run.last().h * (made + 0.5) / samples, at)) return;
    record(model, at, run.sampled(), trajectory);
    record_ledger(model.system, at, energies(model.system, at, run.sampled()), 0, ledger);
  }
  const std::string text = csv(trajectory) + csv(ledger);
  std::size_t heads = 0;
  for (const Table* t : {&trajectory, &ledger})
    for (const std::string& h : t->header) heads += h.size() + 1;
  out.row_seconds = since(begin) / made;
  out.row_bytes = static_cast<double>(text.size() - std::min(heads, text.size())) / made;
}

/// A folder that is deleted after use.
struct Temporary {
  fs::path path;
  Temporary() {
    std::string name = (fs::temp_directory_path() / "pintle_cost_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
    path = name;
  }
  ~Temporary() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Temporary(const Temporary&) = delete;
};

/// The first frame initialises data shared by all; the mean of the following ones is taken, several if they are fast.
void estimate_frames(const Scene& scene, const Model& model, Integrator& run, OutputCost& out) {
  constexpr double enough = 2e-3;  // [s]
  constexpr int most = 17;
  if (scene.output.frames < 2) return;
  out.frames = scene.output.frames;
  State at;
  run.sample(run.state().t, at);
  const Temporary folder;
  const Drafting drafting(scene, model);
  FrameWriter writer(folder.path);
  writer.add(draw(model, drafting, at, run.sampled()));
  int frames = 1;
  for (const double begin = processor_time(); frames < most && (frames == 1 || since(begin) < enough); ++frames) {
    writer.add(draw(model, drafting, at, run.sampled()));
    out.frame_seconds = since(begin) / frames;
  }
  for (const auto& file : fs::recursive_directory_iterator(folder.path))
    if (file.is_regular_file()) out.frame_bytes += static_cast<double>(file.file_size()) / frames;
}

/// Memory used by the program now [bytes]; 0 where the system does not report it.
double resident() {
  std::ifstream in("/proc/self/statm");
  double size = 0, pages = 0;
  return in >> size >> pages ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

template <class List, class Is>
std::size_t how_many(const List& list, Is is) {
  return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), is));
}

std::vector<std::string> terms_of(const System& s) {
  std::vector<std::string> out;
  const auto rigid = how_many(s.bodies, [](const Body& b) { return b.modes() == 0; });
  if (rigid > 0) out.push_back("constant inertia of " + std::to_string(rigid) + (rigid == 1 ? " rigid body" : " rigid bodies"));
  for (const Body& b : s.bodies)
    if (b.modes() > 0)
      out.push_back(counted(static_cast<std::size_t>(b.modes()), "shape") + " of \"" + b.name + "\"" +
                    (b.flex->second ? ", stiffening" : ""));
  if (has_gravity(s)) out.push_back("gravity");
  const auto drivers = how_many(s.joints, is_driver);
  if (s.joints.size() > drivers) out.push_back(counted(s.joints.size() - drivers, "joint"));
  if (drivers > 0) out.push_back(counted(drivers, "driver"));
  const char* kinds[] = {"point force", "torque", "spring", "torsion spring", "Maxwell element"};
  for (std::size_t k = 0; k < std::size(kinds); ++k) {
    const auto n = how_many(s.forces, [&](const Force& f) { return f.index() == k; });
    if (n > 0) out.push_back(counted(n, kinds[k]));
  }
  const auto rough = how_many(s.contacts, [](const ContactPair& c) { return c.pair == 0 && c.friction.has_value(); });
  if (!s.contacts.empty())
    out.push_back(counted(how_many(s.contacts, [](const ContactPair& c) { return c.pair == 0; }), "contact") +
                  (rough > 0 ? ", " + std::to_string(rough) + " with friction" : ""));
  return out;
}

void estimate_rates(const Scene& scene, const System& system, CostEstimate& p) {
  const RateSpectrum s = spectrum(scene, system);
  p.largest_rate = s.fastest.rate;
  p.largest_rate_of = s.fastest.what;
  for (const RateSpectrum::Part& part : s.parts)
    if (part.what.starts_with("contact")) p.contact_rate = std::max(p.contact_rate, part.rate);
}

double part_saved(const CostEstimate& p, double seconds) { return p.seconds.likely > 0 ? 1 - seconds / p.seconds.likely : 0; }

/// Savings from fewer outputs, which need no trial.
void save_outputs(CostEstimate& p) {
  const auto less = [&](const std::string& what, double seconds) {
    if (seconds > 0) p.simpler.push_back({what, p.run, true, part_saved(p, p.seconds.likely - seconds)});
  };
  constexpr long few_rows = 100;
  if (p.output.rows > 2 * few_rows) less("a tenth of the rows written", 0.9 * static_cast<double>(p.output.rows) * p.output.row_seconds);
  less("no frames", p.output.frames * p.output.frame_seconds);
}

}  // namespace

Estimate steps_of_run(const std::vector<double>& ends, double until) {
  const auto so_far = static_cast<double>(ends.size());
  if (ends.empty()) return {};
  const double reached = ends.back();
  if (reached >= until) return {so_far, so_far, so_far};
  constexpr int quarters = 4;
  const auto count_until = [&](double t) { return static_cast<double>(std::upper_bound(ends.begin(), ends.end(), t) - ends.begin()); };
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (int k = 1; k < quarters; ++k) {
    const double from = reached * k / quarters, to = k + 1 == quarters ? reached : reached * (k + 1) / quarters;
    const double rate = (count_until(to) - count_until(from)) / (to - from);
    least = std::min(least, rate), greatest = std::max(greatest, rate);
  }
  const double rate = (so_far - count_until(reached / 2)) / (reached / 2), left = until - reached;
  return {so_far + left * least, so_far + left * rate, so_far + left * greatest};
}

CostEstimate estimate_cost(const Scene& scene, const Model& model, const Assembly& assembly, double seconds) {
  constexpr double share_of_the_run = 0.3;
  constexpr double longest_share = 0.1;  // relative to a simpler run
  const double begin = processor_time();
  const System& system = model.system;
  CostEstimate p;
  p.coordinates = system.n(), p.rows = system.n_rows(), p.integrals = system.n_z();
  p.terms = terms_of(system);
  estimate_rates(scene, system, p);
  p.until = scene.run.until;

  Integrator run(system, model.scheme, assembly.start);
  const Tried tried = try_for(run, system, model.scheme, p.until, share_of_the_run * seconds);
  p.run = cost_of(tried, p.until);
  if (!run.failure().empty()) p.run.trial.trouble = explained_failure(scene, model, assembly.start, run);
  estimate_rows(scene, model, run, p.output);
  estimate_frames(scene, model, run, p.output);
  const double outputs = p.output.seconds();
  p.seconds = {p.run.seconds.low + outputs, p.run.seconds.likely + outputs, p.run.seconds.high + outputs};
  const double impacts = p.run.trial.reached > 0 ? static_cast<double>(p.run.trial.impacts) * p.until / p.run.trial.reached : 0;
  p.memory = resident() + impacts * sizeof(Impact);

  if (!p.run.trial.trouble.empty()) return p;  // no computing time to reduce
  const std::vector<Simpler> models = simpler_models(scene, model, assembly.start);
  for (const Simpler& s : models) {
    if (since(begin) > clock_factor * seconds / 2) {
      p.untried.push_back(s.what);
      continue;
    }
    Integrator simpler(s.system, s.scheme, s.start);
    const double share = std::min(longest_share, (1 - share_of_the_run) / static_cast<double>(models.size()));
    const RunCost cost = cost_of(try_for(simpler, s.system, s.scheme, p.until, share * seconds), p.until);
    p.simpler.push_back({s.what, cost, false, part_saved(p, cost.seconds.likely + outputs)});
  }
  save_outputs(p);
  std::stable_sort(p.simpler.begin(), p.simpler.end(), [](const Saving& a, const Saving& b) { return a.saved > b.saved; });
  return p;
}

}  // namespace pintle
