#include "app/frame_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "app/quantity.h"
#include "app/rounded.h"
#include "framework/drawing/palette.h"

namespace pintle {

namespace {

constexpr double letters = 22;  // [px], in large pictures
const Colour ink{0.16, 0.18, 0.22}, white{1, 1, 1};
constexpr int rim_width = 36, line_height = 34, field_row = 48;  // [px], in large pictures

Colour colour_of(const Rgb& rgb) { return Colour(rgb[0], rgb[1], rgb[2]) / 255.0; }

const Colour impact_colour{0.90, 0.10, 0.45};
constexpr double impact_size = 9;  ///< radius of the strongest [px], in large pictures

Colour mix(const Colour& a, const Colour& b, double share_of_b) { return a + share_of_b * (b - a); }

int owner_of(const Drawing& drawing, const DrawnBody& body) {
  return static_cast<int>(std::find(drawing.owners.begin(), drawing.owners.end(), body.name) - drawing.owners.begin());
}

/// A colour for each owner that is a link or flexible, in the order of the owners.
std::map<int, Colour> body_colours(const Drawing& drawing) {
  std::map<int, Colour> colours;
  for (const DrawnLine& line : drawing.lines)
    if (line.part == Part::link) colours[line.owner] = ink;
  for (const DrawnBody& body : drawing.bodies) colours[owner_of(drawing, body)] = ink;
  for (auto& [owner, colour] : colours) colour = colour_of(body_colour(drawing, static_cast<std::size_t>(owner)));
  return colours;
}

}  // namespace

// Layout ------------------------------------------------------------------------------------------

FramePicture::FramePicture(const PictureStyle& style, const Survey& survey, const Drawing& first, std::vector<PlacedImpact> impacts)
    : style_(style),
      asked_(survey.world()),
      usual_force_(style.forces ? survey.usual_force() : 0),
      largest_couple_(style.forces ? survey.largest_couple() : 0),
      forces_(style.forces ? survey.forces() : std::vector<DrawnForce>()),
      impacts_(std::move(impacts)),
      range_(survey.range()),
      givers_{survey.gives(Giver::joint), survey.gives(Giver::contact), survey.gives(Giver::spring), survey.gives(Giver::load)},
      width_(style.width) {
  constexpr int least = 200, most = 8000;
  if (width_ < least || width_ > most || (style.height != 0 && (style.height < least || style.height > most)))
    throw std::invalid_argument("--size: a picture is from 200 to 8000 pixels wide and high");
  if (style.even) width_ -= width_ % 2;
  constexpr double usual = 700, smallest = 0.45;  // [px]
  small_ = std::clamp(std::min<double>(width_, style.height > 0 ? 1.5 * style.height : width_) / usual, smallest, 1.0);
  colours_ = body_colours(first);
  name_bodies(first);
  bottom_ = static_cast<int>(small_ * (84 + field_rows() * field_row));
  fit();
  note_scales(first);
  place_notes();
  fit();
  canvas_ = std::make_unique<Canvas>(width_, height_, letters * small_);
}

/// Names from the right, in as many rows next to the time as needed: at most three, fewer in a low picture.
void FramePicture::name_bodies(const Drawing& drawing) {
  const Canvas measure(1, 1, letters * small_);
  const double disc = 24 * small_, gap = 20 * small_, side = rim_width * small_;
  const int room = style_.height > 0 ? static_cast<int>((0.3 * style_.height / small_ - 42) / line_height) : 3;
  const int most_rows = std::clamp(room, 1, 3);
  const double left = side + (style_.timeless ? 0 : measure.width_of("t = 888.888 ms") + 2 * gap), right = width_ - side;
  std::vector<Label> row;
  double x = left;
  int rows = 0;
  const auto end_row = [&] {  // right-aligned
    for (Label& label : row) label.x += right - (x - gap), label.row = rows, labels_.push_back(label);
    row.clear(), x = left, ++rows;
  };
  for (const auto& [owner, colour] : colours_) {
    const double wide = disc + measure.width_of(drawing.owners.at(static_cast<std::size_t>(owner)));
    if (!row.empty() && x + wide > right) end_row();
    if (rows == most_rows) break;
    row.push_back({owner, x, 0});
    x += wide + gap;
  }
  if (!row.empty()) end_row();
  unnamed_ = static_cast<int>(colours_.size() - labels_.size());
  top_ = static_cast<int>(small_ * (42 + line_height * std::max(rows, 1)));
}

/// The scales of lengths and forces, the kinds of forces, and what is drawn enlarged.
void FramePicture::note_scales(const Drawing& drawing) {
  const Canvas measure(1, 1, letters * small_);
  const auto add = [&](Note::Kind kind, const std::string& text, const Colour& colour, double symbol) {
    const double wide = symbol + (symbol > 0 ? 14 * small_ : 0) + measure.width_of(text);
    notes_.push_back({kind, text, colour, symbol, wide});
  };
  const double length = round_length(0.2 * width_ / scale_);
  add(Note::lengths, quantity(length, "m"), ink, length * scale_);
  if (usual_force_ > 0) {
    const double force = round_length(usual_force_);
    add(Note::forces, quantity(force, "N"), ink, force / usual_force_ * arrow_pixels());
    for (std::size_t k = 0; k < givers_.size(); ++k)
      if (givers_[k]) add(Note::words, giver_names[k], colour_of(arrow_palette[k]), 0);
  }
  const auto visible = [&](const PlacedImpact& impact) { return world_.contains(impact.at); };
  if (std::ranges::any_of(impacts_, visible)) add(Note::impacts, "impacts", ink, 2 * impact_size * small_);
  const auto add_times = [&](const char* what, double times) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%s drawn %.3g times", what, times);
    add(Note::words, text.data(), ink, 0);
  };
  if (drawing.exaggeration != 1) add_times("clearance", drawing.exaggeration);
  if (drawing.deformation != 1) add_times("deformation", drawing.deformation);
}

