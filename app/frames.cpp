#include "app/frames.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include "framework/scene/colour.h"

namespace pintle {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

struct Frame {
  double t;
  FrameFiles files;
};

/// What a collection lists, frame by frame: a part 0 begins one.
std::vector<Frame> frames_of(const fs::path& pvd) {
  if (!fs::is_regular_file(pvd)) throw std::runtime_error(pvd.string() + ": no such file");
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  std::vector<Frame> frames;
  for (int i = 0; list && i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = list->GetNestedElement(i);
    const char *t = entry->GetAttribute("timestep"), *part = entry->GetAttribute("part"), *file = entry->GetAttribute("file");
    if (!t || !file) continue;
    const fs::path path = pvd.parent_path() / file;
    if (!part || std::atoi(part) == 0)
      frames.push_back({std::atof(t), {path, {}}});
    else if (!frames.empty())
      frames.back().files.bodies.push_back(path);
  }
  if (frames.empty()) throw std::runtime_error(pvd.string() + ": lists no frames");
  return frames;
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw std::runtime_error(file.string() + ": no such file");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

[[noreturn]] void not_ours(const fs::path& file) { throw std::runtime_error(file.string() + ": is not a frame of pintle"); }

CellShape shape_of(int vtk_cell, const fs::path& file) {
  switch (vtk_cell) {
    case VTK_LINE: return CellShape::line2;
    case VTK_QUADRATIC_EDGE: return CellShape::line3;
    case VTK_TRIANGLE: return CellShape::triangle3;
    case VTK_QUADRATIC_TRIANGLE: return CellShape::triangle6;
    case VTK_QUAD: return CellShape::quadrilateral4;
    case VTK_QUADRATIC_QUAD: return CellShape::quadrilateral8;
    case VTK_BIQUADRATIC_QUAD: return CellShape::quadrilateral9;
  }
  not_ours(file);
}

std::vector<Cells> cells_of(vtkUnstructuredGrid* grid, const fs::path& file) {
  std::vector<Cells> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    const CellShape shape = shape_of(grid->GetCellType(c), file);
    if (cells.empty() || cells.back().shape != shape) cells.push_back({shape, {}, {}});
    grid->GetCellPoints(c, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) cells.back().nodes.push_back(static_cast<int>(ids->GetId(k)));
    cells.back().numbers.push_back(static_cast<long>(c) + 1);
  }
  return cells;
}

/// @param deformation  set to what the file says
DrawnBody read_body(const fs::path& file, double& deformation) {
  const auto grid = read_grid(file);
  auto* name = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("body"));
  vtkDataArray* exaggeration = grid->GetFieldData()->GetArray("deformation exaggeration");
  if (!name || name->GetNumberOfValues() == 0 || !exaggeration) not_ours(file);
  deformation = exaggeration->GetTuple1(0);
  DrawnBody body{name->GetValue(0), Eigen::Matrix2Xd(2, grid->GetNumberOfPoints()), cells_of(grid, file), {}};
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) body.points.col(i) = Vector2d(grid->GetPoint(i)[0], grid->GetPoint(i)[1]);
  for (int f = 0; f < grid->GetPointData()->GetNumberOfArrays(); ++f) {
    vtkDataArray* array = grid->GetPointData()->GetArray(f);
    if (!array) continue;
    const int rows = array->GetNumberOfComponents() == 3 ? 2 : array->GetNumberOfComponents();
    Field field{array->GetName(), Eigen::MatrixXd(rows, array->GetNumberOfTuples())};
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
      for (int k = 0; k < rows; ++k) field.values(k, i) = array->GetComponent(i, k);
    body.fields.push_back(std::move(field));
  }
  return body;
}

Drawing read_lines(const fs::path& file) {
  const auto grid = read_grid(file);
  vtkDataArray* part = grid->GetCellData()->GetArray("part");
  vtkDataArray* owner = grid->GetCellData()->GetArray("owner");
  vtkDataArray* force = grid->GetPointData()->GetArray("force [N]");
  vtkFieldData* facts = grid->GetFieldData();
  auto* owners = vtkStringArray::SafeDownCast(facts->GetAbstractArray("owners"));
  vtkDataArray* time = facts->GetArray("TimeValue");
  vtkDataArray* exaggeration = facts->GetArray("clearance exaggeration");
  if (!part || !owner || !force || !owners || !time || !exaggeration) {
    not_ours(file);
  }
  Drawing drawing;
  drawing.t = time->GetTuple1(0);
  drawing.exaggeration = exaggeration->GetTuple1(0);
  for (vtkIdType i = 0; i < owners->GetNumberOfValues(); ++i) {
    drawing.owners.push_back(owners->GetValue(i));
  }
  if (auto* colours = vtkStringArray::SafeDownCast(facts->GetAbstractArray("colours")))
    for (vtkIdType i = 0; i < colours->GetNumberOfValues(); ++i) drawing.colours.push_back(rgb_of(colours->GetValue(i)));
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    grid->GetCellPoints(c, ids);
    const auto point = [&](vtkIdType i) {
      const double* r = grid->GetPoint(ids->GetId(i));
      return Vector2d(r[0], r[1]);
    };
    const int kind = static_cast<int>(part->GetTuple1(c)), who = static_cast<int>(owner->GetTuple1(c));
    if (kind > static_cast<int>(Part::trace)) {
      const double* f = force->GetTuple3(ids->GetId(0));
      drawing.forces.push_back({point(0), {f[0], f[1]}, who});
      continue;
    }
    DrawnLine line{static_cast<Part>(kind), who, false, {}};
    vtkIdType n = ids->GetNumberOfIds();
    line.closed = n > 2 && ids->GetId(0) == ids->GetId(n - 1);
    if (line.closed) --n;
    for (vtkIdType i = 0; i < n; ++i) line.points.push_back(point(i));
    drawing.lines.push_back(std::move(line));
  }
  return drawing;
}

}  // namespace

FrameFiles frame_files(const fs::path& directory, int frame, double at) {
  const fs::path pvd = directory / "mechanism.pvd";
  const std::vector<Frame> frames = frames_of(pvd);
  const int count = static_cast<int>(frames.size());
  int n = frame < 0 ? count + frame : frame;
  if (!std::isnan(at)) {
    const auto nearest = std::min_element(frames.begin(), frames.end(),
                                          [&](const Frame& a, const Frame& b) { return std::abs(a.t - at) < std::abs(b.t - at); });
    n = static_cast<int>(nearest - frames.begin());
  }
  if (n < 0 || n >= count) {
    throw std::runtime_error(pvd.string() + ": has " + std::to_string(count) + " frames, 0 to " + std::to_string(count - 1) +
                             "; asked for " + std::to_string(frame));
  }
  return frames[static_cast<std::size_t>(n)].files;
}

Drawing read_frame(const FrameFiles& files) {
  Drawing drawing = read_lines(files.lines);
  for (const fs::path& file : files.bodies) drawing.bodies.push_back(read_body(file, drawing.deformation));
  return drawing;
}

}  // namespace pintle
