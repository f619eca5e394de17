#include "framework/study/tradeoff/tradeoff_words.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/common/printed.h"
#include "framework/common/text.h"

namespace pintle {

namespace {

std::string value_text(const TradeReport& r, std::size_t axis, std::size_t value) {
  return r.plan.axes[axis].name + " " + r.plan.axes[axis].values[value].label;
}

std::string times_text(double factor) {
  if (std::abs(factor - 1) < 0.05) return "about the same time";
  return factor > 1 ? printed("%.2g times the time", factor) : printed("%.2g of the time", factor);
}

/// Ends the message with exactly one full stop.
std::string stopped(std::string s) {
  while (!s.empty() && (s.back() == '.' || s.back() == ' ')) s.pop_back();
  return s + ".";
}

/// Whether the reference is accurate enough to compare settings with it.
bool known(const TradeReport& r) { return r.warning() <= (r.plan.error > 0 ? r.plan.error : useful_warning); }

void say_stopped(const TradeReport& r, std::vector<std::string>& said) {
  const std::string when = printed(" after %s: ", time_text(r.seconds).c_str());
  const std::string ran = r.ran() == 0 ? "no setting had run to its end" : printed("%zu of %zu settings had run", r.ran(), r.listed());
  const bool reference = r.reference.of.empty() || !r.reference.trouble.empty();
  if (r.stopped)
    said.push_back("Stopped by the user" + when + (reference ? "the reference was not found, and " : "") + ran +
                   (r.ran() == 0 ? "." : ". What follows is based on these only."));
  else if (r.cut)
    said.push_back("The budget of " + time_text(r.plan.budget) +
                   printed(" was spent when %zu of %zu settings had run", r.ran(), r.listed()) +
                   "; a larger budget (--budget) runs more of them.");
}

std::string spans(const FidelityAxis& axis) {
  std::string s = axis.name + " ";
  for (std::size_t v = 0; v < axis.values.size(); ++v)
    if (!axis.ordered || v == 0 || v + 1 == axis.values.size())
      s += (v == 0 ? "" : axis.ordered ? axis.values.size() > 2 ? " … " : ", " : ", ") + axis.values[v].label;
  return s;
}

void say_axes(const TradeReport& r, std::vector<std::string>& said) {
  if (!r.plan.suggested) return;
  std::string s;
  for (const FidelityAxis& axis : r.plan.axes) s += (s.empty() ? "" : "; ") + spans(axis);
  said.push_back("Axes chosen from the scene, because no study names any: " + s + ".");
}

// --- what is recommended -----------------------------------------------------------------------------------------

void say_wanted(const TradeReport& r, std::vector<std::string>& said) {
  const TradePlan& plan = r.plan;
  if (plan.error > 0 && r.cheapest)
    said.push_back("Cheapest" + of_how_many(r) + " for an error of " + percent_text(plan.error) + ": " +
                   setting_text(plan, r.points[*r.cheapest]) + ", " + cost_text(r, *r.cheapest) + ".");
  if (plan.time > 0 && r.best_in_time)
    said.push_back("Most accurate" + of_how_many(r) + " within " + time_text(plan.time) + ", within the uncertainty: " +
                   setting_text(plan, r.points[*r.best_in_time]) + ", " + cost_text(r, *r.best_in_time) + ".");
  else if (plan.time > 0)
    said.push_back("No setting" + of_how_many(r) + " takes at most " + time_text(plan.time) + "; the fastest is " +
                   setting_text(plan, r.points[r.front.front()]) + ", " + cost_text(r, r.front.front()) +
                   (r.recommended ? "." : ". Nothing is recommended."));
  if (plan.error <= 0 && plan.time <= 0)
    said.push_back("Without a requested error or time, the knee of the front is recommended, beyond which more time gains little: " +
                   setting_text(plan, r.points[*r.recommended]) + ", " + cost_text(r, *r.recommended) + of_how_many(r) + ".");
}

void say_as_it_stands(const TradeReport& r, std::vector<std::string>& said) {
  const TradePoint& p = r.points.front();
  if (!p.usable) {
    said.push_back(stopped("The scene as it stands was not evaluated: " + p.status + (p.reason.empty() ? "" : ", " + p.reason)));
    return;
  }
  std::string s = "The scene as it stands takes " + cost_text(r, 0);
  if (r.recommended && *r.recommended != 0) s += "; the recommended setting takes " + times_text(r.points[*r.recommended].time / p.time);
  said.push_back(s + ".");
}

/// "from 1e-4 to 1e-5"
std::string step_text(const TradeReport& r, std::size_t point, const AxisEffect& e) {
  const FidelityAxis& axis = r.plan.axes[e.axis];
  return "from " + axis.values[r.points[point].at[e.axis]].label + " to " + axis.values[e.to].label;
}

/// Whether there is a setting that differs only in this axis and has not been run.
bool waits(const TradeReport& r, std::size_t point, std::size_t axis) {
  return std::ranges::any_of(r.points, [&](const TradePoint& p) {
    if (p.at.size() != r.points[point].at.size() || (p.status != "not run" && p.status != "over its limit")) return false;
    for (std::size_t a = 0; a < p.at.size(); ++a)
      if ((p.at[a] == r.points[point].at[a]) == (a == axis)) return false;
    return true;
  });
}

/// Effect of each single axis on the recommended setting, towards finer and coarser values.
void say_bottleneck(const TradeReport& r, std::vector<std::string>& said) {
  const std::size_t at = *r.recommended;
  const TradePoint& p = r.points[at];
  if (p.at.empty()) return;
  const std::optional<AxisEffect> first = first_step(r, at);
  std::string idle, untried;
  const std::vector<AxisEffect> all = neighbours(r, at);
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a) {
    const FidelityAxis& axis = r.plan.axes[a];
    std::size_t finer = 0, ran = 0;
    double change = 0;
    for (std::size_t v = 0; v < axis.values.size(); ++v) finer += v != p.at[a] && (!axis.ordered || v > p.at[a]);
    for (const AxisEffect& e : all)
      if (e.axis == a && (!axis.ordered || e.to > p.at[a]))
        ++ran,
            change = std::max(change, std::abs(r.points[e.point].counted() - p.counted()) - std::max(r.points[e.point].warning, p.warning));
    if (finer == 0 || (first && first->axis == a)) continue;
    if (ran == 0 && waits(r, at, a))
      untried += (untried.empty() ? "" : ", ") + axis.name;
    else if (ran > 0 && axis.ordered && ran == finer && change <= 0.1 * p.claimed())
      idle += (idle.empty() ? "" : "; ") + axis.name + " beyond " + axis.values[p.at[a]].label;
  }
  std::string s;
  if (first)
    s = "To decrease the error, refine " + r.plan.axes[first->axis].name + " first: " + step_text(r, at, *first) +
        " changes the error from " + error_text(p) + " to " + error_text(r.points[first->point]) + " for " + times_text(first->time_factor);
  else if (p.counted() <= p.warning)
    s = "Its error is below the uncertainty of the reference, " + percent_text(p.warning) +
        ", so the effect of a refinement cannot be seen";
  else if (!all.empty())
    s = "Refining a single axis decreases its error by at most a fifth";
  if (!idle.empty() && p.counted() > p.warning) s += (s.empty() ? "Finer " : "; ") + idle + " changes nothing";
  if (!untried.empty())
    s += (s.empty() ? "Finer values did not run, so their effect is unknown: " : "; its finer values did not run: ") + untried;
  if (!s.empty()) said.push_back(s + ".");
}

/// Why it is not cheaper: the error one step coarser.
void say_coarser(const TradeReport& r, std::vector<std::string>& said) {
  const std::size_t at = *r.recommended;
  const TradePoint& p = r.points[at];
  std::string s;
  for (const AxisEffect& e : neighbours(r, at))
    if (r.plan.axes[e.axis].ordered && e.to + 1 == p.at[e.axis] && r.points[e.point].claimed() > 1.25 * p.claimed())
      s += (s.empty() ? "" : "; ") + value_text(r, e.axis, e.to) + " would have an error of " + error_text(r.points[e.point]) + " in " +
           times_text(e.time_factor);
  if (!s.empty()) said.push_back("One step coarser on a single axis: " + s + ".");
}

void say_luck(const TradeReport& r, std::vector<std::string>& said) {
  std::size_t lucky = 0;
  const TradePoint* most = nullptr;
  for (const TradePoint& p : r.points)
    if (p.usable && p.surer > p.error && ++lucky &&
        (!most || p.surer / std::max(p.error, p.warning) > most->surer / std::max(most->error, most->warning)))
      most = &p;
  if (!most) return;
  said.push_back(settings_text(lucky) + (lucky == 1 ? " has" : " have") +
                 " a smaller error than the same at a finer tolerance, because errors of computing and of the model cancel by chance; the "
                 "larger error counts: " +
                 setting_text(r.plan, *most) + " gives " + percent_text(std::max(most->error, most->warning)) + " and counts as " +
                 percent_text(most->surer) + ".");
}

/// The time that the finest setting uses without benefit.
void say_free(const TradeReport& r, std::vector<std::string>& said) {
  for (std::size_t i = 0; i < r.points.size(); ++i) {
    bool finest = r.points[i].usable && !r.points[i].at.empty() && r.recommended != i;
    for (std::size_t a = 0; finest && a < r.plan.axes.size(); ++a) finest = r.points[i].at[a] == r.plan.axes[a].finest;
    if (!finest) continue;
    std::string s;
    for (const AxisEffect& e : free_coarsenings(r, i))
      s += (s.empty() ? "" : "; ") + value_text(r, e.axis, e.to) + " instead of " +
           r.plan.axes[e.axis].values[r.points[i].at[e.axis]].label + printed(" saves %.0f %% of its time", 100 * (1 - e.time_factor));
    if (!s.empty()) said.push_back("The finest setting spends time without a detectable gain: " + s + ".");
  }
}

/// The errors of the models themselves, each with the best values of the other axes.
void say_models(const TradeReport& r, std::vector<std::string>& said) {
  const double warning = r.warning();
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a) {
    const FidelityAxis& axis = r.plan.axes[a];
    std::string s;
    int known = 0;
    for (std::size_t v = 0; v < axis.values.size() && !axis.numerical; ++v) {
      double least = INFINITY;
      for (const TradePoint& p : r.points)
        if (!p.at.empty() && p.at[a] == v && p.usable && !p.model.empty() &&
            std::ranges::none_of(p.model, [](double m) { return std::isnan(m); }))
          least = std::min(least, *std::ranges::max_element(p.model));
      if (!std::isfinite(least)) continue;
      s += (s.empty() ? "" : ", ") + axis.values[v].label + " " +
           (least <= warning ? "no detectable error (below " + percent_text(warning) + ")" : percent_text(least));
      ++known;
    }
    if (known > 1) said.push_back("Errors of the models of " + axis.name + " alone, computed exactly: " + s + ".");
  }
}

