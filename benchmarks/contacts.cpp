// Cost of contacts of profiles compared with clearance pins: a hundred discs in bearings, in round holes, on floors and in square holes of
// the ground. One evaluation of the equations with all contacts pressed and with all open, and a run in which all discs fall and bounce,
// per step. `ratio` is their cost over that of the pins, both measured alternately in this process: instructions if programs may count
// them, otherwise time. If not, `valgrind --tool=callgrind` counts those of `work_of_contacts` and `work_of_pins`.
#include <benchmark/benchmark.h>
#include <linux/perf_event.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/integration/integrator.h"
#include "framework/scene/yaml/reader.h"

namespace {

using namespace pintle;

/// Instructions of this process in user space, or nanoseconds of its thread if the kernel does not let it count.
class Work {
 public:
  Work() {
    perf_event_attr what{};
    what.type = PERF_TYPE_HARDWARE, what.size = sizeof what, what.config = PERF_COUNT_HW_INSTRUCTIONS;
    what.disabled = 1, what.exclude_kernel = 1, what.exclude_hv = 1;
    counter_ = static_cast<int>(syscall(SYS_perf_event_open, &what, 0, -1, -1, 0));
  }
  ~Work() {
    if (counts()) close(counter_);
  }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;
  bool counts() const { return counter_ >= 0; }
  template <class F>
  double of(const F& what) const {
    const double begin = now();
    if (counts()) ioctl(counter_, PERF_EVENT_IOC_ENABLE, 0);
    what();
    if (counts()) ioctl(counter_, PERF_EVENT_IOC_DISABLE, 0);
    return now() - begin;
  }

 private:
  double now() const {
    std::uint64_t n = 0;
    if (counts() && read(counter_, &n, sizeof n) == sizeof n) return static_cast<double>(n);
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
  }
  int counter_;
};

struct Hanging {
  Scene scene;
  Model model;
  State start;
};
/// n discs of 9.5 mm side by side, each `off` above its wall [m]; negative: overlapping it.
Hanging hanging(const std::string& how, int n, double off) {
  const bool pins = how == "pins";
  const auto pair = [](double x, double y) { return "[" + std::to_string(x) + ", " + std::to_string(y) + "]"; };
  const std::string law = "normal: {lankarani-nikravesh: {restitution: 0.7, stiffness: 5e9}}, friction: {ambrosio: {coefficient: 0.1}}";
  std::string ground, bodies, joined, start;
  for (int i = 0; i < n; ++i) {
    const std::string k = std::to_string(i), disc = "b" + k;
    const double x = 0.05 * i, y = how == "floors" || how == "boxes" ? 9.5e-3 + off : off - 5e-4;
    bodies += "  " + disc + ": {rigid: {mass: 0.5, inertia: 1e-4}, profiles: {rim: {disc: [0, 0], radius: 9.5 mm}}}\n";
    std::string wall = pair(x, 0);
    if (how == "holes") wall = "{hole: " + wall + ", radius: 10 mm}";
    if (how == "floors") wall = "{path: [" + pair(x + 0.02, 0) + ", " + pair(x - 0.02, 0) + "]}";
    if (how == "boxes")
      wall = "{path: [" + pair(x - 0.02, 0) + ", " + pair(x + 0.02, 0) + ", " + pair(x + 0.02, 0.04) + ", " + pair(x - 0.02, 0.04) +
             "], closed: true, material: outside}";
    ground += (i > 0 ? ", P" : "P") + k + ": " + wall;
    joined += "  c" + k +
              (pins ? ": {revolute: [ground.P" + k + ", " + disc +
                          "], clearance: {radial: 0.5 mm, bearing radius: 10 mm, bearing: ground, " + law + "}}\n"
                    : ": {between: [" + disc + ".rim, ground.P" + k + "], " + law + "}\n");
    start += pins ? "  c" + k + ": {eccentricity: [0, " + std::to_string(y) + "]}\n" : "  " + disc + ": {at: " + pair(x, y) + "}\n";
  }
  Scene scene = read_scene_text("gravity: [0, -9.81]\nground: {" + std::string(pins ? "points: {" : "profiles: {") + ground +
                                    "}}\nbodies:\n" + bodies + (pins ? "joints:\n" : "contacts:\n") + joined + "start:\n" + start +
                                    "run: {until: 1, method: dopri5}\noutput: {frames: 0}\n",
                                "contacts.yaml");
  Model model = build(scene);
  State at_start = assemble(scene, model).start;
  return {std::move(scene), std::move(model), std::move(at_start)};
}

constexpr int discs = 100;

/// Repeated on the same state.
class Evaluations {
 public:
  explicit Evaluations(Hanging h)
      : h_(std::move(h)),
        state_(Integrator(h_.model.system, h_.model.scheme, h_.start).state()),
        eq_(h_.model.system),
        dy_(h_.model.system.n_y()) {}
  void take(int count) {
    for (int i = 0; i < count; ++i) {
      state_.y[2] += 1e-12;
      if (!evaluate(h_.model.system, state_, eq_, dy_)) throw std::runtime_error("singular");
    }
  }