/// Arranges notes in rows; if a low picture has no room for all, the last ones are omitted.
void FramePicture::place_notes() {
  const double gap = 26 * small_, side = rim_width * small_;
  const int room = style_.height > 0 ? static_cast<int>((0.3 * style_.height / small_ - 50) / line_height) : 4;
  double x = side;
  int row = 0;
  for (Note& note : notes_) {
    if (x > side && x + note.width > width_ - side) x = side, ++row;
    note.x = x, note.row = row;
    x += note.width + gap;
  }
  const int rows = std::clamp(row + 1, 1, std::max(room, 1));
  std::erase_if(notes_, [&](const Note& note) { return note.row >= rows; });
  for (Note& note : notes_) note.row = rows - 1 - note.row;  // counted from below
  bottom_ = static_cast<int>(small_ * (50 + line_height * rows + field_rows() * field_row));
}

/// Scales the world to fill the picture. Arrows have lengths in pixels and need room: the scale of the world is reduced for them, at most
/// to least_share of it; then the arrows are shortened.
void FramePicture::fit() {
  constexpr int most = 20;
  constexpr double least_share = 0.6, close = 1.001;
  world_ = asked_, shortened_ = 1;
  const double size = std::max(world_.sizes().maxCoeff(), 1e-9), room = usual_force_ > 0 ? 0.08 : 0.03;
  world_.min().array() -= room * size;
  world_.max().array() += room * size;
  choose_scale();
  const double least = least_share * scale_;
  for (int k = 0; k < most && scale_ > least; ++k) {
    const Eigen::AlignedBox2d before = world_, wide = with_arrows();
    if (before.contains(wide)) break;
    world_ = before.merged(wide);
    const Eigen::Vector2d middle = world_.center();
    world_.min() = middle + close * (world_.min() - middle);  // otherwise the iteration would never end
    world_.max() = middle + close * (world_.max() - middle);
    choose_scale();
  }
  shortened_ = arrow_share();
}

