// pintle-picture DIR OUT.png: one frame of a run's animation as a picture for a page, drawn
// offscreen by VTK. Reads what framework/drawing/vtk.h describes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>

#include "app/body_fields.h"
#include "app/canvas.h"
#include "app/field_picture.h"
#include "app/frames.h"
#include "app/png.h"
#include "app/quantity.h"

namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using pintle::Canvas;
using pintle::Colour;
using pintle::FieldRange;
using pintle::Part;
using pintle::quantity;

// What to draw ------------------------------------------------------------------------------------

struct Choice {
  fs::path directory, picture;
  int frame = -1;                                          ///< counted from 0; from the end if negative
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]; the frame nearest to it
  int width = 1400, height = 0;                            ///< [px]; height 0: as the content asks
  std::string around;                                      ///< an owner to fill the picture with
  std::string field;                                       ///< of flexible bodies, in colour
};

// Colours and words -------------------------------------------------------------------------------

const Colour ink{0.16, 0.18, 0.22}, white{1, 1, 1}, red{0.80, 0.16, 0.14};

/// Okabe and Ito's colours, which the colour-blind tell apart, less the yellow, which white
/// swallows.
const std::array<Colour, 6> palette{Colour{0.00, 0.45, 0.70}, Colour{0.84, 0.37, 0.00}, Colour{0.00, 0.62, 0.45},
                                    Colour{0.80, 0.47, 0.65}, Colour{0.34, 0.71, 0.91}, Colour{0.90, 0.62, 0.00}};

Colour mix(const Colour& a, const Colour& b, double share_of_b) { return a + share_of_b * (b - a); }

// How to draw -------------------------------------------------------------------------------------

/// The part of the world that is seen, and where: a uniform scale.
struct View {
  Eigen::AlignedBox2d world;
  int width, height;  ///< [px]
  double scale;       ///< [px/m]
  Vector2d operator()(const Vector2d& r) const {
    return Vector2d(width / 2.0, bottom + (height - bottom - top) / 2.0) + scale * (r - world.center());
  }
  int bottom = 84;  ///< margins [px]
  static constexpr int side = 36, top = 76;
};

constexpr int field_row = 48;  ///< height of what the scale of a field takes below [px]

/// Chooses the scale, and the height where it is free, so that `world` fills the picture.
void fit(View& view, int asked_height) {
  const int margins = view.bottom + View::top, inner = view.width - 2 * View::side;
  Eigen::AlignedBox2d world = view.world;
  const double size = std::max(world.sizes().maxCoeff(), 1e-9);
  world.min().array() -= 0.03 * size;
  world.max().array() += 0.03 * size;
  const Vector2d sizes = world.sizes();
  view.height = asked_height;
  if (asked_height == 0) {
    const double asked = sizes.y() / sizes.x() * inner + margins;
    view.height = static_cast<int>(std::clamp(asked, 0.3 * view.width, 0.8 * view.width));
  }
  view.scale = std::min(inner / sizes.x(), (view.height - margins) / sizes.y());
  if (!(view.scale > 0)) throw std::runtime_error("--size: too small to draw in");
}

double largest_force(const pintle::Drawing& drawing) {
  double largest = 0;
  for (const auto& f : drawing.forces) largest = std::max(largest, f.force.norm());
  return largest;
}

double pixels_per_newton(const View& view, const pintle::Drawing& drawing) { return 0.16 * view.width / largest_force(drawing); }

