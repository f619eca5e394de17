#include "framework/plots/tradeoff_plot.h"

#include <algorithm>
#include <cmath>

#include "framework/plots/plot.h"

namespace pintle {

namespace {

/// Decimal logarithm of a share, limited to a range that a picture can show.
double decades(double x) { return std::log10(std::max(x, 1e-16)); }

}  // namespace

std::string tradeoff_svg(const TradeReport& r) {
  Curve all{.label = "settings", .x = {}, .y = {}, .points = true}, front{.label = "front", .x = {}, .y = {}},
      warning{.label = "error resolution", .x = {}, .y = {}, .dashed = true};
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY, level = 0;
  for (const TradePoint& p : r.points) {
    if (!p.usable) continue;
    all.x.push_back(decades(p.time)), all.y.push_back(decades(p.claimed()));
    x0 = std::min(x0, all.x.back()), x1 = std::max(x1, all.x.back());
    y0 = std::min(y0, all.y.back()), y1 = std::max(y1, all.y.back());
  }
  if (all.x.empty()) x0 = y0 = -1, x1 = y1 = 0;
  for (const std::size_t i : r.front) front.x.push_back(decades(r.points[i].time)), front.y.push_back(decades(r.points[i].claimed()));
  for (const QuantityReference& q : r.reference.of) level = std::max(level, q.error / q.scale);
  if (level > 0) y0 = std::min(y0, decades(level));
  const double dx = std::max(0.06 * (x1 - x0), 0.05), dy = std::max(0.06 * (y1 - y0), 0.1);
  if (level > 0) warning.x = {x0 - dx, x1 + dx}, warning.y = {decades(level), decades(level)};
  Panel panel{.title = r.plan.title,
              .x_label = "time of building and running [s]",
              .y_label = "relative error",
              .curves = {all, front, warning},
              .x_range = {x0 - dx, x1 + dx},
              .y_range = {y0 - dy, y1 + dy},
              .log = true};
  if (r.recommended)
    panel.marks.push_back({decades(r.points[*r.recommended].time), decades(r.points[*r.recommended].claimed()), "recommended"});
  if (!r.points.empty() && r.points.front().usable && r.recommended != std::size_t{0})
    panel.marks.push_back({decades(r.points.front().time), decades(r.points.front().claimed()), "as it stands"});
  return svg({panel}, 1);
}

}  // namespace pintle
