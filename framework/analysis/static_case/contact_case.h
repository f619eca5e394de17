#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/analysis/static_case/static_case.h"
#include "framework/component/fe/touching.h"

/// The static case of touching bodies. Theory: docs/theory/static_contact.md.
namespace pintle {

/// Load of one contact.
struct ContactReport {
  const SceneStaticContact* scene = nullptr;
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  ///< on the first body, axes of the case [N]
  double greatest_pressure = 0;                     ///< [Pa]
  double from = 0, to = 0;  ///< range of the contact along the first curve: angles about its centre [rad], for a line lengths [m]
  bool straight = false;
  Eigen::Matrix2Xd at;              ///< corners of the first surface, axes of the case [m]
  Eigen::VectorXd along, pressure;  ///< at these corners [rad or m], [Pa]
  Eigen::VectorXd gap;              ///< weighted mean around each [m]
};

struct ContactCase {
  std::vector<StaticReport> bodies;  ///< in the order of the call; axes of each body, which are parallel
  std::vector<ContactReport> contacts;
  double seconds = 0;
};

/// Names of the bodies of the case: its own, then others in the order of their contacts.
std::vector<std::string> bodies_of(const SceneStatic&);

/// @param bodies  those of `bodies_of`, in its order
/// @throws SceneError  a group that does not exist or is neither round nor straight; a body without sufficient supports
ContactCase solve_contact_case(const Scene&, const std::vector<const ElasticBody*>&);

/// A folder for each body, with the files of `write_case`; contacts.csv; static.json.
void write_contact_case(const std::filesystem::path&, const Scene&, const std::vector<const ElasticBody*>&, const ContactCase&);
std::string contacts_csv(const ContactCase&);
std::string contact_json(const Scene&, const std::vector<const ElasticBody*>&, const ContactCase&);

}  // namespace pintle