View view_of(const pintle::Drawing& drawing, const Choice& choice) {
  View view{{}, choice.width, choice.height, 1};
  if (!choice.field.empty()) view.bottom += field_row;
  const bool whole = choice.around.empty();
  for (const auto& line : drawing.lines) {
    const std::string& owner = drawing.owners.at(static_cast<std::size_t>(line.owner));
    if (!whole && (owner != choice.around || line.part == Part::trace)) continue;
    for (const auto& r : line.points) view.world.extend(r);
  }
  for (const auto& body : drawing.bodies) {
    if (!whole && body.name != choice.around) continue;
    for (Eigen::Index i = 0; i < body.points.cols(); ++i) view.world.extend(Vector2d(body.points.col(i)));
  }
  if (view.world.isEmpty()) {
    throw std::runtime_error(whole ? "the frame is empty" : "--around " + choice.around + ": no lines of that name");
  }
  fit(view, choice.height);
  if (whole && largest_force(drawing) > 0) {  // room for the arrows, whose length is in pixels
    const double metres = pixels_per_newton(view, drawing) / view.scale;
    for (const auto& f : drawing.forces) view.world.extend(Vector2d(f.at + metres * f.force));
    fit(view, choice.height);
  }
  return view;
}

int owner_of(const pintle::Drawing& drawing, const pintle::DrawnBody& body) {
  return static_cast<int>(std::find(drawing.owners.begin(), drawing.owners.end(), body.name) - drawing.owners.begin());
}

/// A colour for each owner that has a link or is flexible, in the order of the owners.
std::map<int, Colour> body_colours(const pintle::Drawing& drawing) {
  std::map<int, Colour> colours;
  for (const auto& line : drawing.lines) {
    if (line.part == Part::link) colours[line.owner] = ink;
  }
  for (const auto& body : drawing.bodies) colours[owner_of(drawing, body)] = ink;
  std::size_t n = 0;
  for (auto& [owner, colour] : colours) {
    const auto o = static_cast<std::size_t>(owner);
    const auto own = o < drawing.colours.size() ? drawing.colours[o] : std::nullopt;
    colour = own ? Colour((*own)[0] / 255.0, (*own)[1] / 255.0, (*own)[2] / 255.0) : palette[n++ % palette.size()];
  }
  return colours;
}

void draw_bodies(Canvas& canvas, const View& view, const pintle::Drawing& drawing, const std::map<int, Colour>& colours,
                 const std::string& field) {
  const FieldRange range = field.empty() ? FieldRange{} : range_of(drawing, field);
  for (const auto& body : drawing.bodies) {
    Eigen::Matrix2Xd at(2, body.points.cols());
    for (Eigen::Index i = 0; i < at.cols(); ++i) at.col(i) = view(body.points.col(i));
    const Colour& own = colours.at(owner_of(drawing, body));
    std::vector<Colour> inside;
    for (const double value : values(body, field)) inside.push_back(pintle::field_colour(range.share(value)));
    const bool plain = inside.empty();
    if (plain) inside.push_back(mix(own, white, 0.65));
    canvas.fill(at, body.cells, inside);
    canvas.next_layer();
    canvas.stroke_outline(at, body.cells, plain ? 4 : 2, plain ? own : ink);
    canvas.next_layer();
  }
}

void draw_lines(Canvas& canvas, const View& view, const pintle::Drawing& drawing, const std::map<int, Colour>& colours, Part part) {
  for (const auto& line : drawing.lines) {
    if (line.part != part) continue;
    std::vector<Vector2d> r;
    for (const auto& p : line.points) r.push_back(view(p));
    switch (part) {
      case Part::guide: canvas.stroke(r, line.closed, 4, mix(ink, white, 0.45)); break;
      case Part::trace: canvas.stroke(r, line.closed, 1.6, mix(ink, white, 0.55)); break;
      case Part::spring: canvas.stroke(r, line.closed, 3, mix(ink, white, 0.2)); break;
      case Part::link: {
        const Colour& colour = colours.at(line.owner);
        if (line.closed) {
          canvas.fill(r, mix(colour, white, 0.65));
          canvas.next_layer();
          canvas.stroke(r, true, 4, colour);
        } else {
          canvas.stroke(r, false, 13, mix(colour, ink, 0.5));
          canvas.next_layer();
          canvas.stroke(r, false, 9, colour);
        }
        break;
      }
      case Part::joint:
      case Part::journal:
      case Part::bearing:
        if (r.size() == 1) {
          canvas.disc(r[0], 8, ink);
          canvas.next_layer();
          canvas.disc(r[0], 5, white);
          break;
        }
        if (line.closed) {
          canvas.fill(r, part == Part::journal ? mix(ink, white, 0.7) : white);
          canvas.next_layer();
        }
        canvas.stroke(r, line.closed, 3, ink);
        break;
    }
    canvas.next_layer();
  }
}

