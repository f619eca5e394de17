#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/analysis/static_case/static_case.h"
#include "framework/bodies/modal_basis.h"
#include "framework/scene/yaml/reader.h"
#include "tests/paper/plot.h"

/// The page on published problems of plane elements and beams: see page.cpp.
namespace verification {

using paper::anchor;
using pintle::printed;
using Values = std::vector<double>;

/// One comparison. Values stand in the unit of their problem.
struct Row {
  std::string element, mesh, what;
  Values ours, target;
  double allowed = 0;     ///< of each value, relative; 0: shown, not judged
  bool headline = false;  ///< stands in the table that begins the page
};
struct Problem {
  std::string title, unit;
  std::string text;  ///< what it is, where the target comes from
  std::string why;   ///< why so much error is allowed
  std::vector<Row> rows = {};
};
using Problems = std::vector<Problem>;

/// Of the value that errs most, with its sign.
double error(const Row&);

void static_problems(Problems&);
void beam_problems(Problems&);
void plate_problems(Problems&);
/// FV32 by every element and three meshes: error against dofs and, if `timed`, seconds.
/// Text of the page and, if `timed`, the figure.
std::string accuracy_for_money(Problems&, bool timed);

/// Names, linear ones and their quadratic siblings.
const std::vector<std::string>& plane_elements();
bool is_linear(const std::string& element);

/// A file of examples/, "verification/cook".
pintle::Scene scene(const std::string& name, const pintle::Overrides& = {});
pintle::ElasticBody body(const pintle::Scene&, const std::string& name = "");
pintle::ScenePlate& plate(pintle::Scene&);  ///< of the only body
/// The same scene with another element and, read from a mesh file, with the cells that go with it.
void take(pintle::Scene&, const std::string& element);
std::string shown_mesh(const pintle::ElasticBody&);  ///< "24 triangle6"

Values frequencies(const pintle::Scene&, int count, const std::string& body = "");  ///< [Hz]
struct Rest {
  pintle::ElasticBody body;
  pintle::StaticReport report;
  Eigen::Vector3d moved(const std::string& point) const;          ///< u_x, u_y, φ
  Eigen::Vector4d stress_at(const Eigen::Vector2d& place) const;  ///< of the node nearest [Pa]
};
Rest rest(const pintle::Scene&);

}  // namespace verification
