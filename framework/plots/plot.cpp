#include "framework/plots/plot.h"

#include <algorithm>
#include <cmath>

#include "framework/common/printed.h"

namespace pintle {

namespace {

constexpr double panel_width = 520, panel_height = 390, left = 78, right = 16, top = 62, bottom = 50;
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

// Douglas and Peucker: keeps what differs from a straight line by more than a quarter of a pixel.
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

std::string draw(const Panel& p, double x_at, double y_at, int id) {
  double x0 = p.x_range[0], x1 = p.x_range[1], y0 = p.y_range[0], y1 = p.y_range[1];
  const bool fit_x = x0 == x1, fit_y = y0 == y1;
  if (fit_x) x0 = INFINITY, x1 = -INFINITY;
  if (fit_y) y0 = INFINITY, y1 = -INFINITY;
  for (const Curve& c : p.curves)
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (fit_x) x0 = std::min(x0, c.x[i]), x1 = std::max(x1, c.x[i]);
      if (fit_y && (fit_x || (c.x[i] >= x0 && c.x[i] <= x1))) y0 = std::min(y0, c.y[i]), y1 = std::max(y1, c.y[i]);
    }
  if (fit_y) {
    const double room = y1 > y0 ? 0.05 * (y1 - y0) : 1e-3 * std::max(1.0, std::abs(y0));
    y0 -= room, y1 += room;
  }
  const double width = panel_width - left - right, height = panel_height - top - bottom;
  if (p.equal) {
    const double scale = std::max((x1 - x0) / width, (y1 - y0) / height) * 1.05;
    const double xm = (x0 + x1) / 2, ym = (y0 + y1) / 2;
    x0 = xm - scale * width / 2, x1 = xm + scale * width / 2;
    y0 = ym - scale * height / 2, y1 = ym + scale * height / 2;
  }
  const auto px = [&](double x) { return x_at + left + (x - x0) / (x1 - x0) * width; };
  const auto py = [&](double y) { return y_at + top + (y1 - y) / (y1 - y0) * height; };
  std::string s = text(x_at + left + width / 2, y_at + 18, p.title, "middle", " font-weight='bold'");
  const auto tick = [&](double at, bool horizontal, const std::string& number) {
    if (horizontal) {
      s += printed("<path d='M%.1f %.1fv%.1f' stroke='#ddd'/>\n", px(at), py(y0), -height);
      s += text(px(at), py(y0) + 16, number);
    } else {
      s += printed("<path d='M%.1f %.1fh%.1f' stroke='#ddd'/>\n", px(x0), py(at), width);
      s += text(px(x0) - 6, py(at) + 4, number, "end");
    }
  };
  const auto axis = [&](double a, double b, bool horizontal) {
    if (p.log && b - a < 2.2) {  // too few whole decades to read numbers between them
      for (double decade = std::floor(a); decade <= b; ++decade)
        for (const double m : {1.0, 2.0, 5.0})
          if (const double at = decade + std::log10(m); at >= a - 1e-9 && at <= b + 1e-9)
            tick(at, horizontal, printed("%.0fe%.0f", m, decade));
      return;
    }
    const double step = p.log ? std::max(1.0, std::round(tick_step(b - a))) : tick_step(b - a);
    const int digits = std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 9);
    for (double k = std::ceil(a / step - 1e-9); k * step <= b + 1e-9 * step; ++k)
      tick(k * step, horizontal, p.log ? printed("1e%.0f", k * step) : printed("%.*f", digits, k * step + 0.0));
  };
  axis(x0, x1, true);
  axis(y0, y1, false);
  s += text(x_at + left + width / 2, y_at + panel_height - 14, p.x_label);
  s +=
      text(0, 0, p.y_label, "middle", printed(" transform='translate(%.1f %.1f) rotate(-90)'", x_at + 16, y_at + top + height / 2).c_str());
  s += printed("<clipPath id='c%d'><rect x='%.1f' y='%.1f' width='%.1f' height='%.1f'/></clipPath>\n", id, px(x0), py(y1), width, height);
  s += printed("<g clip-path='url(#c%d)' fill='none' stroke-width='1.4' stroke-linejoin='round'>\n", id);
  double legend = x_at + left;
  std::string legends;
  for (std::size_t k = 0; k < p.curves.size(); ++k) {
    const Curve& c = p.curves[k];
    const std::string line = printed("stroke='%s'%s", colours[k % colours.size()], c.dashed ? " stroke-dasharray='6 4'" : "");
    std::vector<double> x, y;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      const bool near = p.equal || p.log || (c.x[std::min(i + 1, c.x.size() - 1)] >= x0 && c.x[i > 0 ? i - 1 : 0] <= x1);
      if (near) x.push_back(px(c.x[i])), y.push_back(std::clamp(py(c.y[i]), -2000.0, 6000.0));
    }
    if (!x.empty() && !c.points) {
      std::vector<bool> keep(x.size(), false);
      keep.front() = keep.back() = true;
      thin(x, y, 0, x.size() - 1, keep);
      s += "<path " + line + " d='";
      bool first = true;
      for (std::size_t i = 0; i < x.size(); ++i)
        if (keep[i]) s += printed("%c%.1f %.1f", first ? 'M' : 'L', x[i], y[i]), first = false;
      s += "'/>\n";
    }
    {
      for (std::size_t i = 0; (p.log || c.points) && i < x.size(); ++i)
        s += printed("<circle cx='%.1f' cy='%.1f' r='2.5' fill='%s'/>\n", x[i], y[i], colours[k % colours.size()]);
    }
    if (c.label.empty()) continue;
    legends += c.points
                   ? printed("<circle cx='%.1f' cy='%.1f' r='3' fill='%s'/>\n", legend + 10, y_at + top - 18, colours[k % colours.size()])
                   : printed("<path d='M%.1f %.1fh20' %s stroke-width='2'/>\n", legend, y_at + top - 18, line.c_str());
    legends += text(legend + 25, y_at + top - 14, c.label, "start");
    legend += 41 + 6.3 * static_cast<double>(c.label.size());
  }
  for (const Mark& m : p.marks) s += printed("<circle cx='%.1f' cy='%.1f' r='7' stroke='#111' stroke-width='1.6'/>\n", px(m.x), py(m.y));
  s += "</g>\n" + legends;
  for (const Mark& m : p.marks) {
    const bool right_half = px(m.x) > px(x0) + 0.6 * width;
    s += text(px(m.x) + (right_half ? -11 : 11), py(m.y) - 7, m.label, right_half ? "end" : "start");
  }
  s += printed("<rect x='%.1f' y='%.1f' width='%.1f' height='%.1f' fill='none' stroke='#333'/>\n", px(x0), py(y1), width, height);
  return s;
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
  for (std::size_t k = 0; k < panels.size(); ++k)
    s += draw(panels[k], panel_width * static_cast<double>(k % columns), panel_height * static_cast<double>(k / columns),
              static_cast<int>(k));
  return s + "</svg>\n";
}

}  // namespace pintle
