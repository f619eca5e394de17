#include "framework/drawing/vtk_encoder.h"

#include <array>
#include <cassert>
#include <cstdio>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace pintle {

namespace {

constexpr std::array part_names{"link",     "joint", "journal",  "bearing",       "spring",       "guide", "trace",
                                "cylinder", "hatch", "reaction", "contact force", "spring force", "load"};
static_assert(part_names.size() == line_parts + static_cast<int>(Giver::load) + 1);

template <class Names>
vtkNew<vtkStringArray> strings(const char* name, const Names& values) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const auto& value : values) array->InsertNextValue(value);
  return array;
}

vtkNew<vtkDoubleArray> number(const char* name, double value) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  return array;
}

std::vector<std::string> colour_words(const Drawing& drawing) {
  std::vector<std::string> out;
  for (const std::optional<Rgb>& rgb : drawing.colours) {
    std::array<char, 8> text{};
    if (rgb) std::snprintf(text.data(), text.size(), "#%02x%02x%02x", (*rgb)[0], (*rgb)[1], (*rgb)[2]);
    out.emplace_back(text.data());
  }
  return out;
}

vtkNew<vtkUnsignedCharArray> cell_colours(const Drawing& drawing, vtkIntArray* owner) {
  constexpr Rgb grey{96, 96, 96};
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("colour");
  array->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < owner->GetNumberOfValues(); ++i) {
    const auto o = static_cast<std::size_t>(owner->GetValue(i));
    const Rgb rgb = o < drawing.colours.size() ? drawing.colours[o].value_or(grey) : grey;
    array->InsertNextTypedTuple(rgb.data());
  }
  return array;
}

/// What is filled is a polygon, other lines are polylines.
int cell_type(const DrawnLine& line) {
  if (line.points.size() == 1) return VTK_VERTEX;
  const bool solid = line.part == Part::link || line.part == Part::cylinder;
  return line.closed && solid && line.points.size() > 2 ? VTK_POLYGON : VTK_POLY_LINE;
}

vtkNew<vtkUnstructuredGrid> lines_of(const Drawing& drawing) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> force, couple;
  force->SetName("force [N]");
  force->SetNumberOfComponents(3);
  couple->SetName("couple [N m]");
  vtkNew<vtkIntArray> part, owner;
  part->SetName("part");
  owner->SetName("owner");
  vtkNew<vtkStringArray> name;
  name->SetName("name");

  vtkNew<vtkUnstructuredGrid> grid;
  grid->AllocateExact(static_cast<vtkIdType>(drawing.lines.size() + drawing.forces.size()), 2);
  const auto add_point = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& f, double turning) {
    force->InsertNextTuple3(f.x(), f.y(), 0);
    couple->InsertNextValue(turning);
    return points->InsertNextPoint(at.x(), at.y(), 0);
  };
  const auto add_cell = [&](int type, const std::vector<vtkIdType>& ids, int p, int o) {
    assert(o >= 0 && o < static_cast<int>(drawing.owners.size()));
    grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    part->InsertNextValue(p);
    owner->InsertNextValue(o);
    name->InsertNextValue(drawing.owners[static_cast<std::size_t>(o)]);
  };

  std::vector<vtkIdType> ids;
  for (const DrawnLine& line : drawing.lines) {
    ids.clear();
    for (const auto& r : line.points) ids.push_back(add_point(r, Eigen::Vector2d::Zero(), 0));
    if (ids.empty()) continue;
    const int type = cell_type(line);
    if (line.closed && type == VTK_POLY_LINE && ids.size() > 2) ids.push_back(ids.front());
    add_cell(type, ids, static_cast<int>(line.part), line.owner);
  }
  for (const DrawnForce& f : drawing.forces) {
    add_cell(VTK_VERTEX, {add_point(f.at, f.force, f.couple)}, line_parts + static_cast<int>(f.giver), f.owner);
  }

  grid->SetPoints(points);
  grid->GetPointData()->AddArray(force);
  grid->GetPointData()->AddArray(couple);
  grid->GetCellData()->AddArray(part);
  grid->GetCellData()->AddArray(owner);
  grid->GetCellData()->AddArray(name);
  if (!drawing.colours.empty()) {
    grid->GetCellData()->AddArray(cell_colours(drawing, owner));
    grid->GetFieldData()->AddArray(strings("colours", colour_words(drawing)));
  }
  grid->GetFieldData()->AddArray(number("TimeValue", drawing.t));
  grid->GetFieldData()->AddArray(number("clearance exaggeration", drawing.exaggeration));
  grid->GetFieldData()->AddArray(strings("parts", part_names));
  grid->GetFieldData()->AddArray(strings("owners", drawing.owners));
  return grid;
}

/// For whom a file is packed: `small` by zlib, which most readers know; `fast` by LZ4, a tenth of
/// the time for half as much again.
enum class Packing { small, fast };

std::string text_of(vtkUnstructuredGrid* grid, Packing packing) {
  // To a string, so that VTK touches no file and prints nothing when one cannot be written.
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputDataObject(grid);
  writer->SetDataModeToAppended();
  if (packing == Packing::fast) {
    writer->SetCompressorTypeToLZ4();
    writer->EncodeAppendedDataOff();
  } else {
    writer->SetCompressorTypeToZLib();
  }
  writer->WriteToOutputStringOn();
  return writer->Write() == 0 ? std::string() : writer->GetOutputString();
}

