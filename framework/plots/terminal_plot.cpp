#include "framework/plots/terminal_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "framework/common/index.h"
#include "framework/common/printed.h"

namespace pintle {

namespace {

/// Dots on a grid, y upwards.
class Dots {
 public:
  Dots(int columns, int rows) : columns_(columns), rows_(rows), cells_(at(columns * rows), 0) {}
  int width() const { return 2 * columns_; }
  int height() const { return 4 * rows_; }

  void set(int x, int y) {
    if (x < 0 || y < 0 || x >= width() || y >= height()) return;
    const int down = height() - 1 - y, in_cell = down % 4;
    const int bit = in_cell == 3 ? 6 + x % 2 : in_cell + 3 * (x % 2);
    cells_[at(down / 4 * columns_ + x / 2)] |= 1 << bit;
  }
  void line(int x0, int y0, int x1, int y1) {
    const int steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
    for (int k = 0; k <= steps; ++k)
      set(x0 + static_cast<int>(std::lround(double(x1 - x0) * k / steps)), y0 + static_cast<int>(std::lround(double(y1 - y0) * k / steps)));
  }
  /// Characters from U+2800 on, as UTF-8; blanks where there is no dot.
  std::string row(int r) const {
    std::string out;
    for (int c = 0; c < columns_; ++c) {
      const int cell = cells_[at(r * columns_ + c)];
      out += cell == 0 ? " " : std::string{'\xe2', static_cast<char>(0xa0 | cell >> 6), static_cast<char>(0x80 | (cell & 0x3f))};
    }
    return out;
  }

 private:
  int columns_, rows_;
  std::vector<int> cells_;
};

struct Span {
  double least = INFINITY, greatest = -INFINITY;
  void add(double x) {
    if (std::isfinite(x)) least = std::min(least, x), greatest = std::max(greatest, x);
  }
  void widen() {
    if (!(least <= greatest)) least = 0, greatest = 1;
    if (least == greatest) least -= 0.5 * std::max(std::abs(least), 1e-300), greatest += 0.5 * std::max(std::abs(greatest), 1e-300);
  }
  int place(double x, int dots) const { return static_cast<int>(std::lround((x - least) / (greatest - least) * (dots - 1))); }
};

void draw_curve(const Curve& curve, const Span& x, const Span& y, Dots& dots) {
  bool before = false;
  int px = 0, py = 0;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const bool there = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
    if (there) {
      const int qx = x.place(curve.x[i], dots.width()), qy = y.place(curve.y[i], dots.height());
      if (before)
        dots.line(px, py, qx, qy);
      else
        dots.set(qx, qy);
      px = qx, py = qy;
    }
    before = there;
  }
}

}  // namespace

std::string terminal_plot(const Panel& panel, int columns, int rows) {
  constexpr int words = 12;  // characters for the numbers on the left
  Dots dots(std::max(columns - words - 2, 20), std::max(rows - 3, 4));
  Span x, y;
  for (const Curve& c : panel.curves) {
    for (const double v : c.x) x.add(v);
    for (const double v : c.y) y.add(v);
  }
  x.widen(), y.widen();
  for (const Curve& c : panel.curves) draw_curve(c, x, y, dots);

  std::string out = "  " + panel.title + "\n";
  const int last = dots.height() / 4 - 1;
  for (int r = 0; r <= last; ++r) {
    const std::string value = r == 0                      ? printed("%.5g", y.greatest)
                              : r == last                 ? printed("%.5g", y.least)
                              : r == last / 2 && last > 5 ? printed("%.5g", (y.least + y.greatest) / 2)
                                                          : "";
    out += printed("%*s ", words, value.c_str()) + "│" + dots.row(r) + "\n";
  }
  const std::string begin = printed("%.5g", x.least), end = printed("%.5g", x.greatest) + " " + panel.x_label;
  const int gap = std::max(dots.width() / 2 - static_cast<int>(begin.size() + end.size()), 1);
  return out + std::string(words + 2, ' ') + begin + std::string(at(gap), ' ') + end + "\n";
}

}  // namespace pintle
