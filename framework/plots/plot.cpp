#include "framework/plots/plot.h"

#include <algorithm>
#include <cmath>

#include "framework/common/printed.h"

namespace pintle {

namespace {

constexpr double panel_width = 520, panel_height = 390, left = 78, right = 16, top = 62, bottom = 50;
constexpr double width = panel_width - left - right, height = panel_height - top - bottom;  // of the axes
const std::array<const char*, 6> colours{"#1b6ca8", "#d1495b", "#2e933c", "#edae49", "#6a4c93", "#444444"};

std::string escaped(const std::string& s) {
  std::string out;
  for (const char c : s) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

std::string text(double x, double y, const std::string& words, const char* anchor = "middle", const char* more = "") {
  return printed("<text x='%.1f' y='%.1f' text-anchor='%s'%s>%s</text>\n", x, y, anchor, more, escaped(words).c_str());
}

double tick_step(double span) {
  const double rough = span / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0})
    if (m * power >= rough * 0.999) return m * power;
  return 10 * power;
}

// Douglas and Peucker: keeps points more than a quarter of a pixel from a straight line.
void thin(const std::vector<double>& x, const std::vector<double>& y, std::size_t a, std::size_t b, std::vector<bool>& keep) {
  double far = 0.25;
  std::size_t at = 0;
  const double dx = x[b] - x[a], dy = y[b] - y[a], d = std::hypot(dx, dy);
  for (std::size_t i = a + 1; i < b; ++i) {
    const double off = d > 1e-9 ? std::abs(dy * (x[i] - x[a]) - dx * (y[i] - y[a])) / d : std::hypot(x[i] - x[a], y[i] - y[a]);
    if (off > far) far = off, at = i;
  }
  if (at == 0) return;
  keep[at] = true;
  thin(x, y, a, at, keep);
  thin(x, y, at, b, keep);
}

/// A panel's axes: their ranges, and the position of the panel in the picture.
struct Axes {
  double x0, x1, y0, y1;
  double x_at, y_at;
  double px(double x) const { return x_at + left + (x - x0) / (x1 - x0) * width; }
  double py(double y) const { return y_at + top + (y1 - y) / (y1 - y0) * height; }
};

// Ranges given by the panel, otherwise those of its curves.
Axes axes_of(const Panel& p, double x_at, double y_at) {
  double x0 = p.x_range[0], x1 = p.x_range[1], y0 = p.y_range[0], y1 = p.y_range[1];
  const bool fit_x = x0 == x1, fit_y = y0 == y1;
  if (fit_x) x0 = INFINITY, x1 = -INFINITY;
  if (fit_y) y0 = INFINITY, y1 = -INFINITY;
  for (const Curve& c : p.curves)
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (fit_x) x0 = std::min(x0, c.x[i]), x1 = std::max(x1, c.x[i]);
      if (fit_y && (fit_x || (c.x[i] >= x0 && c.x[i] <= x1))) y0 = std::min(y0, c.y[i]), y1 = std::max(y1, c.y[i]);
    }
  if (!(x0 <= x1)) x0 = 0, x1 = 1;  // there are no points
  if (!(y0 <= y1)) y0 = 0, y1 = 1;
  const auto give_room = [](double& a, double& b, double share) {
    const double room = b > a ? share * (b - a) : 1e-3 * std::max(1.0, std::abs(a));
    a -= room, b += room;
  };
  if (fit_y) give_room(y0, y1, 0.05);
  const bool dotted = std::ranges::any_of(p.curves, [](const Curve& c) { return c.points; });
  if (fit_x && (dotted || x0 == x1)) give_room(x0, x1, 0.02);  // so that dots at the ends are not cut off
  if (p.equal) {
    const double scale = std::max((x1 - x0) / width, (y1 - y0) / height) * 1.05;
    const double xm = (x0 + x1) / 2, ym = (y0 + y1) / 2;
    x0 = xm - scale * width / 2, x1 = xm + scale * width / 2;
    y0 = ym - scale * height / 2, y1 = ym + scale * height / 2;
  }
  return {x0, x1, y0, y1, x_at, y_at};
}

std::string tick(const Axes& axes, double at, bool horizontal, const std::string& number) {
  const double x = axes.px(horizontal ? at : axes.x0), y = axes.py(horizontal ? axes.y0 : at);
  if (horizontal) return printed("<path d='M%.1f %.1fv%.1f' stroke='#ddd'/>\n", x, y, -height) + text(x, y + 16, number);
  return printed("<path d='M%.1f %.1fh%.1f' stroke='#ddd'/>\n", x, y, width) + text(x - 6, y + 4, number, "end");
}

std::string ticks(const Axes& axes, bool horizontal, bool log) {
  const double a = horizontal ? axes.x0 : axes.y0, b = horizontal ? axes.x1 : axes.y1;
  std::string s;
  if (log && b - a < 2.2) {  // too few complete decades to read numbers between them
    for (int decade = static_cast<int>(std::floor(a)); decade <= b; ++decade)
      for (const double m : {1.0, 2.0, 5.0})
        if (const double at = decade + std::log10(m); at >= a - 1e-9 && at <= b + 1e-9)
          s += tick(axes, at, horizontal, printed("%.0fe%d", m, decade));
    return s;
  }
  const double step = log ? std::max(1.0, std::round(tick_step(b - a))) : tick_step(b - a);
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  for (double k = std::ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; ++k)
    s += tick(axes, k * step, horizontal, log ? printed("1e%.0f", k * step) : printed("%.*f", digits, k * step + 0.0));
  return s;
}

