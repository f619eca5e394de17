#include "app/body_fields.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace pintle {

Eigen::RowVectorXd values(const DrawnBody& body, const std::string& field) {
  for (const auto& f : body.fields) {
    if (f.name != field) continue;
    return f.values.rows() == 1 ? f.values.row(0) : Eigen::RowVectorXd(f.values.colwise().norm());
  }
  return {};
}

FieldRange range_of(const Drawing& drawing, const std::string& field) {
  FieldRange range;
  std::set<std::string> known;
  for (const auto& body : drawing.bodies) {
    const Eigen::RowVectorXd at_points = values(body, field);
    if (at_points.size() > 0) {
      range.least = std::min(range.least, at_points.minCoeff());
      range.greatest = std::max(range.greatest, at_points.maxCoeff());
    }
    for (const auto& f : body.fields) known.insert(f.name);
  }
  if (range.least > range.greatest) {
    std::string names;
    for (const auto& name : known) names += (names.empty() ? "" : ", ") + name;
    throw std::invalid_argument("--field \"" + field + "\": no body in the frame has this field; " +
                                (names.empty() ? "the frame has no flexible bodies" : "available fields: " + names));
  }
  return range;
}

}  // namespace pintle
