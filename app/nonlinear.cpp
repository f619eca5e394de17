// pintle nonlinear: Poincaré sections, bifurcation diagrams, periodic orbits, Lyapunov exponents.
#include "framework/study/nonlinear/nonlinear.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>

#include "app/options.h"
#include "app/progress.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/plots/plot.h"
#include "framework/study/nonlinear/attractors.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

std::string words_of_period(std::size_t period) { return period == 0 ? "no period found" : "period " + std::to_string(period); }

/// ", backwards", if both directions are followed.
std::string branch_words(const Nonlinear& study, const FollowedValue& value) {
  return study.order != Order::both ? "" : value.backwards ? ", backwards" : ", forwards";
}

/// One row for each stretch of values that have the same period.
void add_periods(const Nonlinear& study, const std::vector<FollowedValue>& values, Rows& rows) {
  for (std::size_t k = 0; k < values.size();) {
    std::size_t end = k + 1;
    const auto same = [&](const FollowedValue& v) {
      return v.period == values[k].period && v.status == values[k].status && v.backwards == values[k].backwards;
    };
    while (end < values.size() && same(values[end])) ++end;
    std::string where = study.varies() ? values[k].parameters[0] : counted(values[k].orbit.t.size(), "return");
    if (end - k > 1) where += " to " + values[end - 1].parameters[0] + " (" + std::to_string(end - k) + " values)";
    where += branch_words(study, values[k]);
    const bool finished = values[k].status == "finished";
    rows.emplace_back(finished ? words_of_period(values[k].period) : values[k].status, finished ? where : where + ": " + values[k].reason);
    k = end;
  }
}

/// One row for each of the largest basins, and for each status of starts that end on no attractor.
void add_basins(const Nonlinear& study, const std::vector<FollowedValue>& values, Rows& rows) {
  constexpr std::size_t most_shown = 12;
  std::string names;
  for (const std::string& one : parameter_headers(study)) names += (names.empty() ? "" : ", ") + one;
  rows.emplace_back("starts", std::to_string(values.size()) + " of " + names);
  const auto percent = [](double share) { return number(100 * share, 4); };
  const std::vector<Basin> all = basins(values);
  for (std::size_t k = 0; k < std::min(all.size(), most_shown); ++k) {
    const Basin& basin = all[k];
    std::string text = percent(basin.share) + " %";
    if (study.basins->random) {
      const ShareBounds bounds = share_bounds(basin.starts, values.size());
      text += " (95 %: " + percent(bounds.least) + " to " + percent(bounds.most) + ")";
    }
    rows.emplace_back("attractor " + std::to_string(k + 1),
                      text + ", " + words_of_period(values[basin.first].period) + ", e.g. from " + place_words(study, values[basin.first]));
  }
  if (all.size() > most_shown) rows.emplace_back("", "and " + std::to_string(all.size() - most_shown) + " more: attractors.csv");
  std::map<std::string, std::vector<const FollowedValue*>> others;
  for (const FollowedValue& value : values)
    if (value.attractor == 0) others[value.status].push_back(&value);
  for (const auto& [status, those] : others)
    rows.emplace_back(
        status, percent(static_cast<double>(those.size()) / static_cast<double>(values.size())) + " %, the first: " + those[0]->reason);
}

/// The exponents of the only value, and their sum.
void add_exponents(const Orbit& orbit, Rows& rows) {
  double sum = 0;
  for (std::size_t j = 0; j < orbit.exponents.size(); ++j) {
    const Exponent& one = orbit.exponents[j];
    sum += one.value;
    rows.emplace_back("exponent " + std::to_string(j + 1),
                      number(one.value) + (std::isnan(one.error) ? "" : " +- " + number(one.error, 2)) + " 1/s" +
                          (std::isnan(one.error)
                               ? ", its error not known: lyapunov.over has fewer than " + std::to_string(exponent_batches) + " intervals"
                               : ""));
  }
  if (orbit.exponents.size() > 1) rows.emplace_back("their sum", number(sum) + " 1/s");
}