/// Columns as tuples; vectors of the plane get a third component, zero.
template <class Array>
vtkNew<Array> array_of(const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& v) {
  using Value = typename Array::ValueType;
  const int components = static_cast<int>(v.rows() == 2 ? 3 : v.rows());
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(v.cols());
  Eigen::Map<Eigen::Matrix<Value, Eigen::Dynamic, Eigen::Dynamic>> to(array->GetPointer(0), components, v.cols());
  to.topRows(v.rows()) = v.cast<Value>();
  to.bottomRows(components - v.rows()).setZero();
  return array;
}

vtkNew<vtkPoints> points_at(const Eigen::Matrix2Xd& at) {
  vtkNew<vtkPoints> points;
  points->SetData(array_of<vtkDoubleArray>("Points", at));
  return points;
}

int vtk_cell(CellShape shape) {
  switch (shape) {
    case CellShape::line2: return VTK_LINE;
    case CellShape::line3: return VTK_QUADRATIC_EDGE;
    case CellShape::triangle3: return VTK_TRIANGLE;
    case CellShape::triangle6: return VTK_QUADRATIC_TRIANGLE;
    case CellShape::quadrilateral4: return VTK_QUAD;
    case CellShape::quadrilateral8: return VTK_QUADRATIC_QUAD;
    case CellShape::quadrilateral9: return VTK_BIQUADRATIC_QUAD;
  }
  return VTK_EMPTY_CELL;
}

void set_cells(vtkUnstructuredGrid* grid, const std::vector<Cells>& blocks) {
  vtkNew<vtkCellArray> cells;
  cells->Use32BitStorage();
  vtkNew<vtkUnsignedCharArray> types;
  for (const Cells& block : blocks) {
    const auto n = static_cast<std::size_t>(nodes_of(block.shape));
    const auto type = static_cast<unsigned char>(vtk_cell(block.shape));
    for (std::size_t c = 0; c < block.size(); ++c) {
      cells->InsertNextCell(static_cast<int>(n));
      for (std::size_t k = 0; k < n; ++k) cells->InsertCellPoint(block.nodes[c * n + k]);
      types->InsertNextValue(type);
    }
  }
  grid->SetCells(types, cells);
}

std::string encode_lines(const Drawing& drawing) { return text_of(lines_of(drawing), Packing::small); }

std::string encode_impacts(const Eigen::Matrix2Xd& at, const std::vector<DrawnImpact>& impacts, const std::vector<std::string>& names) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points_at(at));
  grid->AllocateExact(at.cols(), 1);
  vtkNew<vtkDoubleArray> t, approach, force;
  t->SetName("time [s]");
  approach->SetName("approach speed [m/s]");
  force->SetName("peak force [N]");
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const auto point = static_cast<vtkIdType>(k);
    grid->InsertNextCell(VTK_VERTEX, 1, &point);
    t->InsertNextValue(impacts[k].t);
    approach->InsertNextValue(impacts[k].approach);
    force->InsertNextValue(impacts[k].peak_force);
  }
  for (vtkDoubleArray* const array : {t.Get(), approach.Get(), force.Get()}) grid->GetPointData()->AddArray(array);
  grid->GetCellData()->AddArray(strings("name", names));
  return text_of(grid, Packing::small);
}

std::string encode_grid(const Eigen::Matrix2Xd& at, const std::vector<Cells>& cells, const std::vector<Field>& on_points,
                        const std::vector<Field>& on_cells, double t) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points_at(at));
  set_cells(grid, cells);
  for (const Field& f : on_points) grid->GetPointData()->AddArray(array_of<vtkDoubleArray>(f.name, f.values));
  for (const Field& f : on_cells) grid->GetCellData()->AddArray(array_of<vtkDoubleArray>(f.name, f.values));
  grid->GetFieldData()->AddArray(number("TimeValue", t));
  return text_of(grid, Packing::small);
}

std::string encode_body(const DrawnBody& body, double t, double deformation, std::shared_ptr<void>& kept) {
  if (!kept) {
    const auto cells = std::make_shared<vtkNew<vtkUnstructuredGrid>>();
    set_cells(*cells, body.cells);
    kept = cells;
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->ShallowCopy(*static_cast<vtkNew<vtkUnstructuredGrid>*>(kept.get()));
  grid->SetPoints(points_at(body.points));
  for (const Field& f : body.fields) grid->GetPointData()->AddArray(array_of<vtkFloatArray>(f.name, f.values));
  grid->GetFieldData()->AddArray(number("TimeValue", t));
  grid->GetFieldData()->AddArray(number("deformation exaggeration", deformation));
  grid->GetFieldData()->AddArray(strings("body", std::array{body.name}));
  return text_of(grid, Packing::fast);
}

}  // namespace

extern "C" [[gnu::visibility("default")]] const VtkEncoder* pintle_vtk() {
  static constexpr VtkEncoder table{PINTLE_VERSION, encode_lines, encode_impacts, encode_grid, encode_body};
  return &table;
}

}  // namespace pintle