void draw_forces(Canvas& canvas, const View& view, const pintle::Drawing& drawing) {
  if (largest_force(drawing) == 0) return;
  const double scale = pixels_per_newton(view, drawing);
  for (const auto& f : drawing.forces) {
    const Vector2d at = view(f.at);
    canvas.arrow(at, at + scale * f.force, 5, red);
  }
  canvas.next_layer();
}

vtkSmartPointer<vtkTextActor> words(const std::string& text, double x, double y, bool right, const Colour& colour) {
  const auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->SetDisplayPosition(static_cast<int>(x), static_cast<int>(y));
  vtkTextProperty* style = actor->GetTextProperty();
  style->SetFontFamilyToArial();
  style->SetFontSize(22);
  style->SetColor(colour.x(), colour.y(), colour.z());
  if (right) style->SetJustificationToRight();
  return actor;
}

/// The scale of a field's colours: its name, its least and its greatest value.
void add_field_scale(vtkRenderer* renderer, Canvas& canvas, const View& view, const std::string& field, const FieldRange& range) {
  const std::size_t unit = field.rfind(" [");
  const bool has_unit = unit != std::string::npos && field.back() == ']';
  const std::string symbol = has_unit ? field.substr(unit + 2, field.size() - unit - 3) : "";
  constexpr int steps = 256;
  const double left = 0.42 * view.width, right = 0.82 * view.width, y = view.bottom - field_row, width = (right - left) / steps,
               height = 18;
  for (int i = 0; i < steps; ++i) {
    const double x = left + i * width;
    canvas.fill({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, pintle::field_colour((i + 0.5) / steps));
  }
  canvas.next_layer();
  const std::string name = field.substr(0, has_unit ? unit : field.size());
  renderer->AddActor2D(words(name, View::side, y, false, ink));
  const bool from_zero = std::abs(range.least) < 1e-6 * std::abs(range.greatest);
  renderer->AddActor2D(words(quantity(from_zero ? 0 : range.least, symbol), left - 14, y, true, ink));
  renderer->AddActor2D(words(quantity(range.greatest, symbol), right + 14, y, false, ink));
}

/// Time and bodies above; the scales of lengths and forces and the exaggeration below.
void add_words(vtkRenderer* renderer, Canvas& canvas, const View& view, const pintle::Drawing& drawing,
               const std::map<int, Colour>& colours) {
  const double w = view.width, h = view.height, top = h - View::top / 2.0 - 8;
  canvas.fill({{0, h - View::top}, {w, h - View::top}, {w, h}, {0, h}}, white);
  canvas.fill({{0, 0}, {w, 0}, {w, 1.0 * view.bottom}, {0, 1.0 * view.bottom}}, white);
  canvas.next_layer();
  renderer->AddActor2D(words("t = " + quantity(drawing.t, "s"), View::side, top, false, ink));
  double x = view.width - View::side;
  for (auto entry = colours.rbegin(); entry != colours.rend(); ++entry) {
    const std::string& name = drawing.owners.at(static_cast<std::size_t>(entry->first));
    const auto label = words(name, x, top, true, mix(entry->second, ink, 0.35));
    std::array<double, 2> size{};
    label->GetSize(renderer, size.data());
    renderer->AddActor2D(label);
    x -= size[0] + 20;
    canvas.disc({x + 4, top + 10}, 8, entry->second);
    x -= 32;
  }

  const double length = pintle::round_length(0.2 * view.width / view.scale), y = 38;
  const double end = View::side + length * view.scale;
  canvas.stroke({{View::side, y + 8}, {View::side, y}, {end, y}, {end, y + 8}}, false, 2.5, ink);
  renderer->AddActor2D(words(quantity(length, "m"), end + 14, y - 6, false, ink));

  std::string below;
  const double largest = largest_force(drawing);
  if (largest > 0) below = "longest arrow " + quantity(largest, "N");
  const auto add_times = [&](const char* what, double times) {
    std::array<char, 64> text;
    std::snprintf(text.data(), text.size(), "%s drawn %.3g times", what, times);
    below += (below.empty() ? "" : "      ") + std::string(text.data());
  };
  if (drawing.exaggeration != 1) add_times("clearance", drawing.exaggeration);
  if (drawing.deformation != 1) add_times("deformation", drawing.deformation);
  renderer->AddActor2D(words(below, view.width - View::side, y - 6, true, ink));
}

void write_picture(const pintle::Drawing& drawing, const Choice& choice) {
  const View view = view_of(drawing, choice);
  const auto colours = body_colours(drawing);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetMultiSamples(8);
  window->SetSize(view.width, view.height);
  window->AddRenderer(renderer);

  Canvas canvas;
  for (const Part part : {Part::guide, Part::link, Part::spring, Part::joint, Part::bearing, Part::journal, Part::trace}) {
    draw_lines(canvas, view, drawing, colours, part);
    if (part == Part::link) draw_bodies(canvas, view, drawing, colours, choice.field);
  }
  draw_forces(canvas, view, drawing);
  add_words(renderer, canvas, view, drawing, colours);
  if (!choice.field.empty()) add_field_scale(renderer, canvas, view, choice.field, range_of(drawing, choice.field));
  renderer->AddActor(canvas.actor());

  vtkCamera* camera = renderer->GetActiveCamera();
  const double x = view.width / 2.0, y = view.height / 2.0, far = canvas.layer() + 2;
  camera->ParallelProjectionOn();
  camera->SetParallelScale(y);
  camera->SetFocalPoint(x, y, 0);
  camera->SetPosition(x, y, far);
  camera->SetClippingRange(0.5, far + 1);
  window->Render();

  pintle::write_png(window, choice.picture);
}

}  // namespace