void add_impacts(const ImpactFigures& f, std::size_t returns, Rows& rows) {
  if (f.count == 0 || returns == 0) return;
  rows.emplace_back("impacts a return", number(f.count / static_cast<double>(returns)));
  rows.emplace_back("approach", number(f.least_approach) + " to " + number(f.most_approach) + " m/s, median " + number(f.median));
  rows.emplace_back("time in contact", number(100 * f.contact_share, 4) + " %");
  if (f.grazing > 0) rows.emplace_back("grazing", number(f.grazing) + " impacts slower than 5 % of the median");
}

/// A value with the digits that its error leaves certain, at least one.
std::string known_digits(double x, double error) {
  constexpr int most = 6;
  if (!(error > 0) || x == 0) return number(x);
  return number(x, std::clamp(static_cast<int>(std::floor(std::log10(std::abs(x))) - std::floor(std::log10(error))) + 1, 1, most));
}

std::string multiplier_text(const Cycle& cycle, std::size_t j) {
  const auto known = [&](double x) { return known_digits(x, cycle.error[j]); };
  const std::string value =
      known(cycle.re[j]) + (cycle.im[j] == 0 ? "" : (cycle.im[j] < 0 ? " - " : " + ") + known(std::abs(cycle.im[j])) + "i");
  return value + ", modulus " + known(cycle.modulus(j)) + (std::isnan(cycle.error[j]) ? "" : ", error below " + number(cycle.error[j], 2));
}

/// The periodic orbit of the only value.
void add_orbit(const Cycle& cycle, Rows& rows) {
  if (!cycle.found()) return;
  constexpr std::size_t most_told = 8;
  rows.emplace_back("orbit", stability_word(stability(cycle)) + ", period " + number(cycle.period) + " s");
  if (cycle.least < static_cast<double>(cycle.signals.size())) rows.emplace_back("", "it closes after " + number(cycle.least) + " returns");
  for (std::size_t j = 0; j < std::min(cycle.re.size(), most_told); ++j)
    rows.emplace_back("multiplier " + std::to_string(j + 1), multiplier_text(cycle, j));
  if (cycle.re.size() > most_told) rows.emplace_back("", "and " + counted(cycle.re.size() - most_told, "smaller one") + ": orbits.csv");
}

/// One row for each kind of stability with its number of values, and one for each loss of stability.
void add_branch(const Nonlinear& study, const std::vector<FollowedValue>& values, Rows& rows) {
  for (const OrbitStability one : {OrbitStability::stable, OrbitStability::neutral, OrbitStability::unstable}) {
    const auto is_one = [&](const FollowedValue& v) { return v.orbit.cycle.found() && stability(v.orbit.cycle) == one; };
    if (const auto n = std::ranges::count_if(values, is_one); n > 0)
      rows.emplace_back(stability_word(one) + " orbits", "at " + counted(static_cast<std::size_t>(n), "value"));
  }
  for (const LossOfStability& loss : losses_of_stability(values))
    rows.emplace_back(crossing_words(loss.through), "near " + number(loss.x) + ", between " + values[loss.before].parameters[0] + " and " +
                                                        values[loss.after].parameters[0] + branch_words(study, values[loss.before]));
}

