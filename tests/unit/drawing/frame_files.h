#pragma once

// What tests of frames write, and read back by VTK's reader.
#include "framework/drawing/vtk.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

namespace pintle_test {

using namespace pintle;
namespace fs = std::filesystem;

/// A folder of the test's own, gone when the test is.
struct Folder {
  fs::path path;
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path = fs::temp_directory_path() / ("pintle_vtk_" + std::string(test->name()) + "_" + std::to_string(getpid()));
    fs::remove_all(path);
    fs::create_directories(path);
  }
  ~Folder() { fs::remove_all(path); }
};

/// A triangle of the crank, a bar of the coupler, a lone point, an empty line and a force.
inline Drawing drawing(double t) {
  Drawing d;
  d.t = t;
  d.exaggeration = 25;
  d.owners = {"crank", "coupler", "gudgeon pin"};
  d.lines = {{Part::link, 0, true, {{0, 0}, {1, 0}, {0, 1}}},
             {Part::link, 1, false, {{1, 0}, {3, 0.125}}},
             {Part::joint, 2, true, {{3, 0.125}}},
             {Part::trace, 2, false, {}}};
  d.forces = {{{3, 0.125}, {-40, 1e3}, 2, Giver::contact, -3}};
  return d;
}

inline vtkSmartPointer<vtkUnstructuredGrid> read(const fs::path& file) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// A square of a triangle pair and a quadrilateral, deformed and with fields.
inline DrawnBody body(const std::string& name) {
  DrawnBody b;
  b.name = name;
  b.points.resize(2, 6);
  b.points << 0, 1, 1, 0, 2, 2.1, 0, 0, 1, 1, 0, 1.0 / 3;
  b.cells = {{CellShape::triangle3, {0, 1, 2, 0, 2, 3}, {1, 2}}, {CellShape::quadrilateral4, {1, 4, 5, 2}, {3}}};
  Eigen::RowVectorXd mises(6);
  mises << 0, 1e6, 2e6, 3e6, 4e6, 5e6;
  b.fields = {{"displacement [m]", b.points / 8}, {"von Mises [Pa]", mises}};
  return b;
}

inline Drawing flexible(double t, const std::vector<std::string>& bodies) {
  Drawing d = drawing(t);
  d.deformation = 40;
  for (const std::string& name : bodies) d.bodies.push_back(body(name));
  return d;
}

inline std::vector<std::string> names(vtkUnstructuredGrid* grid, const char* name) {
  std::vector<std::string> values;
  const auto* array = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(name));
  for (vtkIdType i = 0; array && i < array->GetNumberOfValues(); ++i) {
    values.push_back(const_cast<vtkStringArray*>(array)->GetValue(i));
  }
  return values;
}

/// What a collection lists: time, part, file.
struct Listed {
  double t;
  int part;
  std::string file;
  bool operator==(const Listed&) const = default;
};
inline void PrintTo(const Listed& l, std::ostream* out) { *out << l.t << " part " << l.part << " " << l.file; }
inline std::vector<Listed> listed(const fs::path& pvd) {
  std::vector<Listed> all;
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(pvd.c_str()));
  vtkXMLDataElement* list = root ? root->FindNestedElementWithName("Collection") : nullptr;
  for (int i = 0; list && i < list->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* entry = list->GetNestedElement(i);
    all.push_back({std::stod(entry->GetAttribute("timestep")), std::stoi(entry->GetAttribute("part")), entry->GetAttribute("file")});
  }
  return all;
}

}  // namespace pintle_test
