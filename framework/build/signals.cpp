#include "framework/build/signals.h"

#include <algorithm>

#include "framework/common/nearest.h"
#include "framework/common/text.h"
#include "framework/mechanism/result_tables.h"
#include "framework/scene/error.h"
#include "framework/scene/units/sided_formula.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

using What = SignalWord::What;

void SignalMaker::wrong(const Place& place, const std::string& message) const { throw SceneError(scene_.file, place, message); }

const std::map<std::string, SignalWord, std::less<>>& SignalMaker::words() {
  if (words_) return *words_;
  words_ = signal_words(scene_);
  for (const auto& [whole, piece] : scene_.piece_of_point) {  // points of cut beams go by the name of the beam as well
    const std::string of_piece = piece + whole.substr(whole.rfind('.')) + ".";
    std::vector<std::pair<std::string, SignalWord>> found;
    for (auto word = words_->lower_bound(of_piece); word != words_->end() && word->first.starts_with(of_piece); ++word) {
      found.emplace_back(whole + "." + word->first.substr(of_piece.size()), word->second);
      if (word->second.what == What::column) found.back().second.text = word->first;
    }
    words_->insert(found.begin(), found.end());
  }
  return *words_;
}

int SignalMaker::begin(const Law& law, const Place& place) {
  auto& laws = model_.system.laws;
  if (law.signals.empty())
    laws.push_back({[at = law.at](double t, const double*, double*) { return at(t).value; }, {}});
  else
    laws.push_back({law.of_signals, {}}), begun_.push_back({laws.size() - 1, &law, place});
  return static_cast<int>(laws.size()) - 1;
}

// Warns once for each table.
void SignalMaker::warn_of_swing(const Law& law, const Place& place) {
  const auto* table = law.of_signals.target<SignalTable>();
  const auto* spline = table ? std::get_if<Spline>(&table->table) : nullptr;
  const std::optional<Overshoot> overshoot = spline ? worst_overshoot(*spline) : std::nullopt;
  if (!overshoot) return;
  const std::string where = (place.file.empty() ? scene_.file : place.file) + ":" + std::to_string(place.line) + ": " + place.key;
  model_.warnings.push_back(where + ": the spline of its table " + law.text + " overshoots its samples between " +
                            number_text(overshoot->begin, 6) + " and " + number_text(overshoot->end, 6) + " by " +
                            number_text(overshoot->by, 3) +
                            " (SI units): use interpolation: linear, or more samples where the values turn");
}

void SignalMaker::finish() {
  int sides = 0;
  for (const Begun& begun : begun_) {
    SignalLaw made = law(*begun.from, begun.place);
    made.sided = sided(made.of);
    made.first_side = sides;
    if (made.sided) sides += made.sided->switches();
    model_.system.laws[begun.law] = std::move(made);
    warn_of_swing(*begun.from, begun.place);
  }
}

SignalLaw SignalMaker::law(const Law& from, const Place& place) {
  if (from.signals.size() > most_law_inputs)
    wrong(place, "a law names more than " + std::to_string(most_law_inputs) + " signals; split it into states");
  SignalLaw out{from.of_signals, {}};
  if (from.signals.empty()) out.of = [at = from.at](double t, const double*, double*) { return at(t).value; };
  for (const std::string& name : from.signals) out.in.push_back(signal(name, place));
  return out;
}

int SignalMaker::signal(const std::string& name, const Place& place) {
  const auto [known, is_new] = known_.try_emplace(name, static_cast<int>(model_.system.signals.size()));
  if (!is_new) return known->second;
  const auto word = words().find(name);
  if (word == words().end()) {
    std::vector<std::string> names;
    for (const auto& [other, what] : words()) names.push_back(other);
    const std::string near = nearest(name, names);
    wrong(place, "there is no signal " + quoted(name) +
                     (near.empty() ? "; signals are named like the columns of trajectory.csv" : ". Did you mean " + quoted(near) + "?"));
  }
  if (word->second.what >= What::output)
    wrong(place, quoted(name) + " depends on the accelerations, which depend on this law; use positions, speeds or states");
  model_.system.signals.push_back(made(word->second));
  return known->second;
}

