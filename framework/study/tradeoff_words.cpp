#include "framework/study/tradeoff_words.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/study/printed.h"

namespace pintle {

namespace {

std::string value_text(const TradeReport& r, std::size_t axis, std::size_t value) {
  return r.plan.axes[axis].name + " " + r.plan.axes[axis].values[value].label;
}

std::string priced(const TradeReport& r, std::size_t point) {
  const TradePoint& p = r.points[point];
  return time_text(p.time) + " with an error " + (p.error > p.doubt ? "of " : "") + error_text(p);
}

std::string times_text(double factor) {
  if (std::abs(factor - 1) < 0.05) return "about the same time";
  return factor > 1 ? printed("%.2g times the time", factor) : printed("%.2g of the time", factor);
}

void say_as_it_stands(const TradeReport& r, std::vector<std::string>& said) {
  const TradePoint& p = r.points.front();
  if (!p.usable) {
    said.push_back("The scene as it stands cannot be judged: " + p.status + (p.reason.empty() ? "" : ", " + p.reason) + ".");
    return;
  }
  std::string s = "The scene as it stands takes " + priced(r, 0);
  if (r.recommended && *r.recommended != 0) {
    const double factor = r.points[*r.recommended].time / p.time;
    s += "; what is recommended takes " + times_text(factor);
  }
  said.push_back(s + ".");
}

void say_wanted(const TradeReport& r, std::vector<std::string>& said) {
  const TradePlan& plan = r.plan;
  if (plan.error > 0 && r.cheapest)
    said.push_back("Cheapest for an error of " + percent_text(plan.error) + ": " + setting_text(plan, r.points[*r.cheapest]) + ", " + priced(r, *r.cheapest) + ".");
  else if (plan.error > 0)
    said.push_back("No setting is known to have an error of at most " + percent_text(plan.error) + "; the most accurate is " +
                   setting_text(plan, r.points[r.front.back()]) + ", " + priced(r, r.front.back()) + ".");
  if (plan.time > 0 && r.best_in_time)
    said.push_back("Most accurate within " + time_text(plan.time) + ": " + setting_text(plan, r.points[*r.best_in_time]) + ", " + priced(r, *r.best_in_time) + ".");
  else if (plan.time > 0)
    said.push_back("No setting takes as little as " + time_text(plan.time) + "; the fastest is " + setting_text(plan, r.points[r.front.front()]) + ", " +
                   priced(r, r.front.front()) + ".");
  if (plan.error <= 0 && plan.time <= 0)
    said.push_back("With no wish given, the front's knee is recommended, past which more time buys little: " + setting_text(plan, r.points[*r.recommended]) + ", " +
                   priced(r, *r.recommended) + ".");
}

void say_front(const TradeReport& r, std::vector<std::string>& said) {
  std::size_t usable = 0;
  for (const TradePoint& p : r.points) usable += p.usable;
  if (r.front.size() == 1) {
    said.push_back(printed("Of %zu settings that ran, none is more accurate than ", usable) + setting_text(r.plan, r.points[r.front.front()]) + " beyond what can be told, and none is faster.");
    return;
  }
  said.push_back(printed("%zu of %zu settings that ran form the front: ", r.front.size(), usable) + "from " + setting_text(r.plan, r.points[r.front.front()]) + " (" +
                 priced(r, r.front.front()) + ") to " + setting_text(r.plan, r.points[r.front.back()]) + " (" + priced(r, r.front.back()) + ").");
}

/// Numerical and model error of the recommended point, of its worst quantity.
void say_split(const TradeReport& r, std::vector<std::string>& said) {
  const TradePoint& p = r.points[*r.recommended];
  if (p.errors.empty()) return;
  const auto worst = static_cast<std::size_t>(std::ranges::max_element(p.errors) - p.errors.begin());
  if (std::isnan(p.model[worst]) || p.error <= p.doubt) return;
  const std::string own = p.model[worst] < 1e-3 * p.errors[worst] ? "nothing that shows" : percent_text(p.model[worst]);
  said.push_back("Of the error of what is recommended in " + r.quantities[worst] + ", " + percent_text(p.errors[worst]) + ", the model's own is " + own + (p.model[worst] > 0.5 * p.errors[worst] ? ": a tighter tolerance or another scheme would hardly lower it."
                                                                                       : ": the rest is of computing, and a tighter tolerance lowers it."));
}

/// What the models err by themselves, each at the best of the other axes.
void say_models(const TradeReport& r, std::vector<std::string>& said) {
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a) {
    const FidelityAxis& axis = r.plan.axes[a];
    std::string s;
    int known = 0;
    for (std::size_t v = 0; v < axis.values.size() && !axis.numerical; ++v) {
      double least = INFINITY;
      for (const TradePoint& p : r.points)
        if (!p.at.empty() && p.at[a] == v && p.usable && std::ranges::none_of(p.model, [](double m) { return std::isnan(m); }))
          least = std::min(least, *std::ranges::max_element(p.model));
      if (!std::isfinite(least)) continue;
      double doubt = 0;
      for (const QuantityReference& q : r.reference.of) doubt = std::max(doubt, q.error / q.scale);
      s += (s.empty() ? "" : ", ") + axis.values[v].label + " " + (least <= doubt ? "nothing that can be told" : percent_text(least));
      ++known;
    }
    if (known > 1) said.push_back("By themselves, computed as the reference is, the settings of " + axis.name + " err by: " + s + ".");
  }
}

void say_bottleneck(const TradeReport& r, std::vector<std::string>& said) {
  const std::size_t at = *r.recommended;
  if (const auto b = bottleneck(r, at)) {
    const TradePoint& p = r.points[at];
    const TradePoint& to = r.points[b->point];
    said.push_back("Bottleneck of what is recommended: " + r.plan.axes[b->axis].name + ". From " + (p.at.empty() ? "as it stands" : r.plan.axes[b->axis].values[p.at[b->axis]].label) + " to " +
                   r.plan.axes[b->axis].values[b->to].label + " alone, the error goes from " + error_text(p) + " to " + error_text(to) + " for " + times_text(b->time_factor) + ".");
  } else if (r.points[at].error <= r.points[at].doubt) {
    said.push_back("What is recommended is as accurate as the reference can tell, " + percent_text(r.points[at].doubt) + ": no axis is a bottleneck.");
  } else if (!r.points[at].at.empty()) {
    said.push_back("No axis alone lowers the error of what is recommended by more than a fifth, in the settings that ran.");
  }
  std::map<std::string, int> along;
  int judged = 0;
  for (const std::size_t i : r.front)
    if (const auto b = bottleneck(r, i)) ++along[r.plan.axes[b->axis].name], ++judged;
  if (judged < 2) return;
  std::string s;
  for (const auto& [axis, count] : along) s += (s.empty() ? "" : ", ") + axis + printed(" at %d", count);
  said.push_back(printed("Along the front, of %d settings that one axis alone can better, the bottleneck is ", judged) + s + ".");
}

void say_free(const TradeReport& r, std::vector<std::string>& said) {
  const auto say = [&](std::size_t point, const std::string& what) {
    std::string s;
    for (const AxisEffect& e : free_coarsenings(r, point))
      s += (s.empty() ? "" : "; ") + r.plan.axes[e.axis].name + " from " + r.plan.axes[e.axis].values[r.points[point].at[e.axis]].label + " to " +
           r.plan.axes[e.axis].values[e.to].label + printed(" saves %.0f %% of the time", 100 * (1 - e.time_factor));
    if (!s.empty()) said.push_back("Of " + what + ", this could be given up at no loss of accuracy: " + s + ".");
  };
  std::vector<std::size_t> finest;
  for (std::size_t i = 0; i < r.points.size(); ++i) {
    bool all = r.points[i].usable && !r.points[i].at.empty();
    for (std::size_t a = 0; all && a < r.plan.axes.size(); ++a) all = r.points[i].at[a] == r.plan.axes[a].finest;
    if (all) say(i, "the finest setting");
  }
}

/// Values of axes that no point of the front has though they ran.
void say_never(const TradeReport& r, std::vector<std::string>& said) {
  std::string s;
  for (std::size_t a = 0; a < r.plan.axes.size(); ++a)
    for (std::size_t v = 0; v < r.plan.axes[a].values.size(); ++v) {
      bool ran = false, front = false;
      for (const TradePoint& p : r.points)
        if (!p.at.empty() && p.at[a] == v) ran = ran || p.usable, front = front || p.front;
      if (ran && !front) s += (s.empty() ? "" : ", ") + value_text(r, a, v);
    }
  if (!s.empty()) said.push_back("On no point of the front, so not worth its time here: " + s + ".");
}

void say_unusable(const TradeReport& r, std::vector<std::string>& said) {
  std::map<std::string, std::pair<int, std::string>> groups;
  for (const TradePoint& p : r.points)
    if (!p.usable) {
      auto& [count, example] = groups[p.status == "finished" ? "without a value" : p.status];
      if (count++ == 0) example = setting_text(r.plan, p) + (p.reason.empty() ? "" : ": " + p.reason);
    }
  for (const auto& [status, g] : groups)
    said.push_back(printed("%d setting%s %s; the first: ", g.first, g.first == 1 ? "" : "s", ("\"" + status + "\"").c_str()) + g.second + ".");
}

}  // namespace

