#pragma once

#include <array>
#include <string>
#include <vector>

namespace pintle {

/// Draws plots, in pixels from the upper left corner.
class PlotPen {
 public:
  using Points = std::vector<std::array<double, 2>>;
  enum class Anchor { start, middle, end };
  enum class Face { plain, bold, upwards };
  struct Dot {
    const char* colour;  ///< "#rrggbb"
    double radius;
    bool hollow;
  };

  virtual ~PlotPen() = default;
  virtual void begin(double width, double height) = 0;  ///< called first
  virtual void text(double x, double y, const std::string& words, Anchor = Anchor::middle, Face = Face::plain) = 0;
  virtual void rule(double x, double y, double dx, double dy) = 0;  ///< a light line
  virtual void curve(const Points&, const char* colour, bool dashed) = 0;
  virtual void sample(double x, double y, const char* colour, bool dashed) = 0;  ///< of a curve, for the legend
  virtual void dot(double x, double y, const Dot&) = 0;
  virtual void ring(double x, double y) = 0;
  virtual void frame(double x, double y, double width, double height) = 0;
  virtual void clip(double x, double y, double width, double height) = 0;  ///< until unclip()
  virtual void unclip() = 0;
  virtual std::string file() = 0;  ///< the picture; called last
};

}  // namespace pintle
