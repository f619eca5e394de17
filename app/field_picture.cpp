#include "app/field_picture.h"

#include <stdexcept>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDataSetMapper.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "app/canvas.h"
#include "app/png.h"

namespace pintle {

namespace {

std::string names(vtkFieldData* data) {
  std::string out;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i) out += std::string(out.empty() ? "" : ", ") + data->GetArrayName(i);
  return out;
}

vtkNew<vtkLookupTable> colours(vtkDataArray* values) {
  vtkNew<vtkLookupTable> table;
  constexpr int steps = 256;
  table->SetNumberOfTableValues(steps);
  if (values->GetNumberOfComponents() > 1) table->SetVectorModeToMagnitude();
  double range[2];
  values->GetRange(range, values->GetNumberOfComponents() > 1 ? -1 : 0);
  table->SetTableRange(range);
  for (int i = 0; i < steps; ++i) {
    const Colour c = field_colour(i / (steps - 1.0));
    table->SetTableValue(i, c.x(), c.y(), c.z());
  }
  return table;
}

/// The values of a field on points or else on cells.
struct FieldValues {
  vtkDataArray* values;
  bool on_cells;
};
FieldValues field_of(vtkUnstructuredGrid* grid, const std::string& name, const std::filesystem::path& file) {
  if (vtkDataArray* values = grid->GetPointData()->GetArray(name.c_str())) return {values, false};
  if (vtkDataArray* values = grid->GetCellData()->GetArray(name.c_str())) return {values, true};
  throw std::runtime_error(file.string() + ": has no field \"" + name + "\"; it has " + names(grid->GetPointData()) + " on points, " +
                           names(grid->GetCellData()) + " on cells");
}

vtkNew<vtkActor> painted(vtkUnstructuredGrid* grid, const std::string& field, bool on_cells, vtkLookupTable* table) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(grid);
  surface->SetNonlinearSubdivisionLevel(2);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  if (on_cells)
    mapper->SetScalarModeToUseCellFieldData();
  else
    mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray(field.c_str());
  mapper->SetLookupTable(table);
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> body;
  body->SetMapper(mapper);
  body->GetProperty()->LightingOff();
  return body;
}

vtkNew<vtkScalarBarActor> scale_of(vtkLookupTable* table, const std::string& field, int font_size) {
  vtkNew<vtkScalarBarActor> scale;
  scale->SetLookupTable(table);
  scale->SetTitle(field.c_str());
  scale->SetOrientationToHorizontal();
  scale->SetPosition(0.2, 0.02);
  scale->SetWidth(0.6);
  scale->SetHeight(0.1);
  scale->SetNumberOfLabels(3);
  scale->UnconstrainedFontSizeOn();
  for (vtkTextProperty* text : {scale->GetTitleTextProperty(), scale->GetLabelTextProperty()}) {
    text->SetColor(0.1, 0.1, 0.1);
    text->ShadowOff();
    text->ItalicOff();
    text->BoldOff();
    text->SetFontSize(font_size);
  }
  return scale;
}

/// The middle and the size of what is seen, in the axes of the file.
struct Extent {
  double x, y, w, h;
};
Extent extent_of(vtkUnstructuredGrid* grid) {
  double b[6];
  grid->GetBounds(b);
  return {(b[0] + b[1]) / 2, (b[2] + b[3]) / 2, b[1] - b[0], b[3] - b[2]};
}

double height_of(const Extent& e, int width) { return width * std::min(1.0, std::max(0.35, 1.25 * e.h / e.w)); }

void aim(vtkCamera* camera, const Extent& e, int width) {
  camera->ParallelProjectionOn();
  const double half = std::max(0.5 * e.h / 0.78, 0.5 * e.w * height_of(e, width) / width / 0.95);  // room below for the scale
  const double x = e.x, y = e.y - 0.1 * half;
  camera->SetParallelScale(half);
  camera->SetFocalPoint(x, y, 0);
  camera->SetPosition(x, y, 10 * (e.w + e.h));
}

}  // namespace

void write_field_picture(const std::filesystem::path& file, const std::string& field, int width, const std::filesystem::path& picture) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (reader->CanReadFile(file.c_str()) == 0) throw std::runtime_error(file.string() + ": is not a .vtu file that can be read");
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  const auto [values, on_cells] = field_of(grid, field, file);
  const Extent extent = extent_of(grid);
  const auto table = colours(values);
  const auto body = painted(grid, field, on_cells, table);
  const auto scale = scale_of(table, field, width / 45);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(body);
  renderer->AddActor2D(scale);
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->SetMultiSamples(8);
  window->SetSize(width, static_cast<int>(height_of(extent, width)));
  window->AddRenderer(renderer);
  aim(renderer->GetActiveCamera(), extent, width);
  renderer->ResetCameraClippingRange();
  window->Render();

  write_png(window, picture);
}

}  // namespace pintle