int main(int argc, char** argv) {
  Choice choice;
  std::string size;
  CLI::App app{
      "Draws one frame of a run as a picture, or a field of a body that modes, static or mesh "
      "wrote.\n"
      "Needs a display, be it a virtual one:  xvfb-run -a pintle-picture DIR OUT.png"};
  app.add_option("dir", choice.directory, "What `pintle run --out` wrote, or a .vtu file with --field")->required();
  app.add_option("picture", choice.picture, "The PNG file to write")->required();
  auto* frame = app.add_option("--frame", choice.frame, "Frame, from 0; -1 is the last (default)");
  app.add_option("--time", choice.time, "The frame nearest to this time [s]")->excludes(frame);
  app.add_option("--size", size, "WIDTHxHEIGHT or WIDTH in pixels (1400, as high as needed)");
  app.add_option("--around", choice.around, "Fill the picture with this body or joint");
  app.add_option("--field", choice.field, "Colour flexible bodies, or the .vtu file's, by this field: \"von Mises [Pa]\"");
  CLI11_PARSE(app, argc, argv);
  vtkObject::GlobalWarningDisplayOff();  // what fails is said below, once
  try {
    if (!size.empty() && std::sscanf(size.c_str(), "%dx%d", &choice.width, &choice.height) < 1) {
      throw std::runtime_error("--size " + size + ": give WIDTHxHEIGHT, such as 1400x600");
    }
    if (std::getenv("DISPLAY") == nullptr) {
      throw std::runtime_error("no display; run it as  xvfb-run -a pintle-picture …");
    }
    if (!choice.field.empty() && !fs::is_directory(choice.directory))
      pintle::write_field_picture(choice.directory, choice.field, choice.width, choice.picture);
    else
      write_picture(pintle::read_frame(pintle::frame_files(choice.directory, choice.frame, choice.time)), choice);
  } catch (const std::exception& e) {
    std::cerr << "pintle-picture: " << e.what() << '\n';
    return 1;
  }
}
