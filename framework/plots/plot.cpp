#include "framework/plots/plot.h"

#include <algorithm>
#include <cmath>

#include "framework/common/printed.h"
#include "framework/plots/pen.h"

namespace pintle {

namespace {

constexpr double panel_width = 520, panel_height = 390, left = 78, right = 16, top = 62, bottom = 50;
constexpr double width = panel_width - left - right, height = panel_height - top - bottom;  // of the axes
using Anchor = PlotPen::Anchor;
const std::array<const char*, 6> colours{"#1b6ca8", "#d1495b", "#2e933c", "#edae49", "#6a4c93", "#444444"};

std::string escaped(const std::string& s) {
  std::string out;
  for (const char c : s) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

class SvgPen : public PlotPen {
 public:
  void begin(double w, double h) override {
    s_ = printed(
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 %.0f %.0f' width='%.0f' height='%.0f' "
        "font-family='sans-serif' font-size='12'>\n<rect width='100%%' height='100%%' "
        "fill='white'/>\n",
        w, h, w, h);
  }
  void text(double x, double y, const std::string& words, Anchor anchor, Face face) override {
    const char* const anchored = anchor == Anchor::start ? "start" : anchor == Anchor::end ? "end" : "middle";
    std::string more = face == Face::bold ? " font-weight='bold'" : "";
    if (face == Face::upwards) more = printed(" transform='translate(%.1f %.1f) rotate(-90)'", x, y), x = y = 0;
    s_ += printed("<text x='%.1f' y='%.1f' text-anchor='%s'%s>%s</text>\n", x, y, anchored, more.c_str(), escaped(words).c_str());
  }
  void rule(double x, double y, double dx, double dy) override {
    s_ += printed("<path d='M%.1f %.1f%c%.1f' stroke='#ddd'/>\n", x, y, dx == 0 ? 'v' : 'h', dx == 0 ? dy : dx);
  }
  void curve(const Points& points, const char* colour, bool dashed) override {
    s_ += "<path " + stroke(colour, dashed) + " d='";
    for (std::size_t i = 0; i < points.size(); ++i) s_ += printed("%c%.1f %.1f", i == 0 ? 'M' : 'L', points[i][0], points[i][1]);
    s_ += "'/>\n";
  }
  void sample(double x, double y, const char* colour, bool dashed) override {
    s_ += printed("<path d='M%.1f %.1fh20' %s stroke-width='2'/>\n", x, y, stroke(colour, dashed).c_str());
  }
  void dot(double x, double y, const Dot& dot) override {
    const char* const paint = dot.hollow ? "fill='none' stroke-width='1' stroke" : "fill";
    s_ += printed("<circle cx='%.1f' cy='%.1f' r='%g' %s='%s'/>\n", x, y, dot.radius, paint, dot.colour);
  }
  void ring(double x, double y) override { s_ += printed("<circle cx='%.1f' cy='%.1f' r='7' stroke='#111' stroke-width='1.6'/>\n", x, y); }
  void frame(double x, double y, double w, double h) override { s_ += box(x, y, w, h) + " fill='none' stroke='#333'/>\n"; }
  void clip(double x, double y, double w, double h) override {
    s_ += printed("<clipPath id='c%d'>", clips_) + box(x, y, w, h) + "/></clipPath>\n";
    s_ += printed("<g clip-path='url(#c%d)' fill='none' stroke-width='1.4' stroke-linejoin='round'>\n", clips_++);
  }
  void unclip() override { s_ += "</g>\n"; }
  std::string file() override { return s_ + "</svg>\n"; }

 private:
  static std::string stroke(const char* colour, bool dashed) {
    return printed("stroke='%s'%s", colour, dashed ? " stroke-dasharray='6 4'" : "");
  }
  static std::string box(double x, double y, double w, double h) {
    return printed("<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f'", x, y, w, h);
  }

  std::string s_;
  int clips_ = 0;
};

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
      if (!std::isfinite(c.x[i])) continue;
      if (fit_x) x0 = std::min(x0, c.x[i]), x1 = std::max(x1, c.x[i]);
      if (!std::isfinite(c.y[i])) continue;
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

void tick(PlotPen& pen, const Axes& axes, double at, bool horizontal, const std::string& number) {
  const double x = axes.px(horizontal ? at : axes.x0), y = axes.py(horizontal ? axes.y0 : at);
  pen.rule(x, y, horizontal ? 0 : width, horizontal ? -height : 0);
  if (horizontal)
    pen.text(x, y + 16, number);
  else
    pen.text(x - 6, y + 4, number, Anchor::end);
}

void ticks(PlotPen& pen, const Axes& axes, bool horizontal, bool log) {
  const double a = horizontal ? axes.x0 : axes.y0, b = horizontal ? axes.x1 : axes.y1;
  if (log && b - a < 2.2) {  // too few complete decades to read numbers between them
    for (int decade = static_cast<int>(std::floor(a)); decade <= b; ++decade)
      for (const double m : {1.0, 2.0, 5.0})
        if (const double at = decade + std::log10(m); at >= a - 1e-9 && at <= b + 1e-9)
          tick(pen, axes, at, horizontal, printed("%.0fe%d", m, decade));
    return;
  }
  const double step = log ? std::max(1.0, std::round(tick_step(b - a))) : tick_step(b - a);
  const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
  for (double k = std::ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; ++k)
    tick(pen, axes, k * step, horizontal,
         log                                     ? printed("1e%.0f", k * step)
         : step < 1e-6 || std::max(-a, b) >= 1e6 ? printed("%.4g", k * step + 0.0)
                                                 : printed("%.*f", digits, k * step + 0.0));
}

void labels(PlotPen& pen, const Panel& p, const Axes& axes) {
  pen.text(axes.x_at + left + width / 2, axes.y_at + panel_height - 14, p.x_label);
  pen.text(axes.x_at + 16, axes.y_at + top + height / 2, p.y_label, Anchor::middle, PlotPen::Face::upwards);
}

const char* colour_of(std::size_t curve) { return colours[curve % colours.size()]; }

PlotPen::Points thinned(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<bool> keep(x.size(), false);
  keep.front() = keep.back() = true;
  thin(x, y, 0, x.size() - 1, keep);
  PlotPen::Points out;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (keep[i]) out.push_back({x[i], y[i]});
  return out;
}

/// A value that is not a finite number interrupts the curve; one between two such values is drawn as a dot.
void curve(PlotPen& pen, const Panel& p, const Axes& axes, std::size_t k) {
  const Curve& c = p.curves[k];
  std::vector<double> x, y;
  const double radius = c.radius > 0 ? c.radius : c.x.size() > 400 ? 1 : 2.5;  // smaller if there are many, so that they do not merge
  const auto draw_part = [&] {
    const bool dots = p.log || c.points || x.size() == 1;
    if (x.size() > 1 && !c.points) pen.curve(thinned(x, y), colour_of(k), c.dashed);
    for (std::size_t i = 0; dots && i < x.size(); ++i) pen.dot(x[i], y[i], {colour_of(k), radius, c.hollow});
    x.clear(), y.clear();
  };
  for (std::size_t i = 0; i < c.x.size(); ++i) {
    const bool near = p.equal || p.log || (c.x[std::min(i + 1, c.x.size() - 1)] >= axes.x0 && c.x[i > 0 ? i - 1 : 0] <= axes.x1);
    if (!std::isfinite(c.x[i]) || !std::isfinite(c.y[i]))
      draw_part();
    else if (near)
      x.push_back(axes.px(c.x[i])), y.push_back(std::clamp(axes.py(c.y[i]), -2000.0, 6000.0));
  }
  draw_part();
}

void legend(PlotPen& pen, const Panel& p, const Axes& axes) {
  double x = axes.x_at + left;
  const double y = axes.y_at + top;
  for (std::size_t k = 0; k < p.curves.size(); ++k) {
    const Curve& c = p.curves[k];
    if (c.label.empty()) continue;
    if (c.points)
      pen.dot(x + 10, y - 18, {colour_of(k), 3, c.hollow});
    else
      pen.sample(x, y - 18, colour_of(k), c.dashed);
    pen.text(x + 25, y - 14, c.label, Anchor::start);
    x += 41 + 6.3 * static_cast<double>(c.label.size());
  }
}

void words_beside(PlotPen& pen, const Mark& m, const Axes& axes) {
  const bool right_half = axes.px(m.x) > axes.px(axes.x0) + 0.6 * width;
  pen.text(axes.px(m.x) + (right_half ? -11 : 11), axes.py(m.y) - 7, m.label, right_half ? Anchor::end : Anchor::start);
}

void draw(PlotPen& pen, const Panel& p, double x_at, double y_at) {
  const Axes axes = axes_of(p, x_at, y_at);
  const double x = axes.px(axes.x0), y = axes.py(axes.y1);
  pen.text(x_at + left + width / 2, y_at + 18, p.title, Anchor::middle, PlotPen::Face::bold);
  ticks(pen, axes, true, p.log);
  ticks(pen, axes, false, p.log);
  labels(pen, p, axes);
  pen.clip(x, y, width, height);
  for (std::size_t k = 0; k < p.curves.size(); ++k) curve(pen, p, axes, k);
  for (const Mark& m : p.marks) pen.ring(axes.px(m.x), axes.py(m.y));
  pen.unclip();
  legend(pen, p, axes);
  for (const Mark& m : p.marks) words_beside(pen, m, axes);
  pen.frame(x, y, width, height);
}

}  // namespace

std::string picture(PlotPen& pen, const std::vector<Panel>& panels, std::size_t columns) {
  columns = std::max<std::size_t>(1, std::min(columns, panels.size()));
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  pen.begin(panel_width * static_cast<double>(columns), panel_height * static_cast<double>(rows));
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const std::size_t column = k % columns, row = k / columns;
    draw(pen, panels[k], panel_width * static_cast<double>(column), panel_height * static_cast<double>(row));
  }
  return pen.file();
}

std::string svg(const std::vector<Panel>& panels, std::size_t columns) {
  SvgPen pen;
  return picture(pen, panels, columns);
}

}  // namespace pintle
