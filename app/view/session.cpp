#include "app/view/session.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include <Eigen/Geometry>

#include <nlohmann/json.hpp>

#include "files/noted.h"
#include "framework/build/build.h"
#include "framework/build/inertia_defaults.h"
#include "framework/common/file_names.h"
#include "framework/common/index.h"
#include "framework/configuration/assemble.h"
#include "framework/drawing/palette.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Eigen::Vector2d;

/// Modification times of the files read, and of those in their folders that these may read in turn, as drawings do.
SavedFiles saved_files(const std::vector<fs::path>& read) {
  SavedFiles out;
  const auto add = [&](const fs::path& file) {
    std::error_code gone;
    if (const auto time = fs::last_write_time(file, gone); !gone) out[file] = time;
  };
  std::set<fs::path> folders;
  for (const fs::path& file : read) {
    add(file);
    folders.insert(file.has_parent_path() ? file.parent_path() : fs::path("."));
  }
  std::error_code ignored;
  for (const fs::path& folder : folders)
    for (auto entry = fs::directory_iterator(folder, ignored); entry != fs::directory_iterator(); entry.increment(ignored)) {
      constexpr std::array<std::string_view, 7> kinds{".yaml", ".yml", ".csv", ".geo", ".inp", ".msh", ".json"};
      if (std::ranges::find(kinds, ending_of(entry->path())) != kinds.end()) add(entry->path());
    }
  return out;
}

Json lines_json(const Drawing& drawing) {
  Json out = Json::array();
  for (const DrawnLine& line : drawing.lines) {
    Json points = Json::array();
    for (const Vector2d& r : line.points) points.push_back(r.x()), points.push_back(r.y());
    out.push_back({{"part", static_cast<int>(line.part)}, {"owner", line.owner}, {"closed", line.closed}, {"points", std::move(points)}});
  }
  return out;
}

}  // namespace

/// A scene prepared for moving: rigid, as in `pintle kinematics`.
struct ViewSession::Assembled {
  Scene scene;
  Model model;
  Assembly start;
  State state;
  std::unique_ptr<MovedByHand> hand;

  explicit Assembled(Scene read)
      : scene(ready_for_kinematics(std::move(read))),
        model(build(scene)),
        start(assemble(scene, model)),
        state(start.start),
        hand(std::make_unique<MovedByHand>(model.system, start.start.y)) {}

  void take_pose() { state.y.head(model.system.n()) = hand->coordinates(); }

  Drawing drawing() const {
    Equations eq(model.system);
    pose(model.system, 0, state.y, eq);
    speed(model.system, 0, state.y, eq);
    Drawing out = draw(model, Drafting(scene, model), state, eq);
    out.forces.clear();
    return out;
  }

  Json bodies_json() const {
    Json out = Json::array();
    for (std::size_t b = 0; b < model.system.bodies.size(); ++b) {
      const double* q = state.y.data() + 3 * b;
      out.push_back({{"name", model.system.bodies[b].name}, {"x", q[0]}, {"y", q[1]}, {"angle", q[2]}});
    }
    return out;
  }

  /// For each degree of freedom, the velocities of all markers on bodies.
  Json dofs_json() const {
    constexpr int most = 12;
    const Eigen::MatrixXd motions = hand->dofs(most);
    Json out = Json::array();
    for (Eigen::Index k = 0; k < motions.cols(); ++k) {
      Json arrows = Json::array();
      for (const Marker& m : model.system.markers) {
        if (m.body == ground) continue;
        const Eigen::Vector3d v = motions.col(k).segment<3>(3 * m.body);
        const double angle = state.y[3 * m.body + 2];
        const Vector2d r = Eigen::Rotation2Dd(angle) * m.x_BP, place = state.y.segment<2>(3 * m.body) + r;
        arrows.push_back({place.x(), place.y(), v[0] - v[2] * r.y(), v[1] + v[2] * r.x()});
      }
      out.push_back(std::move(arrows));
    }
    return out;
  }

  Json json() const {
    const Drawing drawn = drawing();
    Json colours = Json::array(), drivers = Json::array();
    for (std::size_t b = 0; b < model.system.bodies.size(); ++b) colours.push_back(body_colour(drawn, b));
    for (std::size_t k = 0; k < model.system.joints.size(); ++k)
      if (is_driver(model.system.joints[k])) drivers.push_back(model.system.joint_names[k]);
    return {{"title", scene.title},         {"length", model.system.length},
            {"owners", drawn.owners},       {"colours", colours},
            {"lines", lines_json(drawn)},   {"bodies", bodies_json()},
            {"mobility", hand->mobility()}, {"freedoms", dofs_json()},
            {"drivers", drivers},           {"warnings", warnings_of(model, start)}};
  }
};

ViewSession::ViewSession(fs::path scene, Overrides overrides) : scene_(std::move(scene)), overrides_(std::move(overrides)), read_{scene_} {}

ViewSession::~ViewSession() = default;

void ViewSession::read_if_saved() {
  const SavedFiles saved = saved_files(read_);
  if (version_ > 0 && saved == saved_) return;
  ++version_, error_.clear();
  const auto begin = fs::file_time_type::clock::now();
  FilesNoted noted;
  try {
    assembled_ = std::make_unique<Assembled>(read_scene(scene_, overrides_));
  } catch (const std::exception& e) {
    error_ = e.what();  // the previous content stays on the page
  }
  read_ = noted.paths();
  read_.push_back(scene_);
  saved_ = saved_files(read_);
  for (auto& [file, time] : saved_) {  // if one was saved meanwhile, it will be read again
    if (const auto before = saved.find(file); before != saved.end())
      time = before->second;
    else if (time > begin)
      time = fs::file_time_type::min();
  }
}

std::string ViewSession::drawing() const {
  Json out{{"version", version_}, {"file", scene_.filename().string()}, {"error", error_}};
  if (assembled_) out.update(assembled_->json());
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string ViewSession::now(long known) {
  const std::lock_guard lock(one_at_a_time_);
  read_if_saved();
  return known == version_ ? Json{{"version", version_}}.dump() : drawing();
}

std::optional<std::string> ViewSession::drag(const std::string& request) {
  const std::lock_guard lock(one_at_a_time_);
  const Json asked = Json::parse(request, nullptr, false);
  const auto place = [](const Json& list) { return Vector2d(list.at(0).get<double>(), list.at(1).get<double>()); };
  try {
    const long version = asked.at("version").get<long>();
    const int body = asked.at("body").get<int>();
    const Vector2d grabbed = place(asked.at("point")), goal = place(asked.at("to"));
    if (!assembled_ || version != version_) return drawing();
    if (body < 0 || body >= static_cast<int>(assembled_->model.system.bodies.size()) || !grabbed.allFinite() || !goal.allFinite())
      return {};
    ++version_;
    if (assembled_->hand->pull(body, grabbed, goal)) assembled_->take_pose();
  } catch (const Json::exception&) {
    return {};
  }
  return drawing();
}

std::string ViewSession::again() {
  const std::lock_guard lock(one_at_a_time_);
  if (assembled_) {
    assembled_->hand = std::make_unique<MovedByHand>(assembled_->model.system, assembled_->start.start.y);
    assembled_->state = assembled_->start.start;
    ++version_;
  }
  return drawing();
}

}  // namespace pintle::app