MotionSignal SignalMaker::made(const SignalWord& word) {
  using Kind = MotionSignal::Kind;
  const auto point = [&](const PointRef& ref) { return ref.point.empty() && ref.body != "ground" ? frame(ref) : markers_.marker(ref); };
  const auto direction = [&](const PointRef& ref) {
    return ref.point.empty() && ref.body != "ground" ? frame(ref) : markers_.marker(ref, Holds::direction);
  };
  const auto displacement = [&](Kind kind) -> MotionSignal {
    const Eigen::Vector2d x = markers_.marker_at(word.a, Holds::point).x_BP;
    const int body = markers_.body(word.a);
    const Eigen::Index n = model_.system.bodies[static_cast<std::size_t>(body)].modes();
    const int axes = add({.body = body, .shape = Eigen::Matrix2Xd::Zero(2, n), .slope = Eigen::RowVectorXd::Zero(n)});
    return {kind, axes, markers_.marker(word.a), kind == Kind::along ? x.x() : x.y()};
  };
  switch (word.what) {
    case What::x: return {Kind::x, point(word.a)};
    case What::y: return {Kind::y, point(word.a)};
    case What::vx: return {Kind::vx, point(word.a)};
    case What::vy: return {Kind::vy, point(word.a)};
    case What::angle: return {Kind::angle, frame(word.a)};
    case What::speed: return {Kind::speed, frame(word.a)};
    case What::ux: return displacement(Kind::along);
    case What::uy: return displacement(Kind::across);
    case What::length: return {Kind::length, point(word.a), point(word.b)};
    case What::length_rate: return {Kind::length_rate, point(word.a), point(word.b)};
    case What::relative_angle: return {Kind::relative_angle, direction(word.a), direction(word.b)};
    case What::relative_speed: return {Kind::relative_speed, direction(word.a), direction(word.b)};
    case What::travel: return {Kind::along, direction(word.a), point(word.b)};
    default: return {Kind::state, word.index};
  }
}

// The body's own axes at its origin, as in trajectory.csv: bending does not move them.
int SignalMaker::frame(const PointRef& of) {
  const int body = markers_.body(of);
  const Body& b = model_.system.bodies[static_cast<std::size_t>(body)];
  return add({.body = body, .x_BP = b.x_BO, .shape = Eigen::Matrix2Xd::Zero(2, b.modes()), .slope = Eigen::RowVectorXd::Zero(b.modes())});
}

int SignalMaker::add(const Marker& marker) {
  auto& markers = model_.system.markers;
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const Marker& m = markers[i];
    if (m.body == marker.body && m.x_BP == marker.x_BP && m.angle == marker.angle && m.shape.isZero(0) && m.slope.isZero(0) &&
        m.second[0].size() == 0 && m.shape.cols() == marker.shape.cols())
      return static_cast<int>(i);
  }
  markers.push_back(marker);
  return static_cast<int>(markers.size()) - 1;
}

WrittenOutput written_output(const Scene& scene, const SceneOutput& o, const Model& model, SignalMaker& maker) {
  WrittenOutput out{o.name, o.unit, o.law.of_signals, {}};
  if (o.law.signals.empty()) out.of = [at = o.law.at](double t, const double*, double*) { return at(t).value; };
  std::vector<std::string> header;
  for (const std::string& name : o.law.signals) {
    const auto word = maker.words().find(name);
    const What what = word == maker.words().end() ? What::x : word->second.what;
    if (what == What::output) {
      out.in.push_back({WrittenOutput::Input::output, word->second.index});
    } else if (what == What::column) {
      if (header.empty()) header = trajectory_table(model).header;
      const std::string& heading = word->second.text.empty() ? name : word->second.text;
      const auto column = std::ranges::find_if(header, [&](const std::string& h) {
        return h.starts_with(heading) && (h.substr(heading.size(), 2) == " [" || h.substr(heading.size(), 4) == " on ");
      });
      if (column == header.end()) {
        const bool of_point = name.ends_with(".ax") || name.ends_with(".ay");
        throw SceneError(scene.file, o.place,
                         quoted(name) + " is not a column of trajectory.csv" +
                             (of_point ? "; name its point under output.points" : "; docs/results.md lists the columns of each element"));
      }
      out.in.push_back({WrittenOutput::Input::column, static_cast<int>(column - header.begin())});
    } else {
      out.in.push_back({WrittenOutput::Input::signal, maker.signal(name, o.place)});
    }
  }
  return out;
}

}  // namespace pintle
