#include <algorithm>
#include <cmath>

#include "framework/study/tradeoff/tradeoff.h"
#include "framework/study/tradeoff/tradeoff_words.h"

namespace pintle {

namespace {

// Thresholds: an error counts as smaller by a fifth, a time by a twentieth; errors within a tenth count as equal.
constexpr double less_error = 0.8, same_error = 1.1, less_time = 0.95;

/// The point on the front farthest from the straight line between its ends, in decades: where additional time begins to gain little.
std::size_t knee(const std::vector<TradePoint>& points, const std::vector<std::size_t>& front) {
  if (front.size() < 3) return front.back();
  const auto x = [&](std::size_t i) { return std::log10(std::max(points[i].time, 1e-12)); };
  const auto y = [&](std::size_t i) { return std::log10(std::max(points[i].claimed(), 1e-16)); };
  const double dx = x(front.back()) - x(front.front()), dy = y(front.back()) - y(front.front());
  std::size_t best = front.back();
  double far = 0;
  for (const std::size_t i : front)
    if (const double off = dy * (x(i) - x(front.front())) - dx * (y(i) - y(front.front())); off > far) far = off, best = i;
  return best;
}

/// Whether the error is lower by more than its uncertainty.
bool lowers(const TradeReport& r, std::size_t point, const AxisEffect& e) {
  const TradePoint &p = r.points[point], &to = r.points[e.point];
  if (r.plan.axes[e.axis].ordered && e.to < p.at[e.axis]) return false;
  return e.error_factor <= less_error && to.claimed() + 0.5 * p.warning <= p.claimed();
}

}  // namespace

double TradePoint::at_most() const {
  double bound = errors.empty() ? counted() + warning : surer > 0 ? surer + warning : 0;
  for (std::size_t q = 0; q < errors.size(); ++q)
    if (!std::isnan(errors[q])) bound = std::max(bound, errors[q] + warnings_of[q]);
  return bound;
}

double TradePoint::at_least() const {
  double bound = (errors.empty() ? counted() : surer) - warning;
  for (std::size_t q = 0; q < errors.size(); ++q)
    if (!std::isnan(errors[q])) bound = std::max(bound, errors[q] - warnings_of[q]);
  return std::max(bound, 0.0);
}

Verdict verdict(const TradePoint& p, double wanted) {
  if (p.at_most() <= wanted) return Verdict::meets;
  return p.at_least() > wanted ? Verdict::misses : Verdict::unknown;
}

std::size_t TradeReport::ran() const { return static_cast<std::size_t>(std::ranges::count_if(points, &TradePoint::usable)); }

std::size_t TradeReport::listed() const { return points.size(); }

double TradeReport::warning() const {
  double worst = 0;
  for (const QuantityReference& q : reference.of)
    if (!q.constant) worst = std::max(worst, q.warning());
  return worst;
}

bool TradeReport::tells() const { return reference.of.empty() || !std::ranges::all_of(reference.of, &QuantityReference::constant); }

std::vector<AxisEffect> neighbours(const TradeReport& r, std::size_t point) {
  const TradePoint& p = r.points[point];
  std::vector<AxisEffect> out;
  if (p.at.empty()) return out;
  for (std::size_t k = 0; k < r.points.size(); ++k) {
    const TradePoint& other = r.points[k];
    if (!other.usable || other.at.size() != p.at.size()) continue;
    std::size_t differ = 0, axis = 0;
    for (std::size_t a = 0; a < p.at.size(); ++a)
      if (p.at[a] != other.at[a]) ++differ, axis = a;
    if (differ == 1) out.push_back({axis, other.at[axis], k, other.claimed() / p.claimed(), other.time / p.time});
  }
  return out;
}

void discount_luck(TradeReport& r) {
  for (TradePoint& p : r.points) {
    p.surer = 0;
    for (const TradePoint& finer : r.points) {
      if (!p.usable || p.at.empty() || !finer.usable || finer.at.size() != p.at.size()) continue;
      std::size_t refined = 0, other = 0;
      for (std::size_t a = 0; a < p.at.size(); ++a) {
        const FidelityAxis& axis = r.plan.axes[a];
        if (finer.at[a] != p.at[a]) ++(axis.numerical && axis.ordered && finer.at[a] > p.at[a] ? refined : other);
      }
      if (refined > 0 && other == 0 && finer.error > p.error + std::max(p.warning, finer.warning)) p.surer = std::max(p.surer, finer.error);
    }
  }
}

std::vector<std::size_t> pareto_front(std::vector<TradePoint>& points) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].front = points[i].dominated = false;
    if (points[i].usable) order.push_back(i);
  }
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    if (points[a].time != points[b].time) return points[a].time < points[b].time;
    if (points[a].claimed() != points[b].claimed()) return points[a].claimed() < points[b].claimed();
    return a < b;
  });
  std::vector<std::size_t> front;
  double least = INFINITY;
  for (const std::size_t i : order) {
    // An improvement within the uncertainty does not count.
    if (points[i].claimed() < least && (front.empty() || points[i].claimed() + 0.5 * points[i].warning < least)) {
      least = points[i].claimed();
      points[i].front = true;
      front.push_back(i);
    } else {
      points[i].dominated = true;
    }
  }
  return front;
}

