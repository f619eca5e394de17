#include "app/frames.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

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

#include "framework/output/results_directory.h"
#include "framework/scene/colour.h"

namespace pintle {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

/// VTK's readers do not say why a file cannot be read. @throws std::runtime_error
void require_readable(const fs::path& file) {
  if (::access(file.c_str(), R_OK) != 0)
    throw std::runtime_error(file.string() + ": cannot be read (" + std::strerror(errno) + "); check its permissions");
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw std::runtime_error(file.string() + ": no such file");
  require_readable(file);
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

Field field_of(vtkDataArray* array) {
  const int rows = array->GetNumberOfComponents() == 3 ? 2 : array->GetNumberOfComponents();
  Field field{array->GetName(), Eigen::MatrixXd(rows, array->GetNumberOfTuples())};
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int k = 0; k < rows; ++k) field.values(k, i) = array->GetComponent(i, k);
  return field;
}

DrawnBody body_of(vtkUnstructuredGrid* grid, const std::string& name, const fs::path& file) {
  DrawnBody body{name, Eigen::Matrix2Xd(2, grid->GetNumberOfPoints()), cells_of(grid, file), {}};
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) body.points.col(i) = Vector2d(grid->GetPoint(i)[0], grid->GetPoint(i)[1]);
  for (int f = 0; f < grid->GetPointData()->GetNumberOfArrays(); ++f)
    if (vtkDataArray* array = grid->GetPointData()->GetArray(f)) body.fields.push_back(field_of(array));
  return body;
}

/// Draws the deformation of a body with the factor `wanted` instead of `drawn`.
void deform(DrawnBody& body, double drawn, double wanted) {
  for (const Field& field : body.fields)
    if (field.name == "displacement [m]") body.points += (wanted - drawn) * field.values;
}

void add_paths(vtkUnstructuredGrid* grid, Drawing& out) {
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    grid->GetCellPoints(c, ids);
    DrawnLine path{Part::trace, 0, false, {}};
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
      path.points.emplace_back(grid->GetPoint(ids->GetId(i))[0], grid->GetPoint(ids->GetId(i))[1]);
    out.lines.push_back(std::move(path));
  }
}

/// A flexible body, or the paths of points; impacts are read by read_impacts.
void add_other(const fs::path& file, std::optional<double> deformation, Drawing& out) {
  const auto grid = read_grid(file);
  vtkFieldData* facts = grid->GetFieldData();
  auto* name = vtkStringArray::SafeDownCast(facts->GetAbstractArray("body"));
  vtkDataArray* exaggeration = facts->GetArray("deformation exaggeration");
  if (grid->GetCellData()->GetArray("part")) return add_paths(grid, out);
  if (grid->GetPointData()->GetArray("peak force [N]")) return;
  if (!name || name->GetNumberOfValues() == 0 || !exaggeration) not_ours(file);
  out.deformation = exaggeration->GetTuple1(0);
  out.bodies.push_back(body_of(grid, name->GetValue(0), file));
  if (deformation) deform(out.bodies.back(), out.deformation, *deformation), out.deformation = *deformation;
}

Drawing read_lines(const fs::path& file) {
  const auto grid = read_grid(file);
  vtkDataArray* couple = grid->GetPointData()->GetArray("couple [N m]");
  vtkDataArray* part = grid->GetCellData()->GetArray("part");
  vtkDataArray* owner = grid->GetCellData()->GetArray("owner");
  vtkDataArray* force = grid->GetPointData()->GetArray("force [N]");
  vtkFieldData* facts = grid->GetFieldData();
  auto* owners = vtkStringArray::SafeDownCast(facts->GetAbstractArray("owners"));
  vtkDataArray* time = facts->GetArray("TimeValue");
  vtkDataArray* exaggeration = facts->GetArray("clearance exaggeration");
  if (!part || !owner || !force || !couple || !owners || !time || !exaggeration) not_ours(file);
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
    if (kind >= line_parts) {
      const double* f = force->GetTuple3(ids->GetId(0));
      drawing.forces.push_back({point(0), {f[0], f[1]}, who, static_cast<Giver>(kind - line_parts), couple->GetTuple1(ids->GetId(0))});
      continue;
    }
    DrawnLine line{static_cast<Part>(kind), who, false, {}};
    vtkIdType n = ids->GetNumberOfIds();
    const bool repeated = n > 2 && ids->GetId(0) == ids->GetId(n - 1);
    line.closed = repeated || grid->GetCellType(c) == VTK_POLYGON;
    if (repeated) --n;
    for (vtkIdType i = 0; i < n; ++i) line.points.push_back(point(i));
    drawing.lines.push_back(std::move(line));
  }
  return drawing;
}