 private:
  Hanging h_;
  State state_;
  Equations eq_;
  Eigen::VectorXd dy_;
};
/// A run with impacts.
class Steps {
 public:
  explicit Steps(Hanging h) : h_(std::move(h)) {}
  void take(int count) {
    Integrator run(h_.model.system, h_.model.scheme, h_.start);
    for (int i = 0; i < count && run.advance(1); ++i) {
    }
    evaluations_ = static_cast<double>(run.counts().evaluations), impacts_ = static_cast<double>(run.impacts().size());
  }
  double evaluations() const { return evaluations_; }
  double impacts() const { return impacts_; }

 private:
  Hanging h_;
  double evaluations_ = 0, impacts_ = 0;
};

template <class What>
[[gnu::noinline]] void work_of_pins(What& what, int count) {
  what.take(count);
}
template <class What>
[[gnu::noinline]] void work_of_contacts(What& what, int count) {
  what.take(count);
}

template <class What>
void against_pins(benchmark::State& bench, What& contacts, What& pins, int count) {
  const Work work;
  double ours = 0, theirs = 0;
  for (auto _ : bench) {
    ours += work.of([&] { work_of_contacts(contacts, count); });
    theirs += work.of([&] { work_of_pins(pins, count); });
  }
  bench.counters["ratio"] = ours / theirs;
  bench.counters[work.counts() ? "instructions_per_contact" : "ns_per_contact"] =
      ours / static_cast<double>(bench.iterations()) / count / discs;
}

void Evaluation(benchmark::State& bench, const std::string& how, double off) {
  Evaluations contacts(hanging(how, discs, off)), pins(hanging("pins", discs, off));
  against_pins(bench, contacts, pins, 100);
}
/// Two hundred steps, into the first impacts.
void Falling(benchmark::State& bench, const std::string& how) {
  Steps contacts(hanging(how, discs, 1e-4)), pins(hanging("pins", discs, 1e-4));
  against_pins(bench, contacts, pins, 200);
  bench.counters["evaluations"] = contacts.evaluations(), bench.counters["evaluations_of_pins"] = pins.evaluations();
  bench.counters["impacts"] = contacts.impacts(), bench.counters["impacts_of_pins"] = pins.impacts();
}

const bool registered = [] {
  for (const std::string how : {"holes", "floors", "boxes"}) {
    const auto add = [&](const std::string& name, auto what) { benchmark::RegisterBenchmark((name + how).c_str(), what)->Iterations(3); };
    add("Evaluation/pressed/", [how](benchmark::State& b) { Evaluation(b, how, -1e-6); });
    add("Evaluation/open/", [how](benchmark::State& b) { Evaluation(b, how, 1e-4); });
    add("Falling/", [how](benchmark::State& b) { Falling(b, how); });
  }
  return true;
}();

}  // namespace

BENCHMARK_MAIN();