std::optional<AxisEffect> bottleneck(const TradeReport& r, std::size_t point) {
  std::optional<AxisEffect> best;
  double most = 0;
  for (const AxisEffect& e : neighbours(r, point)) {
    if (!lowers(r, point, e)) continue;
    const double gain = -std::log(e.error_factor) / std::max(std::log(e.time_factor), std::log(1 / less_time));
    if (gain > most) most = gain, best = e;
  }
  return best;
}

std::optional<AxisEffect> first_step(const TradeReport& r, std::size_t point) {
  const std::optional<AxisEffect> most = bottleneck(r, point);
  if (!most || !r.plan.axes[most->axis].ordered) return most;
  std::optional<AxisEffect> first;
  for (const AxisEffect& e : neighbours(r, point))
    if (e.axis == most->axis && lowers(r, point, e) && (!first || e.to < first->to)) first = e;
  return first;
}

std::vector<AxisEffect> free_coarsenings(const TradeReport& r, std::size_t point) {
  std::vector<AxisEffect> out;
  for (const AxisEffect& e : neighbours(r, point)) {
    const FidelityAxis& axis = r.plan.axes[e.axis];
    if (axis.ordered && e.to > r.points[point].at[e.axis]) continue;
    if (e.error_factor > same_error || e.time_factor > less_time) continue;
    const auto same = std::ranges::find(out, e.axis, &AxisEffect::axis);
    if (same == out.end())
      out.push_back(e);
    else if (e.time_factor < same->time_factor)
      *same = e;
  }
  return out;
}

namespace {

/// Errors below their uncertainty count as equal: a smaller uncertainty makes none of these settings better.
void level_warnings(std::vector<TradePoint>& points) {
  std::vector<double> warnings_of;
  for (const TradePoint& p : points)
    if (p.usable) warnings_of.push_back(p.warning);
  if (warnings_of.empty()) return;
  std::ranges::nth_element(warnings_of, warnings_of.begin() + static_cast<std::ptrdiff_t>(warnings_of.size() / 2));
  for (TradePoint& p : points)
    if (p.usable) p.warning = std::max(p.warning, warnings_of[warnings_of.size() / 2]);
}

/// Chooses only what the reference supports.
void choose(TradeReport& r) {
  const TradePlan& plan = r.plan;
  for (std::size_t i = 0; i < r.points.size(); ++i)
    if (r.points[i].usable && plan.error > 0 && verdict(r.points[i], plan.error) == Verdict::meets &&
        (!r.cheapest || r.points[i].time < r.points[*r.cheapest].time))
      r.cheapest = i;
  const bool known = r.warning() <= useful_warning;
  for (const std::size_t i : r.front)
    if (plan.time > 0 && r.points[i].time <= plan.time && known) r.best_in_time = i;
  if (plan.error > 0)
    r.recommended = r.cheapest;
  else if (plan.time > 0)
    r.recommended = r.best_in_time;
  else if (!r.front.empty() && known)
    r.recommended = knee(r.points, r.front);
}

}  // namespace

void answer(TradeReport& r) {
  level_warnings(r.points);
  discount_luck(r);
  // The unchanged scene may also be one of the combinations, which then represents both.
  const bool twice =
      !r.points.empty() && r.points.front().usable && std::ranges::any_of(r.points.begin() + 1, r.points.end(), [&](const TradePoint& p) {
        return p.usable && p.steps > 0 && p.steps == r.points.front().steps && p.evaluations == r.points.front().evaluations &&
               p.values == r.points.front().values;
      });
  if (twice) r.points.front().usable = false;
  r.front = pareto_front(r.points);
  r.cheapest = r.best_in_time = r.recommended = {};
  if (r.reference.trouble.empty() && r.tells()) choose(r);
  if (twice) r.points.front().usable = r.points.front().dominated = true;
  r.said = answers_in_words(r);
}

}  // namespace pintle