/// Whether enough settings with this value were run to conclude that none is worth its time: three quarters, and at least two.
bool tried(const TradeReport& r, std::size_t axis, std::size_t value) {
  std::size_t all = 0, ran = 0, judged = 0;
  for (const TradePoint& p : r.points)
    if (!p.at.empty() && p.at[axis] == value)
      ++all, ran += p.usable, judged += p.status != "not run" && p.status != "over its limit" && p.status != "interrupted";
  return ran >= std::min<std::size_t>(2, all) && 4 * judged >= 3 * all;
}

void say_front(const TradeReport& r, std::vector<std::string>& said) {
  if (r.front.size() == 1)
    said.push_back(printed("Of the %s that ran, none is more accurate than ", settings_text(r.ran()).c_str()) +
                   setting_text(r.plan, r.points[r.front.front()]) + " within the uncertainty, and none is faster.");
  else
    said.push_back(printed("The front is %zu of the %s that ran: ", r.front.size(), settings_text(r.ran()).c_str()) + "from " +
                   setting_text(r.plan, r.points[r.front.front()]) + " (" + cost_text(r, r.front.front()) + ") to " +
                   setting_text(r.plan, r.points[r.front.back()]) + " (" + cost_text(r, r.front.back()) + ").");
  std::string s;
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a)
    for (std::size_t v = 0; v < r.plan.axes[a].values.size(); ++v) {
      const auto has = [&](const TradePoint& p) { return !p.at.empty() && p.at[a] == v; };
      if (tried(r, a, v) && std::ranges::none_of(r.points, [&](const TradePoint& p) {
            return has(p) && (p.front || (r.recommended && &p == &r.points[*r.recommended]));
          }))
        s += (s.empty() ? "" : ", ") + value_text(r, a, v);
    }
  if (!s.empty()) said.push_back("Not worth their time here, because another setting is always better: " + s + ".");
}