/// The arrow from its foot to its head [px].
Vector2d FramePicture::arrow_of(const DrawnForce& f) const {
  const double size = f.force.norm();
  return usual_force_ > 0 && size > 0 ? Vector2d(std::min(size / usual_force_, 3.0) * arrow_pixels() / size * f.force) : Vector2d(0, 0);
}

Eigen::AlignedBox2d FramePicture::with_arrows() const {
  Eigen::AlignedBox2d out = world_;
  for (const DrawnForce& f : forces_)
    if (world_.contains(f.at)) out.extend(Vector2d(f.at + arrow_of(f) / scale_));
  return out;
}

/// The largest factor of the arrows' lengths, at most 1, with which all arrows with their foot in the picture fit in it.
double FramePicture::arrow_share() const {
  const Eigen::AlignedBox2d shown(Vector2d(0, bottom_), Vector2d(width_, height_ - top_));
  double share = 1;
  for (const DrawnForce& f : forces_) {
    const Vector2d foot = place(f.at), way = arrow_of(f);
    if (!shown.contains(foot)) continue;
    for (const int i : {0, 1}) {
      const double left = way[i] > 0 ? shown.max()[i] - foot[i] : foot[i] - shown.min()[i];
      if (std::abs(way[i]) > left) share = std::min(share, left / std::abs(way[i]));
    }
  }
  return share;
}

/// Also chooses the height if it is not given.
void FramePicture::choose_scale() {
  const int margins = bottom_ + top_, inner = static_cast<int>(width_ - 2 * rim_width * small_);
  const Vector2d sizes = world_.sizes();
  height_ = style_.height;
  if (height_ == 0) {
    const double asked = sizes.y() / sizes.x() * inner + margins;
    const double least = std::max(0.3 * width_, margins + 0.25 * width_);  // the mechanism must be visible
    height_ = static_cast<int>(std::clamp(asked, least, std::max(0.8 * width_, least)));
  }
  if (style_.even) height_ -= height_ % 2;
  scale_ = std::min(inner / sizes.x(), (height_ - margins) / sizes.y());
  if (!(scale_ > 0)) throw std::invalid_argument("--size: the height is too small to draw in");
}

Vector2d FramePicture::place(const Vector2d& world) const {
  return Vector2d(width_ / 2.0, bottom_ + (height_ - bottom_ - top_) / 2.0) + scale_ * (world - world_.center());
}

double FramePicture::arrow_pixels() const { return 0.16 * shortened_ * std::min(width_, height_); }

// Drawing -----------------------------------------------------------------------------------------

void FramePicture::draw(const Drawing& drawing) {
  canvas_->clear();
  for (const Part part : {Part::hatch, Part::guide}) draw_lines(drawing, part);
  if (style_.paths) draw_lines(drawing, Part::trace);
  draw_flexible(drawing);
  for (const Part part : {Part::link, Part::cylinder, Part::spring, Part::joint, Part::bearing, Part::journal}) draw_lines(drawing, part);
  draw_impacts(drawing.t);
  draw_forces(drawing);
  draw_head(drawing);
  draw_foot();
}

void FramePicture::draw_flexible(const Drawing& drawing) {
  for (const DrawnBody& body : drawing.bodies) {
    Eigen::Matrix2Xd at(2, body.points.cols());
    for (Eigen::Index i = 0; i < at.cols(); ++i) at.col(i) = place(body.points.col(i));
    const auto colour = colours_.find(owner_of(drawing, body));
    const Colour own = colour == colours_.end() ? ink : colour->second;
    std::vector<Colour> inside;
    if (!style_.field.empty())
      for (const double value : values(body, style_.field)) inside.push_back(field_colour(range_.share(value)));
    if (inside.empty())
      canvas_->fill(at, body.cells, mix(own, white, 0.65));
    else
      canvas_->fill(at, body.cells, inside);
    canvas_->stroke_outline(at, body.cells, small_ * (inside.empty() ? 4 : 2), inside.empty() ? own : ink);
  }
}

