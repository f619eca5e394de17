#include "framework/analysis/static_case/contact_case.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include <nlohmann/json.hpp>

#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/in_body.h"
#include "framework/common/file.h"
#include "framework/common/text.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Bodies = std::vector<const ElasticBody*>;
using OrderedJson = nlohmann::ordered_json;

int number_of(const Bodies& bodies, const std::string& name) {
  const auto found = std::ranges::find(bodies, name, [](const ElasticBody* e) { return e->scene->name; });
  return static_cast<int>(found - bodies.begin());
}

Vector2d place_of(const SceneStatic& statics, const std::string& body) {
  const auto found = std::ranges::find(statics.at, body, &SceneStaticPlace::body);
  return found == statics.at.end() ? Vector2d(0, 0) : vector(found->at);
}

ContactSurface surface_of(const Scene& scene, const ElasticBody& e, const SceneStaticContact::Side& side, const Place& place) {
  const Group& group = group_of(scene, e.mesh, side.group, place, "name the curve in the drawing");
  for (const ScenePoint& p : e.scene->points)
    if (p.hole == side.group && p.coupling == RimCoupling::rigid)
      throw SceneError(scene.file, place,
                       "\"" + side.body + "." + side.group +
                           "\" is the rim of a rigid coupling, which cannot deform; write coupling: average at its point \"" + p.name +
                           "\", or leave the point out");
  try {
    return contact_surface(e.mesh, sides_of(e.mesh, group), e.thickness);
  } catch (const std::invalid_argument& error) {
    throw SceneError(scene.file, place, "\"" + side.body + "." + side.group + "\" " + error.what() + "; name another edge");
  }
}

ContactReport contact_report(const SceneStaticContact& scene, const ContactSurface& first, const ContactRows& rows, const Vector2d& at,
                             const Eigen::VectorXd& force, const Eigen::VectorXd& gap) {
  ContactReport r;
  r.scene = &scene;
  r.force = rows.pushed * force;
  r.straight = first.curve.straight;
  r.at = rows.at.colwise() + at;
  r.pressure = force.cwiseQuotient(rows.area);
  r.gap = gap;
  r.greatest_pressure = r.pressure.maxCoeff();
  // On a circle, angles are taken near the middle of the contact (for a pin, opposite to the force), so that its range is contiguous.
  const Vector2d towards = first.curve.radius < 0 ? r.force : Vector2d(-r.force);
  const double middle = r.straight || r.force.norm() == 0 ? 0 : std::atan2(towards.y(), towards.x());
  r.along = rows.along;
  if (!r.straight)
    for (double& a : r.along) a = middle + std::remainder(a - middle, 2 * std::numbers::pi);
  bool any = false;
  for (Index i = 0; i < force.size(); ++i)
    if (force[i] > 0) {
      r.from = any ? std::min(r.from, r.along[i]) : r.along[i];
      r.to = any ? std::max(r.to, r.along[i]) : r.along[i];
      any = true;
    }
  return r;
}

}  // namespace

std::vector<std::string> bodies_of(const SceneStatic& statics) {
  std::vector<std::string> out{statics.body};
  for (const SceneStaticContact& c : statics.contacts)
    for (const std::string& name : {c.first.body, c.second.body})
      if (std::ranges::find(out, name) == out.end()) out.push_back(name);
  return out;
}

ContactCase solve_contact_case(const Scene& scene, const Bodies& bodies) {
  const SceneStatic& statics = *scene.statics;
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::vector<NamedSupport>> supports;
  std::vector<BodyLoad> loads;
  std::vector<Eigen::VectorXd> forces;
  std::vector<TouchingBody> touching;
  for (const ElasticBody* e : bodies) {
    supports.push_back(supports_of(scene, *e));
    loads.push_back(loads_of(scene, *e));
    forces.push_back(loads.back().independent);
    touching.push_back({&e->model, &e->K, together(supports.back())});
  }
  std::vector<ContactSurface> firsts;
  std::vector<TouchingPair> pairs;
  for (const SceneStaticContact& c : statics.contacts) {
    const int a = number_of(bodies, c.first.body), b = number_of(bodies, c.second.body);
    const ElasticBody &first = *bodies[static_cast<std::size_t>(a)], &second = *bodies[static_cast<std::size_t>(b)];
    firsts.push_back(surface_of(scene, first, c.first, c.place));
    const ContactSurface other = surface_of(scene, second, c.second, c.place);
    const Vector2d shift = place_of(statics, c.first.body) - place_of(statics, c.second.body);
    try {
      pairs.push_back({a, b, contact_rows(first.model, firsts.back(), second.model, other, shift)});
    } catch (const std::invalid_argument& error) {
      throw SceneError(scene.file, c.place, std::string(error.what()) + "; check the positions under `at`");
    }
  }

  ContactCase out;
  try {
    const TouchingSolution s = TouchingBodies(touching, pairs).solve(forces);
    for (std::size_t b = 0; b < bodies.size(); ++b) out.bodies.push_back(report_of(scene, *bodies[b], supports[b], loads[b], s.bodies[b]));
    for (std::size_t i = 0; i < pairs.size(); ++i)
      out.contacts.push_back(contact_report(statics.contacts[i], firsts[i], pairs[i].rows,
                                            place_of(statics, statics.contacts[i].first.body), s.force[i], s.gap[i]));
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw SceneError(scene.file, statics.place, error.what());
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

std::string contacts_csv(const ContactCase& c) {
  std::string out = "contact,x [m],y [m],along [rad or m],pressure [Pa],gap [m]\n";
  for (const ContactReport& r : c.contacts)
    for (Index i = 0; i < r.along.size(); ++i) {
      out += csv_field(r.scene->name);
      for (const double v : {r.at(0, i), r.at(1, i), r.along[i], r.pressure[i], r.gap[i]}) {
        out += ',';
        append_number(out, v);
      }
      out += '\n';
    }
  return out;
}

std::string contact_json(const Scene& scene, const Bodies& bodies, const ContactCase& c) {
  OrderedJson out = {
      {"program", "pintle"}, {"version", PINTLE_VERSION}, {"command", "static"}, {"title", scene.title}, {"file", scene.file}};
  OrderedJson all = OrderedJson::object(), contacts = OrderedJson::object();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    OrderedJson one = OrderedJson::parse(static_json(scene, *bodies[b], c.bodies[b]));
    for (const char* shared : {"program", "version", "command", "title", "file", "body", "scene"}) one.erase(shared);
    all[bodies[b]->scene->name] = one;
  }
  for (const ContactReport& r : c.contacts) {
    OrderedJson& one = contacts[r.scene->name];
    one["force on the first body [N, N]"] = {r.force.x(), r.force.y()};
    one["greatest pressure [Pa]"] = r.greatest_pressure;
    one[r.straight ? "touches from, to [m]" : "touches from, to [rad]"] = {r.from, r.to};
  }
  out["bodies"] = std::move(all), out["contacts"] = std::move(contacts);
  out["timings [s]"] = {{"contact", c.seconds}};
  return text_with_scene(out, scene);
}

void write_contact_case(const std::filesystem::path& directory, const Scene& scene, const Bodies& bodies, const ContactCase& c) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::filesystem::path own = directory / bodies[b]->scene->name;
    std::filesystem::create_directories(own);
    write_case(own, scene, *bodies[b], c.bodies[b]);
  }
  write_text(directory / "contacts.csv", contacts_csv(c));
  write_text(directory / "static.json", contact_json(scene, bodies, c));
}

}  // namespace pintle