void say_unusable(const TradeReport& r, std::vector<std::string>& said) {
  std::map<std::string, std::pair<std::size_t, std::string>> groups;
  for (const TradePoint& p : r.points)
    if (!p.usable) {
      auto& [count, example] = groups[p.status == "finished" ? "without a value" : p.status];
      if (count++ == 0) example = setting_text(r.plan, p) + (p.reason.empty() ? "" : ": " + p.reason);
    }
  const std::map<std::string, std::string> as_verb{{"not run", "did not run"},
                                                   {"dropped", "not run, because dominated"},
                                                   {"refused", "refused"},
                                                   {"not assembled", "not assembled"},
                                                   {"ledger over its bound", "with the ledger over its bound"},
                                                   {"over its limit", "given up, because they took too long"},
                                                   {"without a value", "without a value"}};
  for (const auto& [status, g] : groups) {
    const auto verb = as_verb.find(status);
    said.push_back(stopped(settings_text(g.first) + " " + (verb == as_verb.end() ? status : verb->second) +
                           (g.first == 1 ? ": " : "; the first: ") + g.second));
  }
}

}  // namespace

std::string cost_text(const TradeReport& r, std::size_t point) {
  const TradePoint& p = r.points[point];
  return time_text(p.time) + " with an error " + (p.counted() > p.warning ? "of " : "") + error_text(p);
}

