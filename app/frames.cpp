#include "app/frames.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include <vtkCellData.h>
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

namespace pintle {

namespace fs = std::filesystem;
using Eigen::Vector2d;

fs::path frame_file(const fs::path& directory, int frame, double at) {
  const fs::path pvd = directory / "mechanism.pvd";
  if (!fs::is_regular_file(pvd)) throw std::runtime_error(pvd.string() + ": no such file");
  const auto root =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  const int count = list ? list->GetNumberOfNestedElements() : 0;
  if (count == 0) throw std::runtime_error(pvd.string() + ": lists no frames");

  int n = frame < 0 ? count + frame : frame;
  if (!std::isnan(at)) {
    const auto distance = [&](int i) {
      return std::abs(std::atof(list->GetNestedElement(i)->GetAttribute("timestep")) - at);
    };
    n = 0;
    for (int i = 1; i < count; ++i) {
      if (distance(i) < distance(n)) n = i;
    }
  }
  if (n < 0 || n >= count) {
    throw std::runtime_error(pvd.string() + ": has " + std::to_string(count) + " frames, 0 to " +
                             std::to_string(count - 1) + "; asked for " +
                             std::to_string(frame));
  }
  return directory / list->GetNestedElement(n)->GetAttribute("file");
}

Drawing read_frame(const fs::path& file) {
  if (!fs::is_regular_file(file)) throw std::runtime_error(file.string() + ": no such file");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  vtkDataArray* part = grid->GetCellData()->GetArray("part");
  vtkDataArray* owner = grid->GetCellData()->GetArray("owner");
  vtkDataArray* force = grid->GetPointData()->GetArray("force [N]");
  vtkFieldData* facts = grid->GetFieldData();
  auto* owners = vtkStringArray::SafeDownCast(facts->GetAbstractArray("owners"));
  vtkDataArray* time = facts->GetArray("TimeValue");
  vtkDataArray* exaggeration = facts->GetArray("clearance exaggeration");
  if (!part || !owner || !force || !owners || !time || !exaggeration) {
    throw std::runtime_error(file.string() + ": is not a frame of pintle");
  }
  Drawing drawing;
  drawing.t = time->GetTuple1(0);
  drawing.exaggeration = exaggeration->GetTuple1(0);
  for (vtkIdType i = 0; i < owners->GetNumberOfValues(); ++i) {
    drawing.owners.push_back(owners->GetValue(i));
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    grid->GetCellPoints(c, ids);
    const auto point = [&](vtkIdType i) {
      const double* r = grid->GetPoint(ids->GetId(i));
      return Vector2d(r[0], r[1]);
    };
    const int kind = static_cast<int>(part->GetTuple1(c)),
              who = static_cast<int>(owner->GetTuple1(c));
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

}  // namespace pintle