/// The frames of a run that was killed before it could list them: frames/00012.vtu, with its bodies in frames/rod_00012.vtu. Each file is
/// complete.
std::vector<FrameFiles> unlisted_frames(const fs::path& folder) {
  std::map<long, FrameFiles> out;
  std::vector<std::pair<long, fs::path>> bodies;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    if (entry.path().extension() != ".vtu") continue;
    const std::string stem = entry.path().stem().string();
    const std::size_t after = stem.find_last_not_of("0123456789") + 1;  // 0: digits only
    if (after == stem.size()) continue;
    const long number = std::atol(stem.c_str() + after);
    if (after == 0)
      out[number] = {read_lines(entry.path()).t, entry.path(), {}};
    else
      bodies.emplace_back(number, entry.path());
  }
  std::ranges::sort(bodies);
  for (const auto& [number, file] : bodies)
    if (const auto frame = out.find(number); frame != out.end()) frame->second.others.push_back(file);
  std::vector<FrameFiles> frames;
  for (auto& [number, files] : out) frames.push_back(std::move(files));
  if (!bodies.empty() && frames.size() > 1) frames.pop_back();  // the files of its bodies may be missing
  return frames;
}

}  // namespace

std::vector<FrameFiles> frames_of(const fs::path& directory) {
  const fs::path pvd = directory / "mechanism.pvd";
  if (!fs::is_directory(directory)) throw std::runtime_error(directory.string() + ": " + no_such_folder(directory));
  if (!fs::is_regular_file(pvd)) {
    std::vector<FrameFiles> kept = unlisted_frames(directory / "frames");
    if (kept.empty()) {
      const std::string why = why_without("frames", directory);
      throw std::runtime_error(directory.string() + ": holds no frames (mechanism.pvd)" +
                               (why.empty() ? "; run its scene again with --set output.frames=100" : ": " + why));
    }
    std::cerr << directory.string()
              << (is_being_filled(directory) ? ": the run is still going on; so far its frames" : ": the run did not finish; its frames")
              << " end at " << kept.back().t << " s\n";
    return kept;
  }
  require_readable(pvd);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  std::vector<FrameFiles> frames;
  for (int i = 0; list && i < list->GetNumberOfNestedElements(); ++i) {  // part 0 begins a frame
    vtkXMLDataElement* entry = list->GetNestedElement(i);
    const char *t = entry->GetAttribute("timestep"), *part = entry->GetAttribute("part"), *file = entry->GetAttribute("file");
    if (!t || !file) continue;
    const fs::path path = directory / file;
    if (!part || std::atoi(part) == 0)
      frames.push_back({std::atof(t), path, {}});
    else if (!frames.empty())
      frames.back().others.push_back(path);
  }
  if (frames.empty()) throw std::runtime_error(pvd.string() + ": lists no frames");
  return frames;
}

Drawing read_frame(const FrameFiles& files, std::optional<double> deformation) {
  Drawing drawing = read_lines(files.lines);
  for (const fs::path& file : files.others) add_other(file, deformation, drawing);
  return drawing;
}

std::vector<PlacedImpact> read_impacts(const FrameFiles& files) {
  std::vector<PlacedImpact> out;
  if (files.others.empty()) return out;
  const auto grid = read_grid(files.others.back());
  vtkDataArray* force = grid->GetPointData()->GetArray("peak force [N]");
  vtkDataArray* time = grid->GetPointData()->GetArray("time [s]");
  for (vtkIdType i = 0; force && time && i < grid->GetNumberOfPoints(); ++i) {
    const double* r = grid->GetPoint(i);
    out.push_back({{r[0], r[1]}, time->GetTuple1(i), force->GetTuple1(i)});
  }
  return out;
}

DrawnBody read_body(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  require_readable(file);
  if (reader->CanReadFile(file.c_str()) == 0) throw std::runtime_error(file.string() + ": is not a .vtu file that can be read");
  const auto grid = read_grid(file);
  DrawnBody body = body_of(grid, file.stem().string(), file);
  vtkNew<vtkIdList> ids;
  for (int f = 0; f < grid->GetCellData()->GetNumberOfArrays(); ++f) {
    vtkDataArray* array = grid->GetCellData()->GetArray(f);
    if (!array) continue;
    const Field of_cells = field_of(array);
    Field mean{of_cells.name, Eigen::MatrixXd::Zero(of_cells.values.rows(), grid->GetNumberOfPoints())};
    Eigen::RowVectorXd count = Eigen::RowVectorXd::Zero(grid->GetNumberOfPoints());
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
      grid->GetCellPoints(c, ids);
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
        mean.values.col(ids->GetId(k)) += of_cells.values.col(c), count[ids->GetId(k)] += 1;
    }
    for (Eigen::Index i = 0; i < count.size(); ++i) mean.values.col(i) /= std::max(count[i], 1.0);
    body.fields.push_back(std::move(mean));
  }
  return body;
}

}  // namespace pintle