std::string percent_text(double share) { return printed(share < 0.995 ? "%.2g %%" : "%.0f %%", 100 * share); }

std::string time_text(double s) {
  if (s >= 100) return printed("%.0f s", s);
  if (s >= 1) return printed("%.3g s", s);
  if (s >= 1e-3) return printed("%.3g ms", 1e3 * s);
  return printed("%.3g us", 1e6 * s);
}

std::string error_text(const TradePoint& p) {
  if (std::isnan(p.error)) return "unknown";
  return p.error > p.doubt ? percent_text(p.error) : "below " + percent_text(p.doubt);
}

std::string setting_text(const TradePlan& plan, const TradePoint& p) {
  if (p.at.empty()) return "the scene as it stands";
  std::string s;
  for (std::size_t a = 0; a < p.at.size(); ++a) s += (s.empty() ? "" : ", ") + plan.axes[a].name + " " + plan.axes[a].values[p.at[a]].label;
  return s;
}

std::vector<std::string> answers_in_words(const TradeReport& r) {
  std::vector<std::string> said;
  if (!r.reference.trouble.empty()) {
    said.push_back("There is no reference to judge by: " + r.reference.trouble + ".");
    return said;
  }
  if (r.front.empty() || r.points.empty()) {
    said.push_back("No setting ran to its end with a value of every quantity.");
    if (!r.points.empty()) say_unusable(r, said);
    return said;
  }
  say_wanted(r, said);
  say_as_it_stands(r, said);
  say_bottleneck(r, said);
  say_split(r, said);
  say_models(r, said);
  say_free(r, said);
  say_front(r, said);
  say_never(r, said);
  say_unusable(r, said);
  for (std::size_t q = 0; q < r.quantities.size(); ++q) said.push_back("Reference of " + r.quantities[q] + ": " + r.reference.of[q].words + ".");
  if (r.stopped) said.push_back("Stopped before its end by the user: settings not run may be better.");
  return said;
}

}  // namespace pintle
