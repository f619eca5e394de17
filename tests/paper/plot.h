#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

/// The page on Ebrahimi, Salahshoor and Moradi (2017): see page.cpp.
namespace paper {

using Vector = std::vector<double>;
const std::filesystem::path source = PINTLE_SOURCE_DIR;
const double pi = std::acos(-1.0);

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string f(const char* format, ...);

struct Curve {
  std::string label;
  Vector x, y;
  bool dashed = false;
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  std::array<double, 2> x_range{0, 0}, y_range{0, 0};  ///< 0, 0: from the curves
  bool equal = false;                                  ///< same scale on both axes
  bool log = false;  ///< both axes; the numbers of curves are then decimal logarithms, a point each is marked
};

void write(const std::filesystem::path& file, const std::string& content);
void figure(const std::string& name, const std::vector<Panel>& panels, std::size_t columns = 2);

}  // namespace paper