void FramePicture::draw_lines(const Drawing& drawing, Part part) {
  for (const DrawnLine& line : drawing.lines) {
    if (line.part != part) continue;
    std::vector<Vector2d> r;
    for (const Vector2d& p : line.points) r.push_back(place(p));
    if (line.closed) r = rounded(std::move(r));
    switch (part) {
      case Part::hatch: canvas_->stroke(r, line.closed, small_ * 2, mix(ink, white, 0.55)); break;
      case Part::guide: canvas_->stroke(r, line.closed, small_ * 4, mix(ink, white, 0.45)); break;
      case Part::trace: canvas_->stroke(r, line.closed, small_ * 1.6, mix(ink, white, 0.55)); break;
      case Part::spring: canvas_->stroke(r, line.closed, small_ * 3, mix(ink, white, 0.2)); break;
      case Part::cylinder:
        if (line.closed) canvas_->fill(r, mix(ink, white, 0.8));
        canvas_->stroke(r, line.closed, small_ * (line.closed ? 3 : 7), mix(ink, white, line.closed ? 0.2 : 0.45));
        break;
      case Part::link: {
        const auto found = colours_.find(line.owner);
        const Colour colour = found == colours_.end() ? ink : found->second;
        if (line.closed) canvas_->fill(r, mix(colour, white, 0.65));
        if (!line.closed) canvas_->stroke(r, false, small_ * 13, mix(colour, ink, 0.5));
        canvas_->stroke(r, line.closed, small_ * (line.closed ? 4 : 9), colour);
        break;
      }
      case Part::joint:
      case Part::journal:
      case Part::bearing: draw_joint(line, r); break;
    }
  }
}

void FramePicture::draw_joint(const DrawnLine& line, const std::vector<Vector2d>& r) {
  if (r.size() == 1) {
    canvas_->disc(r[0], 8 * small_, ink);
    canvas_->disc(r[0], 5 * small_, white);
    return;
  }
  if (line.closed && line.part != Part::joint) canvas_->fill(r, line.part == Part::journal ? mix(ink, white, 0.7) : white);
  constexpr double pin = 0.1;  // relative to the picture: larger circles are wheels
  if (line.closed && line.part == Part::joint && (r[0] - r[r.size() / 2]).norm() < pin * height_) canvas_->fill(r, white);
  canvas_->stroke(r, line.closed, 3 * small_, ink);
}

/// Arrows longer than three times the usual length are cut there. For couples only the direction is drawn.
void FramePicture::draw_forces(const Drawing& drawing) {
  if (!style_.forces) return;
  for (const DrawnForce& f : drawing.forces) {
    const Colour colour = colour_of(arrow_palette.at(static_cast<std::size_t>(f.giver)));
    const Vector2d at = place(f.at), way = arrow_of(f);
    constexpr double worth_it = 4, share = 0.02;  // [px], of the largest couple
    if (way.norm() > worth_it) canvas_->arrow(at, at + way, 4 * small_, colour);
    if (f.couple != 0 && std::abs(f.couple) > share * largest_couple_) canvas_->turn(at, 26 * small_, f.couple > 0, 3 * small_, colour);
  }
}

/// The area of a point is proportional to the peak force, but visible.
void FramePicture::draw_impacts(double t) {
  double largest = 0;
  for (const PlacedImpact& impact : impacts_) largest = std::max(largest, impact.peak_force);
  for (const PlacedImpact& impact : impacts_) {
    if (impact.t > t) continue;
    const double size = small_ * impact_size * (largest > 0 ? std::max(0.3, std::sqrt(impact.peak_force / largest)) : 0.5);
    canvas_->disc(place(impact.at), size + 1.5 * small_, white);
    canvas_->disc(place(impact.at), size, impact_colour);
  }
}

