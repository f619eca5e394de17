#include "app/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <cairo.h>

#include "framework/common/file.h"

namespace pintle {

namespace {

using Triangle = std::array<int, 3>;

/// Divides a cell into triangles that use all of its nodes.
std::vector<Triangle> triangles(CellShape shape) {
  switch (shape) {
    case CellShape::triangle3: return {{0, 1, 2}};
    case CellShape::triangle6: return {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    case CellShape::quadrilateral4: return {{0, 1, 2}, {0, 2, 3}};
    case CellShape::quadrilateral8: return {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6}, {4, 6, 7}};
    case CellShape::quadrilateral9: return {{0, 4, 8}, {0, 8, 7}, {4, 1, 5}, {4, 5, 8}, {8, 5, 2}, {8, 2, 6}, {7, 8, 6}, {7, 6, 3}};
    case CellShape::line2:
    case CellShape::line3: break;
  }
  return {};
}

/// For each point, the first one at the same place. The elements of a beam have coinciding but separate points.
std::vector<int> first_at_same_place(const Eigen::Matrix2Xd& points) {
  const Vector2d low = points.rowwise().minCoeff();
  const double reach = 1e-7 * (points.rowwise().maxCoeff() - low).norm();
  std::map<std::pair<long, long>, int> known;  // by square of twice the tolerance
  std::vector<int> first(static_cast<std::size_t>(points.cols()));
  for (int i = 0; i < points.cols(); ++i) {
    const Vector2d at = (points.col(i) - low) / (2 * reach);
    const long x = std::lround(at.x()), y = std::lround(at.y());
    int found = i;
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy) {
        const auto other = known.find({x + dx, y + dy});
        if (other != known.end() && (points.col(other->second) - points.col(i)).norm() <= reach) found = other->second;
      }
    if (found == i) known.emplace(std::pair(x, y), i);
    first[static_cast<std::size_t>(i)] = found;
  }
  return first;
}

template <class Draw>
void for_each_triangle(const std::vector<Cells>& cells, const Draw& draw) {
  for (const Cells& block : cells)
    for (std::size_t c = 0; c < block.size(); ++c)
      for (const Triangle& t : triangles(block.shape)) {
        const int* node = &block.nodes[c * static_cast<std::size_t>(nodes_of(block.shape))];
        draw({node[t[0]], node[t[1]], node[t[2]]});
      }
}

/// The bytes of a picture, top row first.
struct Pixels {
  unsigned char* bytes;
  int stride, width, height;

  /// A triangle with linear colour between its corners: fills the pixels whose centre is inside.
  void shade(const std::array<Vector2d, 3>& r, const std::array<Colour, 3>& colour) {
    const Vector2d low = r[0].cwiseMin(r[1]).cwiseMin(r[2]), high = r[0].cwiseMax(r[1]).cwiseMax(r[2]), d1 = r[1] - r[0], d2 = r[2] - r[0];
    const double area = d1.x() * d2.y() - d1.y() * d2.x();
    if (area == 0 || !low.allFinite() || !high.allFinite()) return;
    const auto pixel = [](double x, int most) { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most))); };
    for (int y = pixel(low.y() - 0.5, height); y < pixel(high.y() + 1.5, height); ++y)
      for (int x = pixel(low.x() - 0.5, width); x < pixel(high.x() + 1.5, width); ++x) {
        const Vector2d d = Vector2d(x + 0.5, y + 0.5) - r[0];
        const double b = (d.x() * d2.y() - d.y() * d2.x()) / area, c = (d1.x() * d.y() - d1.y() * d.x()) / area;
        constexpr double edge = -1e-9;  // a pixel on a side belongs to both triangles
        if (b < edge || c < edge || b + c > 1 - edge) continue;
        const Colour mixed = 255 * ((1 - b - c) * colour[0] + b * colour[1] + c * colour[2]);
        unsigned char* at = bytes + static_cast<std::ptrdiff_t>(y) * stride + 4 * x;
        for (int k = 0; k < 3; ++k) at[k] = static_cast<unsigned char>(std::clamp(mixed[2 - k], 0.0, 255.0));
      }
  }
};

}  // namespace

Colour field_colour(double share) {
  const double s = std::clamp(share, 0.0, 1.0), hue = 6 * 0.66 * (1 - s), saturation = 0.75 + 0.1 * s, value = 0.85 + 0.05 * s;
  const auto channel = [&](double n) {
    const double k = std::fmod(n + hue, 6);
    return value - value * saturation * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
  };
  return {channel(5), channel(3), channel(1)};
}

struct Canvas::Surface {
  cairo_surface_t* image;
  cairo_t* pen;
  Surface(int width, int height) : image(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), pen(cairo_create(image)) {}
  ~Surface() {
    cairo_destroy(pen);
    cairo_surface_destroy(image);
  }
  Surface(const Surface&) = delete;
};

