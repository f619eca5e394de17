#include "framework/drawing/vtk_encoder.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "framework/drawing/vtk_cell.h"

namespace pintle {

namespace {

constexpr bool agree(VtkCell ours, int vtks) { return static_cast<int>(ours) == vtks; }
static_assert(agree(vtk_vertex, VTK_VERTEX) && agree(vtk_polyline, VTK_POLY_LINE) && agree(vtk_polygon, VTK_POLYGON));
static_assert(agree(vtk_line, VTK_LINE) && agree(vtk_line3, VTK_QUADRATIC_EDGE));
static_assert(agree(vtk_triangle, VTK_TRIANGLE) && agree(vtk_triangle6, VTK_QUADRATIC_TRIANGLE) && agree(vtk_quadrilateral, VTK_QUAD));
static_assert(agree(vtk_quadrilateral8, VTK_QUADRATIC_QUAD) && agree(vtk_quadrilateral9, VTK_BIQUADRATIC_QUAD));

/// Columns as tuples; two-dimensional vectors get a third component, zero.
vtkNew<vtkDoubleArray> array_of(const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& v) {
  const int components = static_cast<int>(v.rows() == 2 ? 3 : v.rows());
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(v.cols());
  Eigen::Map<Eigen::MatrixXd> to(array->GetPointer(0), components, v.cols());
  to.topRows(v.rows()) = v;
  to.bottomRows(components - v.rows()).setZero();
  return array;
}

void set_cells(vtkUnstructuredGrid* grid, const std::vector<Cells>& blocks) {
  vtkNew<vtkCellArray> cells;
  cells->Use32BitStorage();
  vtkNew<vtkUnsignedCharArray> types;
  for (const Cells& block : blocks) {
    const auto n = static_cast<std::size_t>(nodes_of(block.shape));
    for (std::size_t c = 0; c < block.size(); ++c) {
      cells->InsertNextCell(static_cast<int>(n));
      for (std::size_t k = 0; k < n; ++k) cells->InsertCellPoint(block.nodes[c * n + k]);
      types->InsertNextValue(vtk_cell(block.shape));
    }
  }
  grid->SetCells(types, cells);
}

std::string encode_grid(const Eigen::Matrix2Xd& at, const std::vector<Cells>& cells, const std::vector<Field>& on_points,
                        const std::vector<Field>& on_cells, double t) {
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetData(array_of("Points", at));
  grid->SetPoints(points);
  set_cells(grid, cells);
  for (const Field& f : on_points) grid->GetPointData()->AddArray(array_of(f.name, f.values));
  for (const Field& f : on_cells) grid->GetCellData()->AddArray(array_of(f.name, f.values));
  vtkNew<vtkDoubleArray> time;
  time->SetName("TimeValue");
  time->InsertNextValue(t);
  grid->GetFieldData()->AddArray(time);

  // To a string, so that VTK accesses no file and prints nothing if one cannot be written.
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputDataObject(grid);
  writer->SetDataModeToAppended();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  return writer->Write() == 0 ? std::string() : writer->GetOutputString();
}

}  // namespace

extern "C" [[gnu::visibility("default")]] const void* pintle_vtk() {
  static constexpr VtkEncoder table{PINTLE_VERSION, encode_grid};
  return &table;
}

}  // namespace pintle
