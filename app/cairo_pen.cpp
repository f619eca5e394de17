// Plots drawn by cairo.
#include "app/cairo_pen.h"

#include <cstdlib>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include <cairo-pdf.h>
#include <cairo.h>

namespace pintle::app {

namespace {

cairo_status_t append(void* to, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

class CairoPen : public PlotPen {
 public:
  explicit CairoPen(bool pdf) : pdf_(pdf) {}
  ~CairoPen() override { cairo_destroy(pen_), cairo_surface_destroy(surface_); }
  CairoPen(const CairoPen&) = delete;

  void begin(double width, double height) override {
    const double scale = pdf_ ? 0.75 : 2;  // points per pixel of 1/96 inch; fine enough to print
    if (pdf_) {
      surface_ = cairo_pdf_surface_create_for_stream(append, &file_, scale * width, scale * height);
      cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE, "");  // the same plot is the same file
    } else {
      surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(scale * width), static_cast<int>(scale * height));
    }
    pen_ = cairo_create(surface_);
    cairo_scale(pen_, scale, scale);
    cairo_set_source_rgb(pen_, 1, 1, 1);
    cairo_paint(pen_);
    cairo_set_font_size(pen_, 12);
    cairo_set_line_join(pen_, CAIRO_LINE_JOIN_ROUND);
  }
  void text(double x, double y, const std::string& words, Anchor anchor, Face face) override {
    cairo_select_font_face(pen_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           face == Face::bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_text_extents_t size;
    cairo_text_extents(pen_, words.c_str(), &size);
    cairo_save(pen_);
    cairo_translate(pen_, x, y);
    if (face == Face::upwards) cairo_rotate(pen_, -std::numbers::pi / 2);
    cairo_move_to(pen_, -size.x_advance * (anchor == Anchor::start ? 0 : anchor == Anchor::end ? 1 : 0.5), 0);
    paint("#000000");
    cairo_show_text(pen_, words.c_str());
    cairo_new_path(pen_);
    cairo_restore(pen_);
  }
  void rule(double x, double y, double dx, double dy) override { line({{x, y}, {x + dx, y + dy}}, "#dddddd", 1); }
  void curve(const Points& points, const char* colour, bool dashed) override { line(points, colour, 1.4, dashed); }
  void sample(double x, double y, const char* colour, bool dashed) override { line({{x, y}, {x + 20, y}}, colour, 2, dashed); }
  void dot(double x, double y, const Dot& dot) override {
    cairo_arc(pen_, x, y, dot.radius, 0, 2 * std::numbers::pi);
    paint(dot.colour);
    if (!dot.hollow) return cairo_fill(pen_);
    stroke(1);
  }
  void ring(double x, double y) override {
    cairo_arc(pen_, x, y, 7, 0, 2 * std::numbers::pi);
    paint("#111111");
    stroke(1.6);
  }
  void frame(double x, double y, double width, double height) override {
    cairo_rectangle(pen_, x, y, width, height);
    paint("#333333");
    stroke(1);
  }
  void clip(double x, double y, double width, double height) override {
    cairo_rectangle(pen_, x, y, width, height);
    cairo_clip(pen_);
  }
  void unclip() override { cairo_reset_clip(pen_); }
  std::string file() override {
    if (pdf_)
      cairo_surface_finish(surface_);
    else
      cairo_surface_write_to_png_stream(surface_, append, &file_);
    if (cairo_status(pen_) != CAIRO_STATUS_SUCCESS || file_.empty()) throw std::bad_alloc();
    return std::move(file_);
  }

 private:
  void paint(const char* colour) {
    const long rgb = std::strtol(colour + 1, nullptr, 16);
    const auto channel = [&](int shift) { return static_cast<double>((rgb >> shift) & 255) / 255; };
    cairo_set_source_rgb(pen_, channel(16), channel(8), channel(0));
  }
  void stroke(double width) {
    cairo_set_line_width(pen_, width);
    cairo_stroke(pen_);
  }
  void line(const Points& points, const char* colour, double width, bool dashed = false) {
    constexpr double dashes[]{6, 4};
    for (const auto& [x, y] : points) cairo_line_to(pen_, x, y);
    paint(colour);
    cairo_set_dash(pen_, dashes, dashed ? 2 : 0, 0);
    stroke(width);
    cairo_set_dash(pen_, dashes, 0, 0);
  }

  bool pdf_;
  std::string file_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* pen_ = nullptr;
};

}  // namespace

extern "C" [[gnu::visibility("default")]] const void* pintle_cairo() {
  static constexpr CairoTable table{PINTLE_VERSION, []() -> PlotPen* { return new CairoPen(false); },
                                    []() -> PlotPen* { return new CairoPen(true); }};
  return &table;
}

}  // namespace pintle::app