void print(const Nonlinear& study, const SweepEnd& end, const std::vector<FollowedValue>& values, const fs::path& out) {
  std::cout << (study.sweep.study.title.empty() ? study.sweep.study.file : study.sweep.study.title) << "\n";
  Rows rows;
  if (study.basins)
    add_basins(study, values, rows);
  else if (study.varies())
    rows.emplace_back("values of", parameter_headers(study)[0]);
  if (study.question.section && !study.basins) add_periods(study, values, rows);
  if (!study.varies() && !values.empty()) {
    if (const double k = values[0].orbit.zero_one; !std::isnan(k)) rows.emplace_back("0-1 test", "K = " + number(k, 3));
    if (const double d = values[0].orbit.dimension; !std::isnan(d))
      rows.emplace_back("section", "of correlation dimension " + number(d, 3));
    add_orbit(values[0].orbit.cycle, rows);
    add_exponents(values[0].orbit, rows);
    add_impacts(values[0].orbit.impacts, values[0].orbit.t.size(), rows);
  }
  constexpr double nearer_to_one = 0.5;
  const auto chaotic = std::ranges::count_if(values, [](const FollowedValue& v) { return v.orbit.zero_one > nearer_to_one; });
  if (study.varies() && chaotic > 0)
    rows.emplace_back("0-1 test", "K nearer to 1 than to 0 at " + counted(static_cast<std::size_t>(chaotic), "value"));
  if (study.varies() && study.question.cycle) add_branch(study, values, rows);
  const auto grazes = std::ranges::count_if(values, [](const FollowedValue& v) { return v.orbit.impacts.grazing > 0; });
  if (study.varies() && grazes > 0) rows.emplace_back("grazing", "at " + std::to_string(grazes) + " values: see values.csv");
  const auto positive = std::ranges::count_if(values, [](const FollowedValue& v) {
    return !v.orbit.exponents.empty() && v.orbit.exponents[0].value > 2 * v.orbit.exponents[0].error;
  });
  if (study.varies() && study.question.lyapunov)
    rows.emplace_back("chaos", "greatest exponent above twice its standard error at " + std::to_string(positive) + " values");
  if (end.count.before > 0) rows.emplace_back("earlier sessions", std::to_string(end.count.before) + " of " + std::to_string(study.size()));
  rows.emplace_back("results", (out / (study.question.section ? "section.csv" : "lyapunov.csv")).string());
  print_rows(std::cout, rows);
}

Curve dots(const std::string& label) { return {.label = label, .x = {}, .y = {}, .dashed = false, .points = true}; }

