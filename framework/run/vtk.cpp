#include "framework/run/vtk.h"

#include <array>
#include <cassert>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "framework/run/text.h"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

namespace pintle {

namespace {

namespace fs = std::filesystem;

constexpr std::array part_names{"link",   "joint",  "journal", "bearing",
                                "spring", "guide", "trace",   "force"};
constexpr int force_part = static_cast<int>(Part::trace) + 1;
static_assert(part_names.size() == force_part + 1);

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw std::runtime_error(path.string() + ": cannot be written (" + why + ")");
}

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

vtkNew<vtkUnstructuredGrid> grid_of(const Drawing& drawing) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> force;
  force->SetName("force [N]");
  force->SetNumberOfComponents(3);
  vtkNew<vtkIntArray> part, owner;
  part->SetName("part");
  owner->SetName("owner");

  vtkNew<vtkUnstructuredGrid> grid;
  grid->AllocateExact(static_cast<vtkIdType>(drawing.lines.size() + drawing.forces.size()), 2);
  const auto add_point = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& f) {
    force->InsertNextTuple3(f.x(), f.y(), 0);
    return points->InsertNextPoint(at.x(), at.y(), 0);
  };
  const auto add_cell = [&](int type, const std::vector<vtkIdType>& ids, int p, int o) {
    assert(o >= 0 && o < static_cast<int>(drawing.owners.size()));
    grid->InsertNextCell(type, static_cast<vtkIdType>(ids.size()), ids.data());
    part->InsertNextValue(p);
    owner->InsertNextValue(o);
  };

  std::vector<vtkIdType> ids;
  for (const DrawnLine& line : drawing.lines) {
    ids.clear();
    for (const auto& r : line.points) ids.push_back(add_point(r, Eigen::Vector2d::Zero()));
    if (ids.empty()) continue;
    const int type = ids.size() == 1 ? VTK_VERTEX : VTK_POLY_LINE;
    if (line.closed && ids.size() > 2) ids.push_back(ids.front());
    add_cell(type, ids, static_cast<int>(line.part), line.owner);
  }
  for (const DrawnForce& f : drawing.forces) {
    add_cell(VTK_VERTEX, {add_point(f.at, f.force)}, force_part, f.owner);
  }

  grid->SetPoints(points);
  grid->GetPointData()->AddArray(force);
  grid->GetCellData()->AddArray(part);
  grid->GetCellData()->AddArray(owner);
  grid->GetFieldData()->AddArray(number("TimeValue", drawing.t));
  grid->GetFieldData()->AddArray(number("clearance exaggeration", drawing.exaggeration));
  grid->GetFieldData()->AddArray(strings("parts", part_names));
  grid->GetFieldData()->AddArray(strings("owners", drawing.owners));
  return grid;
}

void write_vtu(const fs::path& path, vtkUnstructuredGrid* grid) {
  // To a string, so that VTK touches no file and prints nothing when one cannot be written.
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputDataObject(grid);
  writer->SetDataModeToAppended();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) fail(path, "VTK could not encode it");
  write_text(path, writer->GetOutputString());
}

vtkNew<vtkDoubleArray> array_of(const Field& field) {
  const Eigen::MatrixXd& v = field.values;
  const int rows = static_cast<int>(v.rows()), components = rows == 2 ? 3 : rows;
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(v.cols());
  for (Eigen::Index i = 0; i < v.cols(); ++i)
    for (int k = 0; k < components; ++k) array->SetComponent(i, k, k < rows ? v(k, i) : 0);
  return array;
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

}  // namespace

void write_grid(const fs::path& path, const Eigen::Matrix2Xd& at, const std::vector<Cells>& cells,
                const std::vector<Field>& on_points, const std::vector<Field>& on_cells, double t) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(at.cols());
  for (Eigen::Index i = 0; i < at.cols(); ++i) points->SetPoint(i, at(0, i), at(1, i), 0);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  std::size_t count = 0;
  for (const Cells& block : cells) count += block.size();
  grid->AllocateEstimate(static_cast<vtkIdType>(count), 9);
  for (const Cells& block : cells) {
    const auto n = static_cast<std::size_t>(nodes_of(block.shape));
    for (std::size_t c = 0; c < block.size(); ++c) {
      std::array<vtkIdType, 9> ids;
      std::copy_n(block.nodes.begin() + static_cast<std::ptrdiff_t>(c * n), n, ids.begin());
      grid->InsertNextCell(vtk_cell(block.shape), static_cast<vtkIdType>(n), ids.data());
    }
  }
  for (const Field& f : on_points) grid->GetPointData()->AddArray(array_of(f));
  for (const Field& f : on_cells) grid->GetCellData()->AddArray(array_of(f));
  grid->GetFieldData()->AddArray(number("TimeValue", t));
  write_vtu(path, grid);
}

void write_collection(const fs::path& path, const std::vector<std::pair<double, std::string>>& frames) {
  std::string pvd =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const auto& [t, file] : frames) {
    pvd += "    <DataSet timestep=\"";
    append_number(pvd, t);
    pvd += "\" part=\"0\" file=\"" + file + "\"/>\n";
  }
  pvd += "  </Collection>\n</VTKFile>\n";
  write_text(path, pvd);
}

FrameWriter::FrameWriter(fs::path directory) : directory_(std::move(directory)) {
  std::error_code error;
  const fs::path frames = directory_ / "frames";
  fs::create_directories(frames, error);
  if (error) fail(frames, error.message());
}

void FrameWriter::add(const Drawing& drawing) {
  std::array<char, 32> name;
  std::snprintf(name.data(), name.size(), "frames/%05zu.vtu", frames_.size());
  write_vtu(directory_ / name.data(), grid_of(drawing));
  frames_.emplace_back(drawing.t, name.data());
}

void FrameWriter::finish() {
  write_collection(directory_ / "mechanism.pvd", frames_);
}

}  // namespace pintle