std::string labels(const Panel& p, const Axes& axes) {
  const double middle = axes.x_at + left + width / 2;
  const std::string turned = printed(" transform='translate(%.1f %.1f) rotate(-90)'", axes.x_at + 16, axes.y_at + top + height / 2);
  return text(middle, axes.y_at + panel_height - 14, p.x_label) + text(0, 0, p.y_label, "middle", turned.c_str());
}

const char* colour_of(std::size_t curve) { return colours[curve % colours.size()]; }

std::string stroke_of(const Panel& p, std::size_t curve) {
  return printed("stroke='%s'%s", colour_of(curve), p.curves[curve].dashed ? " stroke-dasharray='6 4'" : "");
}

const char* paint_of(const Curve& points) { return points.hollow ? "fill='none' stroke-width='1' stroke" : "fill"; }

std::string polyline(const std::vector<double>& x, const std::vector<double>& y, const std::string& stroke) {
  std::vector<bool> keep(x.size(), false);
  keep.front() = keep.back() = true;
  thin(x, y, 0, x.size() - 1, keep);
  std::string s = "<path " + stroke + " d='";
  bool first = true;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (keep[i]) s += printed("%c%.1f %.1f", first ? 'M' : 'L', x[i], y[i]), first = false;
  return s + "'/>\n";
}

std::string curve_of(const Panel& p, const Axes& axes, std::size_t k) {
  const Curve& c = p.curves[k];
  std::vector<double> x, y;
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    const bool near = p.equal || p.log || (c.x[std::min(i + 1, c.x.size() - 1)] >= axes.x0 && c.x[i > 0 ? i - 1 : 0] <= axes.x1);
    if (near) x.push_back(axes.px(c.x[i])), y.push_back(std::clamp(axes.py(c.y[i]), -2000.0, 6000.0));
  }
  std::string s;
  if (!x.empty() && !c.points) s += polyline(x, y, stroke_of(p, k));
  const double radius = x.size() > 400 ? 1 : 2.5;  // smaller if there are many, so that they do not merge
  for (std::size_t i = 0; (p.log || c.points) && i < x.size(); ++i)
    s += printed("<circle cx='%.1f' cy='%.1f' r='%g' %s='%s'/>\n", x[i], y[i], radius, paint_of(c), colour_of(k));
  return s;
}

std::string legend(const Panel& p, const Axes& axes) {
  std::string s;
  double x = axes.x_at + left;
  const double y = axes.y_at + top;
  for (std::size_t k = 0; k < p.curves.size(); ++k) {
    const Curve& c = p.curves[k];
    if (c.label.empty()) continue;
    s += c.points ? printed("<circle cx='%.1f' cy='%.1f' r='3' %s='%s'/>\n", x + 10, y - 18, paint_of(c), colour_of(k))
                  : printed("<path d='M%.1f %.1fh20' %s stroke-width='2'/>\n", x, y - 18, stroke_of(p, k).c_str());
    s += text(x + 25, y - 14, c.label, "start");
    x += 41 + 6.3 * static_cast<double>(c.label.size());
  }
  return s;
}

std::string ring(const Mark& m, const Axes& axes) {
  return printed("<circle cx='%.1f' cy='%.1f' r='7' stroke='#111' stroke-width='1.6'/>\n", axes.px(m.x), axes.py(m.y));
}

std::string words_beside(const Mark& m, const Axes& axes) {
  const bool right_half = axes.px(m.x) > axes.px(axes.x0) + 0.6 * width;
  return text(axes.px(m.x) + (right_half ? -11 : 11), axes.py(m.y) - 7, m.label, right_half ? "end" : "start");
}

std::string draw(const Panel& p, double x_at, double y_at, int id) {
  const Axes axes = axes_of(p, x_at, y_at);
  const std::string box = printed("<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f'", axes.px(axes.x0), axes.py(axes.y1), width, height);
  std::string s = text(x_at + left + width / 2, y_at + 18, p.title, "middle", " font-weight='bold'");
  s += ticks(axes, true, p.log) + ticks(axes, false, p.log) + labels(p, axes);
  s += printed("<clipPath id='c%d'>", id) + box + "/></clipPath>\n";
  s += printed("<g clip-path='url(#c%d)' fill='none' stroke-width='1.4' stroke-linejoin='round'>\n", id);
  for (std::size_t k = 0; k < p.curves.size(); ++k) s += curve_of(p, axes, k);
  for (const Mark& m : p.marks) s += ring(m, axes);
  s += "</g>\n" + legend(p, axes);
  for (const Mark& m : p.marks) s += words_beside(m, axes);
  return s + box + " fill='none' stroke='#333'/>\n";
}

}  // namespace

std::string svg(const std::vector<Panel>& panels, std::size_t columns) {
  columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const double w = panel_width * static_cast<double>(columns), h = panel_height * static_cast<double>(rows);
  std::string s = printed(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' width='%.0f' height='%.0f' "
      "font-family='sans-serif' font-size='12'>\n<rect width='100%%' height='100%%' "
      "fill='white'/>\n",
      w, h, w, h);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::size_t column = k % columns, row = k / columns;
    s += draw(panels[k], panel_width * static_cast<double>(column), panel_height * static_cast<double>(row), static_cast<int>(k));
  }
  return s + "</svg>\n";
}

}  // namespace pintle