/// Time and bodies.
void FramePicture::draw_head(const Drawing& drawing) {
  const double w = width_, h = height_, first = h - 52 * small_, side = rim_width * small_;
  canvas_->fill({{0, h - top_}, {w, h - top_}, {w, h}, {0, h}}, white);
  if (!style_.timeless) canvas_->words("t = " + quantity(drawing.t, "s"), side, first, Align::left, ink);
  for (const Label& label : labels_) {
    const Colour& colour = colours_.at(label.owner);
    const double y = first - small_ * line_height * label.row;
    canvas_->disc({label.x + 8 * small_, y + 8 * small_}, 8 * small_, colour);
    canvas_->words(drawing.owners.at(static_cast<std::size_t>(label.owner)), label.x + 24 * small_, y, Align::left, mix(colour, ink, 0.35));
  }
  if (unnamed_ > 0) {
    const bool below = labels_.back().row > 0;
    canvas_->words((below ? "and " : "+ ") + std::to_string(unnamed_) + (below ? " more" : ""), below ? side : w - 2,
                   below ? first - small_ * line_height : first, below ? Align::left : Align::right, mix(ink, white, 0.3));
  }
}

void FramePicture::draw_foot() {
  canvas_->fill({{0, 0}, {1.0 * width_, 0}, {1.0 * width_, 1.0 * bottom_}, {0, 1.0 * bottom_}}, white);
  for (const Note& note : notes_) {
    const double y = small_ * (38 + line_height * note.row), x = note.x, end = x + note.symbol;
    if (note.kind == Note::lengths)
      canvas_->stroke({{x, y + 8 * small_}, {x, y}, {end, y}, {end, y + 8 * small_}}, false, 2.5 * small_, ink);
    if (note.kind == Note::forces) canvas_->arrow({x, y}, {end, y}, 4 * small_, ink);
    if (note.kind == Note::impacts) canvas_->disc({(x + end) / 2, y}, impact_size * small_, impact_colour);
    canvas_->words(note.text, note.symbol > 0 ? end + 14 * small_ : x, y - 6 * small_, Align::left, note.colour);
  }
  if (!style_.field.empty()) draw_field_scale();
}

int FramePicture::field_rows() const { return style_.field.empty() ? 0 : width_ < 600 ? 2 : 1; }

/// The colour scale of a field: its name, least and greatest value; in a narrow picture with the name above.
void FramePicture::draw_field_scale() {
  const std::string& field = style_.field;
  const std::size_t unit = field.rfind(" [");
  const bool has_unit = unit != std::string::npos && field.back() == ']', beside = field_rows() == 1;
  const std::string symbol = has_unit ? field.substr(unit + 2, field.size() - unit - 3) : "";
  const bool from_zero = std::abs(range_.least) < 1e-6 * std::abs(range_.greatest);
  const std::string least = quantity(from_zero ? 0 : range_.least, symbol), greatest = quantity(range_.greatest, symbol);
  constexpr int steps = 256;
  const double side = rim_width * small_, gap = 14 * small_, y = bottom_ - small_ * field_row * field_rows(), high = 18 * small_;
  const double left = beside ? 0.42 * width_ : side + canvas_->width_of(least) + gap;
  const double right = beside ? 0.82 * width_ : width_ - side - canvas_->width_of(greatest) - gap, step = (right - left) / steps;
  for (int i = 0; i < steps; ++i) {
    const double x = left + i * step;  // slight overlaps, so that no paper shows between them
    canvas_->fill({{x, y}, {x + step + 1, y}, {x + step + 1, y + high}, {x, y + high}}, field_colour((i + 0.5) / steps));
  }
  canvas_->words(field.substr(0, has_unit ? unit : field.size()), side, beside ? y : y + 0.8 * small_ * field_row, Align::left, ink);
  canvas_->words(least, left - gap, y, Align::right, ink);
  canvas_->words(greatest, right + gap, y, Align::left, ink);
}

}  // namespace pintle