Canvas::Canvas(int width, int height, double letters) : width_(width), height_(height), surface_(std::make_unique<Surface>(width, height)) {
  if (cairo_status(surface_->pen) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels is too large to draw; choose a smaller --size");
  cairo_t* pen = surface_->pen;
  cairo_set_line_cap(pen, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
  cairo_select_font_face(pen, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, letters);
  clear();
}

Canvas::~Canvas() = default;

void Canvas::clear() {
  paint({1, 1, 1});
  cairo_paint(surface_->pen);
}

void Canvas::paint(const Colour& colour) { cairo_set_source_rgb(surface_->pen, colour.x(), colour.y(), colour.z()); }

void Canvas::trace(const std::vector<Vector2d>& line, bool closed) {
  constexpr double far = 1e5;  // cairo uses 24 bits for pixel coordinates
  for (const Vector2d& r : line) {
    const Vector2d at = r.cwiseMax(-far).cwiseMin(far);
    cairo_line_to(surface_->pen, at.x(), height_ - at.y());
  }
  if (closed) cairo_close_path(surface_->pen);
}

void Canvas::fill(const std::vector<Vector2d>& outline, const Colour& colour) {
  paint(colour);
  trace(outline, true);
  cairo_fill(surface_->pen);
}

void Canvas::fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>& cells, const Colour& colour) {
  paint(colour);
  for_each_triangle(cells, [&](const Triangle& t) {
    cairo_new_sub_path(surface_->pen);
    trace({points.col(t[0]), points.col(t[1]), points.col(t[2])}, true);
  });
  cairo_fill(surface_->pen);  // all at once: if they were filled one by one, the paper would show between triangles
}

void Canvas::fill(const Eigen::Matrix2Xd& points, const std::vector<Cells>& cells, const std::vector<Colour>& colours) {
  cairo_surface_flush(surface_->image);
  Pixels pixels{cairo_image_surface_get_data(surface_->image), cairo_image_surface_get_stride(surface_->image), width_, height_};
  for_each_triangle(cells, [&](const Triangle& t) {
    std::array<Vector2d, 3> r;
    std::array<Colour, 3> c;
    for (std::size_t k = 0; k < 3; ++k) {
      r[k] = {points(0, t[k]), height_ - points(1, t[k])};
      c[k] = colours[static_cast<std::size_t>(t[k])];
    }
    pixels.shade(r, c);
  });
  cairo_surface_mark_dirty(surface_->image);
}

void Canvas::stroke_outline(const Eigen::Matrix2Xd& points, const std::vector<Cells>& cells, double width, const Colour& colour) {
  Mesh mesh{points, {}, cells, {}};
  const std::vector<int> first = first_at_same_place(points);
  for (Cells& block : mesh.cells)
    for (int& node : block.nodes) node = first[static_cast<std::size_t>(node)];
  for (const Cells& sides : pintle::outline(mesh)) {
    const int n = nodes_of(sides.shape);
    for (std::size_t c = 0; c < sides.size(); ++c) {
      const int* node = &sides.nodes[c * static_cast<std::size_t>(n)];
      std::vector<Vector2d> line{points.col(node[0])};
      if (n == 3) line.emplace_back(points.col(node[2]));
      line.emplace_back(points.col(node[1]));
      stroke(line, false, width, colour);
    }
  }
}

void Canvas::stroke(const std::vector<Vector2d>& line, bool closed, double width, const Colour& colour) {
  paint(colour);
  cairo_set_line_width(surface_->pen, width);
  trace(line, closed);
  cairo_stroke(surface_->pen);
}

void Canvas::disc(const Vector2d& centre, double radius, const Colour& colour) {
  paint(colour);
  cairo_arc(surface_->pen, centre.x(), height_ - centre.y(), radius, 0, 2 * std::numbers::pi);
  cairo_fill(surface_->pen);
}

void Canvas::arrow(const Vector2d& from, const Vector2d& to, double width, const Colour& colour) {
  const Vector2d way = to - from;
  if (way.norm() < 1) return;
  const Vector2d along = way.normalized(), across{-along.y(), along.x()};
  const double head = std::min(4 * width, way.norm());
  const Vector2d neck = to - head * along;
  stroke({from, neck}, false, width, colour);
  fill({to, neck + 0.42 * head * across, neck - 0.42 * head * across}, colour);
}

void Canvas::turn(const Vector2d& centre, double radius, bool counter_clockwise, double width, const Colour& colour) {
  constexpr int pieces = 36;
  const double sense = counter_clockwise ? 1 : -1, begin = std::numbers::pi / 2 - sense * 0.25 * std::numbers::pi;
  std::vector<Vector2d> line;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = begin + sense * 1.4 * std::numbers::pi * i / pieces;
    line.emplace_back(centre + radius * Vector2d(std::cos(angle), std::sin(angle)));
  }
  stroke(line, false, width, colour);
  const Vector2d out = (line.back() - centre).normalized(), along = sense * Vector2d(-out.y(), out.x());
  const double head = 4 * width;
  fill({line.back() + head * along, line.back() + 0.45 * head * out, line.back() - 0.45 * head * out}, colour);
}

void Canvas::words(const std::string& text, double x, double y, Align align, const Colour& colour) {
  paint(colour);
  cairo_move_to(surface_->pen, align == Align::right ? x - width_of(text) : x, height_ - y);
  cairo_show_text(surface_->pen, text.c_str());
  cairo_new_path(surface_->pen);
}

double Canvas::width_of(const std::string& text) const {
  cairo_text_extents_t size;
  cairo_text_extents(surface_->pen, text.c_str(), &size);
  return size.x_advance;
}

std::span<const unsigned char> Canvas::pixels() const {
  cairo_surface_flush(surface_->image);  // rows of four bytes per pixel, without gaps
  return {cairo_image_surface_get_data(surface_->image), 4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)};
}

void Canvas::write_png(const std::filesystem::path& file) const {
  std::string png;
  const auto append = [](void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  if (cairo_surface_write_to_png_stream(surface_->image, append, &png) != CAIRO_STATUS_SUCCESS)
    throw FileError(file, "the picture could not be encoded: there was not enough memory");
  write_text(file, png);
}

}  // namespace pintle
