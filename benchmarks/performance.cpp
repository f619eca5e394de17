// Error against time for every method of the scene language, over decades of tolerance, against hand-written models.
//   performance_page           runs all and writes docs/performance.md and docs/performance/*.svg
//   performance_page FILE      the same with a section on many links, from what
//                              bench_chains --benchmark_out=FILE --benchmark_out_format=json  has written
//   performance_page --quick   short runs at two tolerances; returns 1 if one fails or its error is too large
#include "benchmarks/performance.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <optional>
#include <sstream>

#include "framework/build/build.h"
#include "framework/scene/yaml/keys.h"
#include "tests/oracles/slider_crank_clearance.h"

namespace performance {

using namespace pintle;

namespace {

const std::string by_hand = "by hand";

/// A method at a tolerance.
struct Work {
  std::string method;
  double tolerance = 0, error = 0;
  std::vector<double> times = {};  ///< [s]
  Counts counts = {};
  std::string trouble = {}, reason = {};
  double time() const {
    std::vector<double> t = times;
    std::nth_element(t.begin(), t.begin() + static_cast<long>(t.size() / 2), t.end());
    return t[t.size() / 2];
  }
  bool usable() const { return trouble.empty() && error > 0 && std::isfinite(error); }
};

/// Time of one evaluation of the clearance oracle's right-hand side, the unit of all times [s].
double yardstick() {
  const pintle_oracle::Params params;
  pintle_oracle::State state = pintle_oracle::start(params);
  pintle_oracle::Y dy{};
  double sum = 0;
  constexpr int batch = 20000;
  std::vector<double> times;
  for (int k = 0; k < 11; ++k)
    times.push_back(seconds([&] {
                      for (int i = 0; i < batch; ++i) {
                        state.y[0] += 1e-9;
                        pintle_oracle::rhs(params, state, dy);
                        sum += dy[3];
                      }
                    }) /
                    batch);
  std::sort(times.begin(), times.end());
  return std::isfinite(sum) ? times[5] : NAN;
}

/// The same method at the tolerance before.
const Work* before(const std::vector<Work>& all, std::size_t k) {
  for (std::size_t i = k; i-- > 0;)
    if (all[i].method == all[k].method) return &all[i];
  return nullptr;
}

/// Runs every method at every tolerance alternately, so that other load of the machine affects all equally. A pair whose run takes long is
/// run less often.
std::vector<Work> measure(const Problem& p, const std::vector<std::string>& methods, bool quick) {
  struct Ready {
    Scene scene;
    Model model;
    Assembly assembly;
  };
  std::vector<Work> all;
  std::vector<std::vector<Ready>> ready;  // of each start; none by hand
  for (const double tolerance : p.tolerances) {
    if (p.by_hand()) all.push_back({by_hand, tolerance}), ready.emplace_back();
    for (const std::string& method : methods) {
      all.push_back({method, tolerance}), ready.emplace_back();
      for (const Start& start : p.starts) {
        Scene scene = start.scene(tolerance);
        scene.run.method = method;
        Model model = build(scene);
        Assembly assembly = assemble(scene, model);
        all.back().reason = model.scheme.reason;
        ready.back().push_back({std::move(scene), std::move(model), std::move(assembly)});
      }
    }
  }
  constexpr double seconds_a_pair = 1, too_long = 8;
  const std::size_t most = quick ? 1 : 15, least = quick ? 1 : 3;
  for (std::size_t round = 0; round < most; ++round)
    for (std::size_t k = 0; k < all.size(); ++k) {
      Work& w = all[k];
      if (!w.trouble.empty()) continue;
      if (const Work* looser = round == 0 ? before(all, k) : nullptr; looser && !(looser->time() <= too_long)) {
        w.times = {NAN};
        w.trouble = printed("left out, the tolerance before took more than %.0f s", too_long);
        continue;
      }
      if (round >= least && w.time() * static_cast<double>(round) > seconds_a_pair) continue;
      double time = 0, squares = 0;
      Counts counts;
      for (std::size_t i = 0; i < p.starts.size() && w.trouble.empty(); ++i) {
        Judged judged;
        Run run;
        time += seconds([&] {
          if (ready[k].empty())
            judged = p.starts[i].by_hand(w.tolerance);
          else
            run = simulate(ready[k][i].scene, ready[k][i].model, ready[k][i].assembly);
        });
        if (ready[k].empty()) {
          run.counts.evaluations = judged.evaluations;
        } else if (run.status == Status::finished || run.status == Status::ledger_over_bound) {
          judged.error = p.starts[i].error(run);
        } else {
          w.trouble = run.reason;
        }
        counts.steps += run.counts.steps, counts.rejected += run.counts.rejected;
        counts.evaluations += run.counts.evaluations, counts.factorizations += run.counts.factorizations;
        squares += judged.error * judged.error;
      }
      const double n = static_cast<double>(p.starts.size());
      w.times.push_back(time / n);
      w.error = std::sqrt(squares / n);
      w.counts = counts;
      for (long* c : {&w.counts.steps, &w.counts.rejected, &w.counts.evaluations, &w.counts.factorizations}) *c /= std::ssize(p.starts);
    }
  return all;
}

std::vector<std::string> methods_of(const std::vector<Work>& all) {
  std::vector<std::string> out;
  for (const Work& w : all)
    if (std::find(out.begin(), out.end(), w.method) == out.end()) out.push_back(w.method);
  return out;
}

/// log10 of the time a method needs for an error, interpolated between the two runs that enclose it; nothing if none do.
std::optional<double> time_for(const std::vector<Work>& all, const std::string& method, double error) {
  const double wanted = std::log10(error);
  const Work* before = nullptr;
  for (const Work& w : all) {
    if (w.method != method || !w.usable()) continue;
    if (before && before->error >= error && w.error <= error) {
      const double a = std::log10(before->error), b = std::log10(w.error);
      const double part = a > b ? (a - wanted) / (a - b) : 0;
      return std::log10(before->time()) + part * (std::log10(w.time()) - std::log10(before->time()));
    }
    before = &w;
  }
  return std::nullopt;
}

void plot(const Problem& p, const std::vector<Work>& all, double unit) {
  paper::Panel time{.title = p.title, .x_label = "time, in evaluations of the oracle", .y_label = "error", .curves = {}, .log = true};
  paper::Panel work = time;
  work.x_label = "evaluations of the equations of motion", work.title = "";
  for (const std::string& method : methods_of(all)) {
    paper::Curve t{.label = method, .x = {}, .y = {}, .dashed = method == by_hand}, e = t;
    for (const Work& w : all) {
      if (w.method != method || !w.usable()) continue;
      t.x.push_back(std::log10(w.time() / unit)), t.y.push_back(std::log10(w.error));
      if (w.counts.evaluations > 0)
        e.x.push_back(std::log10(static_cast<double>(w.counts.evaluations))), e.y.push_back(std::log10(w.error));
    }
    e.label.clear();  // the figure's legend is over the first panel
    time.curves.push_back(t), work.curves.push_back(e);
  }
  paper::figure("../performance/" + p.name, {time, work});
}

/// The results in sentences.
std::string said(const std::vector<Work>& all) {
  std::string out;
  for (const double error : {1e-3, 1e-5, 1e-7, 1e-9}) {
    std::vector<std::pair<double, std::string>> ranked;
    for (const std::string& method : methods_of(all))
      if (method != by_hand)
        if (const auto t = time_for(all, method, error)) ranked.emplace_back(*t, method);
    if (ranked.empty()) continue;
    std::sort(ranked.begin(), ranked.end());
    const double best = ranked.front().first;
    out += printed("- For an error of %.0e the fastest is %s, ", error, ranked.front().second.c_str()) +
           printed("%.3g ms", 1e3 * std::pow(10, best));
    if (const auto t = time_for(all, by_hand, error)) out += printed(", %.1f times the model written by hand", std::pow(10, best - *t));
    for (std::size_t i = 1; i < ranked.size(); ++i)
      out += printed("%s %s takes %.1f times as long", i == 1 ? ";" : ",", ranked[i].second.c_str(), std::pow(10, ranked[i].first - best));
    out += ".\n";
  }
  for (const Work& w : all)
    if (!w.trouble.empty()) out += printed("- %s at %.0e: %s.\n", w.method.c_str(), w.tolerance, w.trouble.c_str());
  std::string chosen;  // a reason begins with the name of the chosen method
  for (const Work& w : all) {
    const std::string name = w.reason.substr(0, w.reason.find(','));
    if (w.method == "auto" && name != chosen) out += printed("- auto at %.0e: ", w.tolerance) + w.reason + ".\n";
    if (w.method == "auto") chosen = name;
  }
  return out;
}

std::string section(const Problem& p, const std::vector<Work>& all, double unit) {
  std::ostringstream md;
  md << "\n## " << p.title << "\n\n"
     << p.text << "\n\n![" << p.title << "](performance/" << p.name << ".svg)\n\n"
     << said(all)
     << "\n| method | tolerance | error | time | in oracle evaluations | steps | rejected | evaluations | factorizations |\n"
        "|---|---|---|---|---|---|---|---|---|\n";
  for (const std::string& method : methods_of(all))
    for (const Work& w : all) {
      if (w.method != method) continue;
      const auto count = [&](long n) { return method == by_hand && n == 0 ? std::string("–") : std::to_string(n); };
      md << "| " << method << " | " << printed("%.0e | ", w.tolerance) << (w.trouble.empty() ? printed("%.1e", w.error) : "–")
         << (std::isnan(w.time()) ? std::string(" | – | –") : printed(" | %.3g ms | %.3g", 1e3 * w.time(), w.time() / unit)) << " | "
         << count(w.counts.steps) << " | " << count(w.counts.rejected) << " | " << count(w.counts.evaluations) << " | "
         << count(w.counts.factorizations) << " |\n";
    }
  return md.str();
}

const char* const head =
    "# Error against time\n\n"
    "How much time an error costs, for every method of the scene language and over decades of tolerance. This page and its figures are "
    "written by the program `performance_page` (benchmarks/performance.cpp), which anyone can run; `--quick` judges a part of it in the "
    "tests.\n\n"
    "- **Error**: against a reference that owes nothing to what is judged, said in each section.\n"
    "- **Time**: of computing, median of runs, all methods and tolerances turn about in one process; from the assembled start to the end, "
    "without reading "
    "and building. Milliseconds are of one machine on one day; \"in oracle evaluations\" they are divided by the time of one evaluation of "
    "the hand-written slider-crank's right-hand side, taken in the same process, which carries over to other machines.\n"
    "- **By hand**: a model of this mechanism alone, in its least number of coordinates, written out by hand (tests/oracles), under an "
    "error-controlled "
    "Dormand-Prince pair of its own. Between tolerances, comparisons at equal error interpolate logarithms.\n"
    "- **Evaluations** of the equations of motion, **factorizations** of their matrices.\n";

/// Errors fall with the tolerance and nothing fails.
int judge(const Problem& p, const std::vector<Work>& all) {
  int wrong = 0;
  for (const std::string& method : methods_of(all)) {
    const Work *loose = nullptr, *tight = nullptr;
    for (const Work& w : all)
      if (w.method == method) (loose ? tight : loose) = &w;
    if (!loose || !tight) continue;  // one tolerance shows no fall
    // Global errors are proportional to local ones; the factor depends on the sensitivity of the mechanism.
    const bool holds = loose->trouble.empty() && tight->trouble.empty() && loose->error < 1 &&
                       (tight->error < loose->error || tight->error < tight->tolerance);
    std::cout << (holds ? "ok    " : "FALSE ") << p.name << " " << method
              << printed(": %.1e at %.0e, %.1e at %.0e ", loose->error, loose->tolerance, tight->error, tight->tolerance) << loose->trouble
              << tight->trouble << "\n";
    wrong += !holds;
  }
  return wrong;
}

}  // namespace
}  // namespace performance

using namespace performance;

int main(int argc, char** argv) try {
  const bool quick = argc == 2 && std::strcmp(argv[1], "--quick") == 0;
  const std::string links = argc == 2 && !quick ? argv[1] : "";
  if (argc > 2 || links.starts_with("-")) {
    std::cerr << "performance_page [--quick | FILE.json of bench_chains]\n";
    return 2;
  }
  const auto known = pintle::choices("run", "method");
  std::vector<std::string> methods(known.begin(), known.end());
  std::erase(methods, "moreau");  // it has no tolerance
  const double unit = yardstick();
  std::ostringstream page;
  page << head << printed("- One evaluation of the oracle took %.0f ns.\n", 1e9 * unit);
  int wrong = 0;
  for (const Problem& p : problems(quick)) {
    const std::vector<Work> all = measure(p, methods, quick);
    if (quick) {
      wrong += judge(p, all);
      continue;
    }
    plot(p, all, unit);
    page << section(p, all, unit);
  }
  if (!quick) page << flexible_second();
  if (!links.empty()) page << links_section(links);
  if (!quick) paper::write(paper::source / "docs/performance.md", page.str());
  return wrong > 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
