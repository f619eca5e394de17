#include "framework/bodies/mesh_file_warnings.h"

#include <algorithm>
#include <cmath>

#include "framework/bodies/elastic_parts.h"
#include "framework/common/text.h"
#include "meshes/reject.h"

namespace pintle {

namespace {

constexpr double same = 1e-3;      ///< relative: numbers in files have at least three digits
constexpr double very_large = 20;  ///< of a body [m]

bool near(double a, double b) { return std::abs(a - b) <= same * std::max(std::abs(a), std::abs(b)); }

/// Whether two moduli are the same in different units: related by a power of ten, or by pounds per square inch.
bool same_modulus(double file, double pascal) {
  if (!(file > 0)) return false;
  const double ten = std::pow(10, std::round(std::log10(pascal / file)));
  return near(file * ten, pascal) || std::abs(file * 6894.757 - pascal) <= 1e-2 * pascal;
}

/// The largest distance of a point of the ground, or of a body other than `but`, from the origin of its axes [m].
double rest_of_scene(const Scene& scene, const SceneBody& but) {
  double size = 0;
  const auto add = [&](const std::vector<ScenePoint>& points) {
    for (const ScenePoint& p : points)
      if (p.hole.empty()) size = std::max(size, std::hypot(p.at[0], p.at[1]));
  };
  add(scene.ground);
  for (const SceneBody& b : scene.bodies)
    if (b.name != but.name) add(b.points);
  return size;
}

}  // namespace

void validate_claims(const InpClaims& claims, const ScenePlate& plate, std::vector<std::string>& warnings) {
  if (!claims.strain.empty() && plate.state == PlaneState::stress) {
    if (!plate.state_given)
      reject(claims.strain,
             ": the elements of the file are for plane strain (CPE), but the default of a plate is plane stress; add plane: strain, or "
             "plane: stress to use plane stress nevertheless");
    warnings.push_back(claims.strain + ": the elements of the file are for plane strain (CPE); the scene sets plane stress, which is used");
  }
  const double scale = std::get<SceneFile>(plate.shape).scale;
  for (const InpClaims::Value& t : claims.thickness) {
    if (near(t.value * scale, plate.thickness)) continue;
    warnings.push_back(t.where + ": the file gives the thickness " + number_text(t.value) + ", which is " + number_text(t.value * scale) +
                       " m in its unit, but the scene gives " + number_text(plate.thickness) + " m; the value of the scene is used");
    break;
  }
  const Isotropic* solid = std::get_if<Isotropic>(&plate.material.material.elastic);
  if (!claims.directional.empty() && solid)
    warnings.push_back(claims.directional +
                       ": the material of the file is not isotropic, but that of the scene is; the material of the scene is used");
  if (!solid) return;
  for (const InpClaims::Value& E : claims.young) {
    if (same_modulus(E.value, solid->young)) continue;
    warnings.push_back(E.where + ": the file gives Young's modulus " + number_text(E.value) + ", but the scene gives " +
                       number_text(solid->young) + " Pa, which differs in every unit of stress; the value of the scene is used");
    break;
  }
  for (const InpClaims::Value& nu : claims.poisson) {
    if (near(nu.value, solid->poisson)) continue;
    warnings.push_back(nu.where + ": the file gives Poisson's ratio " + number_text(nu.value) + ", but the scene gives " +
                       number_text(solid->poisson) + "; the value of the scene is used");
    break;
  }
}

std::string size_warning(const Scene& scene, const ElasticBody& e) {
  if (!e.plate()) return "";
  const auto* file = std::get_if<SceneFile>(&plate_of(*e.scene).shape);
  if (!file || file->unit_given || kind_of(file->path) == ".step" || kind_of(file->path) == ".stp") return "";
  const double size = (e.mesh.x.rowwise().maxCoeff() - e.mesh.x.rowwise().minCoeff()).norm(), rest = rest_of_scene(scene, *e.scene);
  const bool off = rest > 0 && size > 300 * rest && size < 3000 * rest;  // about a thousand, allowing for a longer link
  if (!(size > very_large) && !off) return "";
  return "it is " + number_text(size) + " m across" +
         (off ? ", about a thousand times the rest of the scene (" + number_text(rest) + " m)" : "") + ": " + file->path +
         " is read in m because the scene gives no unit; if it is in mm, add unit: mm, otherwise unit: m";
}

}  // namespace pintle
