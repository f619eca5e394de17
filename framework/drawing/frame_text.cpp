#include "framework/drawing/frame_text.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <cstdio>
#include <span>
#include <utility>

#include "framework/drawing/palette.h"
#include "framework/drawing/vtk_cell.h"

namespace pintle {

namespace {

const std::array<std::string, 13> part_names{"link",     "joint", "journal",  "bearing",       "spring",       "guide", "trace",
                                             "cylinder", "hatch", "reaction", "contact force", "spring force", "load"};
static_assert(part_names.size() == line_parts + static_cast<int>(Giver::load) + 1);

std::vector<std::string> colour_words(const Drawing& drawing) {
  std::vector<std::string> out;
  for (const std::optional<Rgb>& rgb : drawing.colours) {
    std::array<char, 8> text{};
    if (rgb) std::snprintf(text.data(), text.size(), "#%02x%02x%02x", (*rgb)[0], (*rgb)[1], (*rgb)[2]);
    out.emplace_back(text.data());
  }
  return out;
}

/// Points and cells with their fields, in the order added.
struct LineArrays {
  std::vector<double> places, forces, couples;
  std::vector<std::int32_t> connectivity, offsets, parts, owners;
  std::vector<unsigned char> types;

  explicit LineArrays(const Drawing& drawing) {
    std::size_t n_points = drawing.forces.size();
    for (const DrawnLine& line : drawing.lines) n_points += line.points.size();
    const std::size_t n_cells = drawing.lines.size() + drawing.forces.size();
    for (auto* array : {&places, &forces}) array->reserve(3 * n_points);
    couples.reserve(n_points);
    connectivity.reserve(n_points + n_cells);
    for (auto* array : {&offsets, &parts, &owners}) array->reserve(n_cells);
    types.reserve(n_cells);
  }
  std::int32_t n_points() const { return static_cast<std::int32_t>(couples.size()); }
  void add_point(const Eigen::Vector2d& at, const Eigen::Vector2d& force, double couple) {
    places.insert(places.end(), {at.x(), at.y(), 0});
    forces.insert(forces.end(), {force.x(), force.y(), 0});
    couples.push_back(couple);
  }
  /// Adds a cell of the points added last.
  void add_cell(VtkCell type, std::int32_t first, bool back_to_first, int part, int owner) {
    for (std::int32_t p = first; p < n_points(); ++p) connectivity.push_back(p);
    if (back_to_first) connectivity.push_back(first);
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    types.push_back(type);
    parts.push_back(part);
    owners.push_back(owner);
  }
};

/// Filled lines are polygons, others are polylines.
VtkCell cell_of(const DrawnLine& line) {
  if (line.points.size() == 1) return vtk_vertex;
  const bool solid = line.part == Part::link || line.part == Part::cylinder;
  return line.closed && solid && line.points.size() > 2 ? vtk_polygon : vtk_polyline;
}

LineArrays arrays_of(const Drawing& drawing) {
  LineArrays out(drawing);
  for (const DrawnLine& line : drawing.lines) {
    if (line.points.empty()) continue;
    const std::int32_t first = out.n_points();
    for (const Eigen::Vector2d& at : line.points) out.add_point(at, Eigen::Vector2d::Zero(), 0);
    const VtkCell cell = cell_of(line);
    out.add_cell(cell, first, line.closed && cell == vtk_polyline && line.points.size() > 2, static_cast<int>(line.part), line.owner);
  }
  for (const DrawnForce& f : drawing.forces) {
    out.add_point(f.at, f.force, f.couple);
    out.add_cell(vtk_vertex, out.n_points() - 1, false, line_parts + static_cast<int>(f.giver), f.owner);
  }
  return out;
}

void add_owners(const Drawing& drawing, const LineArrays& arrays, VtuText& vtu) {
  constexpr Rgb grey{96, 96, 96};
  std::vector<std::string> names;
  std::vector<unsigned char> colours;
  for (const std::int32_t owner : arrays.owners) {
    const auto o = static_cast<std::size_t>(owner);
    assert(owner >= 0 && o < drawing.owners.size());
    names.push_back(drawing.owners[o]);
    if (drawing.colours.empty()) continue;
    const Rgb rgb = o < drawing.colours.size() ? body_colour(drawing, o) : grey;
    colours.insert(colours.end(), rgb.begin(), rgb.end());
  }
  vtu.add(VtuText::on_cells, "owner", arrays.owners);
  vtu.add(VtuText::on_cells, "name", names);
  if (!drawing.colours.empty()) {
    vtu.add(VtuText::on_cells, "colour", colours, 3);
    vtu.add(VtuText::of_frame, "colours", colour_words(drawing));
  }
}

/// Columns as tuples; two-dimensional vectors get a third component, zero.
template <class Value>
std::vector<Value> tuples_of(const Eigen::Ref<const Eigen::MatrixXd>& v) {
  const Eigen::Index components = v.rows() == 2 ? 3 : v.rows();
  std::vector<Value> out(static_cast<std::size_t>(components * v.cols()));
  Eigen::Map<Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic>>(out.data(), components, v.cols()).topRows(v.rows()) = v.cast<Value>();
  return out;
}

void add_places(const Eigen::Matrix2Xd& points, VtuText& vtu) { vtu.add(VtuText::places, "Points", tuples_of<double>(points), 3); }

}  // namespace

std::string lines_text(const Drawing& drawing) {
  const LineArrays arrays = arrays_of(drawing);
  VtuText vtu;
  vtu.add_number("TimeValue", drawing.t);
  vtu.add_number("clearance exaggeration", drawing.exaggeration);
  vtu.add(VtuText::of_frame, "parts", part_names);
  vtu.add(VtuText::of_frame, "owners", drawing.owners);
  vtu.add(VtuText::on_points, "force [N]", arrays.forces, 3);
  vtu.add(VtuText::on_points, "couple [N m]", arrays.couples);
  vtu.add(VtuText::on_cells, "part", arrays.parts);
  add_owners(drawing, arrays, vtu);
  vtu.add(VtuText::places, "Points", arrays.places, 3);
  vtu.add(VtuText::cells, "connectivity", arrays.connectivity);
  vtu.add(VtuText::cells, "offsets", arrays.offsets);
  vtu.add(VtuText::cells, "types", arrays.types);
  return vtu.text(arrays.couples.size(), arrays.types.size());
}

PackedCells::PackedCells(const std::vector<Cells>& blocks) {
  std::vector<std::int32_t> nodes, ends;
  std::vector<unsigned char> kinds;
  for (const Cells& block : blocks) {
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
    kinds.insert(kinds.end(), block.size(), vtk_cell(block.shape));
    for (std::size_t c = 0; c < block.size(); ++c) ends.push_back((ends.empty() ? 0 : ends.back()) + nodes_of(block.shape));
  }
  size = kinds.size();
  connectivity = VtuText::pack(std::span(std::as_const(nodes)));
  offsets = VtuText::pack(std::span(std::as_const(ends)));
  types = VtuText::pack(std::span(std::as_const(kinds)));
}

std::string body_text(const DrawnBody& body, double t, double deformation, const PackedCells& cells) {
  VtuText vtu;
  vtu.add_number("TimeValue", t);
  vtu.add_number("deformation exaggeration", deformation);
  vtu.add(VtuText::of_frame, "body", std::array{body.name});
  for (const Field& f : body.fields)
    vtu.add(VtuText::on_points, f.name, tuples_of<float>(f.values), static_cast<int>(f.values.rows() == 2 ? 3 : f.values.rows()));
  add_places(body.points, vtu);
  vtu.add(VtuText::cells, "connectivity", cells.connectivity);
  vtu.add(VtuText::cells, "offsets", cells.offsets);
  vtu.add(VtuText::cells, "types", cells.types);
  return vtu.text(static_cast<std::size_t>(body.points.cols()), cells.size);
}

std::string impacts_text(const Eigen::Matrix2Xd& points, const std::vector<DrawnImpact>& impacts, const std::vector<std::string>& names) {
  std::vector<double> t, approach, force;
  std::vector<std::int32_t> vertices, ends;
  for (const DrawnImpact& impact : impacts) {
    t.push_back(impact.t);
    approach.push_back(impact.approach);
    force.push_back(impact.peak_force);
    vertices.push_back(static_cast<std::int32_t>(vertices.size()));
    ends.push_back(static_cast<std::int32_t>(vertices.size()));
  }
  VtuText vtu;
  vtu.add(VtuText::on_points, "time [s]", t);
  vtu.add(VtuText::on_points, "approach speed [m/s]", approach);
  vtu.add(VtuText::on_points, "peak force [N]", force);
  vtu.add(VtuText::on_cells, "name", names);
  add_places(points, vtu);
  vtu.add(VtuText::cells, "connectivity", vertices);
  vtu.add(VtuText::cells, "offsets", ends);
  vtu.add(VtuText::cells, "types", std::vector<unsigned char>(impacts.size(), vtk_vertex));
  return vtu.text(impacts.size(), impacts.size());
}

}  // namespace pintle