/// Periodic orbits over the returns, at the positions that `at` gives: filled dots where they are stable.
template <class F>
void add_orbits(const std::vector<FollowedValue>& values, const F& at, Panel& panel) {
  for (const bool stable : {true, false}) {
    Curve curve = dots(stable ? "stable orbit" : "unstable orbit");
    curve.hollow = !stable;
    for (const FollowedValue& value : values) {
      const Cycle& cycle = value.orbit.cycle;
      if (!cycle.found() || (stability(cycle) == OrbitStability::unstable) == stable) continue;
      for (std::size_t k = 0; k < cycle.signals.size(); ++k) {
        const auto [x, y] = at(value, k, cycle.signals[k]);
        curve.x.push_back(x), curve.y.push_back(y);
      }
    }
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
}

/// Without a parameter: the second signal over the first, or the only one over the number of the return.
Panel map_of_returns(const FollowedValue& value, const std::vector<std::string>& headers) {
  Panel panel{
      .title = "", .x_label = headers.size() > 1 ? headers[0] : "return", .y_label = headers[headers.size() > 1 ? 1 : 0], .curves = {}};
  const auto at = [](const FollowedValue&, std::size_t k, const std::vector<double>& one) {
    return std::pair(one.size() > 1 ? one[0] : static_cast<double>(k + 1), one.size() > 1 ? one[1] : one[0]);
  };
  Curve& curve = panel.curves.emplace_back(dots(""));
  for (std::size_t k = 0; k < value.orbit.signals.size(); ++k) {
    const auto [x, y] = at(value, k, value.orbit.signals[k]);
    curve.x.push_back(x), curve.y.push_back(y);
  }
  add_orbits({value}, at, panel);
  return panel;
}

/// A curve of points for each of the largest basins, at the positions that `at` gives of a value.
template <class F>
Panel of_basins(const std::vector<FollowedValue>& values, Panel panel, const F& add) {
  constexpr std::size_t most_shown = 5;  // and the others, each in a colour of its own
  const std::size_t count = std::min(basins(values).size(), most_shown);
  for (std::size_t k = 1; k <= count + 1; ++k) {
    Curve curve = dots(k > count ? "others" : (k == 1 ? "attractor " : "") + std::to_string(k));
    curve.hollow = k > count;
    for (const FollowedValue& value : values)
      if (k <= count ? value.attractor == k : value.attractor == 0 || value.attractor > count) add(value, curve);
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

/// The starts in the plane of the first two names, or the returns over the only name; then the returns, the second signal over the first.
std::vector<Panel> pictures_of_basins(const Nonlinear& study, const std::vector<FollowedValue>& values,
                                      const std::vector<std::string>& headers) {
  const std::vector<std::string> names = parameter_headers(study);
  const bool plane = names.size() > 1, map = headers.size() > 1;
  const double radius = std::clamp(130 / std::sqrt(static_cast<double>(values.size())), 1.0, 5.0);  // dots of a grid nearly touch
  std::vector<Panel> out{of_basins(values, {.title = "", .x_label = names[0], .y_label = plane ? names[1] : headers[0], .curves = {}},
                                   [&](const FollowedValue& value, Curve& curve) {
                                     if (plane) curve.x.push_back(value.at[0]), curve.y.push_back(value.at[1]), curve.radius = radius;
                                     for (std::size_t k = 0; k < value.orbit.signals.size() && !plane; ++k)
                                       curve.x.push_back(value.at[0]), curve.y.push_back(value.orbit.signals[k][0]);
                                   })};
  const std::vector<Basin> all = basins(values);
  out.push_back(of_basins(values, {.title = "", .x_label = map ? headers[0] : "return", .y_label = headers[map ? 1 : 0], .curves = {}},
                          [&](const FollowedValue& value, Curve& curve) {
                            if (value.attractor == 0 || &value != &values[all[value.attractor - 1].first]) return;
                            for (std::size_t k = 0; k < value.orbit.signals.size(); ++k) {
                              const std::vector<double>& one = value.orbit.signals[k];
                              curve.x.push_back(map ? one[0] : static_cast<double>(k + 1)), curve.y.push_back(one[map ? 1 : 0]);
                            }
                          }));
  return out;
}

/// A signal of all returns over the parameter, each direction in a colour.
Panel diagram(const Nonlinear& study, const std::vector<FollowedValue>& values, const std::string& header, std::size_t signal) {
  Panel panel{.title = "", .x_label = parameter_headers(study)[0], .y_label = header, .curves = {}};
  for (const bool backwards : {false, true}) {
    Curve curve = dots(study.order != Order::both ? "" : backwards ? "backwards" : "forwards");
    for (const FollowedValue& value : values)
      if (value.backwards == backwards)
        for (const std::vector<double>& one : value.orbit.signals) curve.x.push_back(value.at[0]), curve.y.push_back(one[signal]);
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  add_orbits(
      values,
      [signal](const FollowedValue& value, std::size_t, const std::vector<double>& one) { return std::pair(value.at[0], one[signal]); },
      panel);
  return panel;
}

Panel exponents_over(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  Panel panel{
      .title = "", .x_label = study.varies() ? parameter_headers(study)[0] : "t [s]", .y_label = "Lyapunov exponents [1/s]", .curves = {}};
  for (std::size_t j = 0; j < static_cast<std::size_t>(study.question.lyapunov->exponents); ++j) {
    Curve curve = dots("exponent " + std::to_string(j + 1));
    curve.points = study.varies();
    for (const FollowedValue& value : values) {
      if (study.varies() && j < value.orbit.exponents.size())
        curve.x.push_back(value.at[0]), curve.y.push_back(value.orbit.exponents[j].value);
      if (study.varies()) continue;
      for (std::size_t k = 0; k < value.orbit.running.size(); ++k)
        curve.x.push_back(value.orbit.running_t[k]), curve.y.push_back(value.orbit.running[k][j]);
    }
    if (!curve.x.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

std::string picture_of(const Nonlinear& study, const std::vector<FollowedValue>& values, const std::vector<std::string>& headers) {
  std::vector<Panel> panels;
  if (study.basins) panels = pictures_of_basins(study, values, headers);
  for (std::size_t i = 0; i < headers.size() && study.varies() && !study.basins; ++i)
    panels.push_back(diagram(study, values, headers[i], i));
  if (!headers.empty() && !study.varies()) panels.push_back(map_of_returns(values[0], headers));
  if (study.question.lyapunov) panels.push_back(exponents_over(study, values));
  return svg(panels, 1);
}

/// "3 of 26 values, the next at return 37 of 432, 2 min 5 s left".
std::string how_far(const SweepCount& c, const Underway& now) {
  std::string out = std::to_string(c.before + c.done) + " of " + std::to_string(c.cases) + " values";
  if (now.values == 1) out += ", the next at " + now.at;
  if (now.values > 1)
    out += ", " + number(100 * now.share / static_cast<double>(now.values), 2) + " % of the next " + std::to_string(now.values);
  return out + time_left(static_cast<double>(c.done) + now.share, static_cast<double>(c.cases - c.before), c.seconds);
}

void warn_of_doubts(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  const auto doubted = [](const FollowedValue& v) { return v.status == "finished" && !v.reason.empty(); };
  const auto n = std::ranges::count_if(values, doubted);
  if (n == 0) return;
  const FollowedValue& first = *std::ranges::find_if(values, doubted);
  std::cerr << study.sweep.study.file << ": warning: ";
  if (values.size() > 1) std::cerr << "at " << n << " of " << values.size() << " values, the first " << place_words(study, first) << ": ";
  std::cerr << first.reason << "\n";
}

/// Reports values without all requested results. @returns the exit code
int exit_after(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  const auto lacks = [](const FollowedValue& v) { return v.status != "finished"; };
  const auto n = std::ranges::count_if(values, lacks);
  if (n == 0) return ok;
  const bool none = n == std::ssize(values);
  const FollowedValue& first = *std::ranges::find_if(values, lacks);
  const std::string where = study.varies() ? place_words(study, first) + ": " : "";
  std::cerr << study.sweep.study.file << ": " << (none ? "" : "warning: ");
  if (values.size() == 1)
    std::cerr << "the motion could not be followed to the end: ";
  else
    std::cerr << (none ? "none" : std::to_string(n)) << " of " << values.size() << " values could " << (none ? "" : "not ")
              << "be followed to the end; the first: ";
  std::cerr << where << first.status << ": " << first.reason << "\n";
  return none ? run_failed : ok;
}

}  // namespace

int nonlinear(const Options& options) {
  now_doing("reading the study");
  const Nonlinear study = read_nonlinear(options.scene, overrides(options));
  const fs::path out = study_directory(options, "-nonlinear");
  SweepSettings settings;
  settings.threads = thread_count(options);
  handle_signals();
  SweepEnd end;
  now_doing("following the motion");
  {
    StudyLine line(options.quiet);
    Underway now;
    settings.progress = [&](const SweepCount& c) {
      line.tell([&] { return how_far(c, now); });
      return !asked_to_stop();
    };
    end = run_nonlinear(study, out, settings, [&](const Underway& far) { now = far; });
  }
  for (const std::string& note : end.notes) std::cerr << "note: " << note << "\n";
  if (!end.shortage.empty()) std::cerr << "warning: " << end.shortage << "\n";
  const std::vector<FollowedValue> values = followed(study, end.rows);
  if (!values.empty()) write_synced(out / "section.svg", picture_of(study, values, signal_headers(study, values)));
  if (!end.whole) {
    std::cerr << study.sweep.study.file << ": " << (asked_to_stop() ? stopped_by() : "stopped") << " after " << end.rows.size() << " of "
              << study.size() << " values" << (values.empty() ? "" : ", which " + (out / "section.svg").string() + " shows")
              << "; the same command continues from here\n";
    return stopped;
  }
  if (const std::string warnings = warnings_text(end.rows, out / "warnings.csv"); !warnings.empty())
    std::cerr << "warning: " << warnings << "\n";
  const auto has_some = [](const FollowedValue& v) { return v.status == "finished" || !v.orbit.t.empty() || !v.orbit.exponents.empty(); };
  if (options.json)
    std::cout << nonlinear_json(study, values);
  else if (std::ranges::any_of(values, has_some) && !options.quiet)
    print(study, end, values, out);
  std::cout.flush();
  warn_of_doubts(study, values);
  return exit_after(study, values);
}

}  // namespace pintle::app