std::string settings_text(std::size_t n) { return counted(n, "setting"); }

std::string of_how_many(const TradeReport& r) {
  return r.ran() == r.listed() ? "" : printed(" of the %zu of %zu settings that ran", r.ran(), r.listed());
}

std::string percent_text(double share) { return printed(share < 0.995 ? "%.2g %%" : "%.0f %%", 100 * share); }

std::string duration_text(double s) {
  if (s >= 3600) return printed("%.3gh", s / 3600);
  return s >= 60 ? printed("%.3gmin", s / 60) : printed("%.3gs", s);
}

std::string time_text(double s) {
  if (s >= 100) return printed("%.0f s", s);
  if (s >= 1) return printed("%.3g s", s);
  if (s >= 1e-3) return printed("%.3g ms", 1e3 * s);
  return printed("%.3g us", 1e6 * s);
}

std::string error_text(const TradePoint& p) {
  if (std::isnan(p.error)) return "unknown";
  return p.counted() > p.warning ? percent_text(p.counted()) : "below " + percent_text(p.warning);
}

std::string setting_text(const TradePlan& plan, const TradePoint& p) {
  if (p.at.empty()) return "the scene as it stands";
  std::string s;
  for (std::size_t a = 0; a < p.at.size(); ++a) s += (s.empty() ? "" : ", ") + plan.axes[a].name + " " + plan.axes[a].values[p.at[a]].label;
  return s;
}

std::vector<std::string> answers_in_words(const TradeReport& r) {
  std::vector<std::string> said;
  say_stopped(r, said);
  if (!r.reference.trouble.empty()) {
    if (r.stopped) return said;
    const std::string more =
        r.reference.short_of_time && r.plan.budget > 0 ? ". More time would help: --budget " + duration_text(4 * r.plan.budget) : "";
    said.assign({stopped("There is no reference to compare the settings with: " + stopped(r.reference.trouble) + more)});
    return said;
  }
  if (r.front.empty() || r.points.empty()) {
    said.push_back("No setting ran to its end with a value of every quantity.");
    if (!r.points.empty()) say_unusable(r, said);
    return said;
  }
  say_constant(r, said);
  if (!r.tells()) return said;
  if (r.recommended || (known(r) && r.plan.error <= 0))
    say_wanted(r, said);
  else if (known(r))
    say_none_meets(r, said);
  else
    say_unknown(r, said);
  say_as_it_stands(r, said);
  if (r.recommended) say_bottleneck(r, said), say_coarser(r, said);
  if (known(r)) say_models(r, said), say_luck(r, said), say_free(r, said), say_front(r, said);
  say_unusable(r, said);
  say_axes(r, said);
  for (std::size_t q = 0; q < r.quantities.size(); ++q)
    if (!r.reference.of[q].constant) said.push_back("Reference of " + r.quantities[q] + ": " + stopped(r.reference.of[q].words));
  return said;
}

}  // namespace pintle
