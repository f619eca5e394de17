#pragma once

#include "meshes/mesh.h"

namespace pintle {

/// VTK's numbers of the kinds of cells; framework/drawing/vtk_encoder.cpp checks them against VTK's own.
enum VtkCell : unsigned char {
  vtk_vertex = 1,
  vtk_line = 3,
  vtk_polyline = 4,
  vtk_triangle = 5,
  vtk_polygon = 7,
  vtk_quadrilateral = 9,
  vtk_line3 = 21,
  vtk_triangle6 = 22,
  vtk_quadrilateral8 = 23,
  vtk_quadrilateral9 = 28
};

constexpr VtkCell vtk_cell(CellShape shape) {
  constexpr VtkCell kinds[] = {vtk_line, vtk_line3, vtk_triangle, vtk_triangle6, vtk_quadrilateral, vtk_quadrilateral8, vtk_quadrilateral9};
  return kinds[static_cast<int>(shape)];
}

}  // namespace pintle
