#pragma once

#include <array>
#include <string>
#include <vector>

/// Curves and points as a picture.
namespace pintle {

class PlotPen;

struct Curve {
  std::string label;
  std::vector<double> x, y;
  bool dashed = false;
  bool points = false;  ///< only points, without a line through them
  bool hollow = false;  ///< these as rings
  double radius = 0;    ///< of these [px]; 0: smaller if there are many
};

/// A point with a ring around it and a label.
struct Mark {
  double x = 0, y = 0;
  std::string label;
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  std::array<double, 2> x_range{0, 0}, y_range{0, 0};  ///< 0, 0: from the curves
  bool equal = false;                                  ///< same scale on both axes
  bool log = false;  ///< both axes; the values of curves are then decimal logarithms, and each point is marked
  std::vector<Mark> marks = {};
};

/// Panels side by side, `columns` in a row.
std::string picture(PlotPen&, const std::vector<Panel>& panels, std::size_t columns = 2);
std::string svg(const std::vector<Panel>& panels, std::size_t columns = 2);

}  // namespace pintle
