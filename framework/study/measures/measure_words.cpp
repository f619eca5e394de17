#include "framework/study/measures/measure_words.h"

#include <algorithm>
#include <array>
#include <optional>

#include "framework/common/nearest.h"
#include "framework/common/words.h"
#include "framework/scene/error.h"
#include "framework/scene/units/expression.h"
#include "framework/study/measures/measure_vocabulary.h"
#include "framework/study/measures/measured_expression.h"
#include "framework/study/measures/measurables.h"

namespace pintle {

namespace {

class Reading {
 public:
  Reading(const Measure& measure, const Scene& scene)
      : measure_(measure), scene_(scene), words_(measure.words), measurables_(measurables_of(scene)) {}

  Asked read() {
    if (measure_.path) return read_path();
    words_.skip_articles();
    if (read_end()) return asked_;
    read_statistic();
    const std::size_t begin = words_.place();
    words_.skip_articles();
    const bool known = (looks_like_a_formula(words_.rest()) && read_expression()) || read_what() || read_expression();
    if (!known) {
      words_.back_to(begin);
      const bool formula = words_.rest().find('.') != std::string::npos || looks_like_a_formula(words_.rest());
      const std::string meant = with_nearest_beginning(words_.rest(), what_phrases(asked_.statistic == Statistic::none));
      if (!meant.empty()) fail("\"" + words_.rest() + "\" cannot be measured. Did you mean \"" + meant + "\"?");
      fail("\"" + words_.rest() +
           "\" cannot be measured; write for example peak force at JOINT, x of BODY.POINT at 0.05 s, "
           "rms torque of DRIVER after 10 ms, energy lost, or an expression such as coil.length - 3 mm (docs/studies.md)." +
           (formula && !why_not_.empty() ? " As an expression: " + why_not_ + "." : "") + described(measurables_));
    }
    read_time();
    validate_analysis();
    validate();
    if (asked_.frequency) asked_.unit = "Hz";
    if (asked_.time_of) asked_.unit = "s";
    return asked_;
  }

 private:
  Asked read_path() {
    const std::string& point = measure_.path->point;
    if (std::ranges::find(measurables_.points, point) == measurables_.points.end())
      fail("\"" + point + "\" is not a point of a body of this scene." + did_you_mean(point, measurables_.points));
    is(What::path, "m", "", point);
    asked_.statistic = Statistic::rms;
    validate_analysis();
    return asked_;
  }

  [[noreturn]] void fail(const std::string& message) const {
    Place place = measure_.place;
    if (place.key.empty()) place.key = "measure \"" + measure_.words + "\"";
    throw SceneError(measure_.file.empty() ? scene_.file : measure_.file, place, message);
  }

  void read_statistic() {
    if (!words_.take_any({"frequency of", "dominant frequency of", "main frequency of"}).empty()) {
      asked_.frequency = true;
      return;
    }
    asked_.time_of = !words_.take_any({"time of", "instant of", "when"}).empty();
    words_.skip_articles();
    for (const StatisticWord& s : statistic_words)
      if (words_.take(s.words)) {
        asked_.statistic = s.statistic;
        words_.take_any({"value of", "of"});
        return;
      }
    words_.take_any({"value of"});
  }

  /// When the run ends: at an event's stop, or at run.until.
  bool read_end() {
    const std::size_t before = words_.place();
    if (!words_.take_any({"time of end", "time of the end", "end time", "duration of the run"}).empty() && words_.done()) {
      if (!over_time(measure_.question)) fail("this analysis has no duration; ask for something else");
      return is(What::end, "s");
    }
    words_.back_to(before);
    return false;
  }

  /// A signal or an expression of them, which has no column.
  bool read_expression() {
    auto found = measured_expression(words_.rest(), scene_, why_not_);
    if (!found) return false;
    words_.back_to(words_.place() + std::min(found->length + 1, words_.rest().size()));
    is(What::written, "", "", found->output.name);
    asked_.unit = found->output.unit;
    std::ranges::replace(asked_.unit, '*', ' ');
    asked_.expression = std::move(found->output);
    return true;
  }

  bool is(What what, const char* unit, std::string part = "", std::string owner = "") {
    asked_.what = what, asked_.unit = unit, asked_.part = std::move(part), asked_.owner = std::move(owner);
    return true;
  }

  bool read_what() {
    return read_written() || read_column() || read_force() || read_contact() || read_lost() || read_energy() || read_elastic() ||
           read_motion();
  }

  /// A name must follow.
  std::string need(const char* kind, const Names& names) {
    words_.take_any({"at", "of", "in", "on", "by"});
    if (std::string name = words_.take_name(names); !name.empty()) return name;
    const std::string rest = words_.rest();
    if (rest.empty()) fail(std::string("it does not say of which ") + kind + "." + described(measurables_));
    fail("\"" + rest + "\" begins with no " + kind + " of this scene." +
         (names.empty() ? std::string(" It has none.") : did_you_mean(rest.substr(0, rest.find(" at ")), names)) + described(measurables_));
  }
  /// An optional name: it is present if the words after "at" are a name.
  std::string may_have(const Names& names) {
    const std::size_t before = words_.place();
    words_.take_any({"at", "of", "in", "by"});
    std::string name = words_.take_name(names);
    if (name.empty()) words_.back_to(before);
    return name;
  }

  bool is_column(const std::string& owner, const Column& named) {
    constexpr std::string_view lost = "lost to ";
    const std::string part = named.name + 1;
    if (part == "work in") return is(What::work, "J", "", owner);
    if (part.starts_with(lost)) return is(What::lost, "J", part.substr(lost.size()), owner);
    if (std::ranges::find(measurables_.actors, owner) == measurables_.actors.end())
      for (const MotionWord& m : motion_words)
        if (part == m.part) return is(What::motion, named.unit, part == "speed" ? "spin" : part, owner);
    return is(What::column, named.unit, part, owner);
  }

  template <std::size_t n>
  bool read_column_of(const Names& owners, const std::array<Column, n>& parts) {
    Names known;
    for (const std::string& owner : owners)
      for (const Column& part : parts) known.push_back(owner + part.name);
    const std::size_t before = words_.place();
    const std::string found = words_.take_name(known);
    if (found.empty()) return false;
    if (is_signal_alone(scene_, found)) {
      words_.back_to(before);
      return read_expression();
    }
    for (const std::string& owner : owners)
      for (const Column& part : parts)
        if (owner + part.name == found) is_column(owner, part);
    if (words_.take("on")) need("body", measurables_.bodies);
    const std::string unit = words_.rest();
    if (unit.starts_with("[") && unit.find(']') != std::string::npos)
      words_.back_to(words_.place() + std::min(unit.size(), unit.find(']') + 2));
    return true;
  }

  /// "slider.mode 2"
  bool read_mode() {
    const std::size_t before = words_.place();
    Names known;
    for (const std::string& body : measurables_.bodies) known.push_back(body + ".mode");
    const std::string found = words_.take_name(known), number = words_.rest().substr(0, words_.rest().find(' '));
    if (!found.empty() && !number.empty() && words_.take(number) && number.find_first_not_of("0123456789") == std::string::npos) {
      words_.take("[m kg^0.5]");
      return is(What::column, "m kg^0.5", "mode " + number, found.substr(0, found.size() - 5));
    }
    words_.back_to(before);
    return false;
  }

  bool read_written() {
    const std::string name = words_.take_name(measurables_.written);
    if (name.empty()) return false;
    is(What::written, "", "", name);
    for (const SceneOutput& o : scene_.outputs)
      if (o.name == name) asked_.unit = o.unit;
    for (const SceneState& s : scene_.states)
      if (s.name == name) asked_.unit = s.unit;
    std::ranges::replace(asked_.unit, '*', ' ');
    return true;
  }

  bool read_column() {
    if (read_mode() || read_column_of(measurables_.points, point_columns) || read_column_of(measurables_.actors, actor_columns) ||
        read_column_of(measurables_.bodies, body_columns))
      return true;
    const std::size_t before = words_.place();
    for (const Column& part : ledger_columns)
      if (words_.take(part.name)) {
        if (words_.take("[j]") || words_.done() || words_.rest().find("energy") == std::string::npos)
          return is(What::energy, "J", part.name);
        words_.back_to(before);
      }
    return false;
  }

  bool read_force() {
    for (const ForceWord& c : force_words)
      if (words_.take(c.words)) return is(What::force, "N", c.part, need("joint, driver or force", measurables_.actors));
    if (!words_.take_any(torque_words).empty()) return is(What::torque, "N m", "", need("joint, driver or force", measurables_.actors));
    return false;
  }

  bool read_contact() {
    if (!words_.take_any(eccentricity_words).empty()) return is(What::eccentricity, "m", "", need("joint", measurables_.joints));
    if (!words_.take_any(depth_words).empty()) return is(What::depth, "m", "", need("joint or contact", measurables_.walls));
    if (!words_.take_any(impact_words).empty()) return is(What::impacts, "", "", may_have(measurables_.walls));
    if (!words_.take_any(flight_words).empty() || (asked_.statistic != Statistic::none && !words_.take_any({"free flight"}).empty())) {
      if (asked_.statistic != Statistic::none && asked_.statistic != Statistic::greatest && asked_.statistic != Statistic::peak)
        fail("only the longest free flight is known; write longest free flight");
      asked_.statistic = Statistic::none;
      return is(What::free_flight, "s", "", may_have(measurables_.walls));
    }
    if (!words_.take_any(contact_time_words).empty()) return is(What::contact_time, "s", "", may_have(measurables_.walls));
    return false;
  }

  std::string read_account() {
    words_.skip_articles();
    for (const AccountWord& a : account_words)
      if (words_.take(a.words)) return a.column;
    fail("\"" + words_.rest() +
         "\" is not a kind of energy loss; write friction, hysteresis, damper, damping, engaging, switching or numerical dissipation");
  }

  bool read_lost() {
    if (!words_.take_any(work_words).empty()) {
      Names workers = measurables_.drivers;
      workers.insert(workers.end(), measurables_.loads.begin(), measurables_.loads.end());
      return is(What::work, "J", "", words_.take_any({"of", "by", "in"}).empty() ? "" : need("driver or force", workers));
    }
    if (words_.take("scheme.lost to numerical dissipation")) return is(What::lost, "J", "numerical dissipation");
    if (words_.take_any(loss_words).empty()) return false;
    Names losers = measurables_.actors;
    losers.insert(losers.end(), measurables_.bodies.begin(), measurables_.bodies.end());
    is(What::lost, "J");
    asked_.owner = may_have(losers);
    if (!words_.take_any({"to", "by"}).empty()) asked_.part = read_account();
    if (asked_.owner.empty()) asked_.owner = may_have(losers);
    return true;
  }

  bool read_energy() {
    for (const EnergyWord& e : energy_words)
      if (words_.take(e.words)) return is(What::energy, "J", e.column);
    return false;
  }

  bool read_elastic() {
    if (!words_.take_any(stress_words).empty()) return is(What::stress, "Pa", "", need("point", measurables_.points));
    if (!words_.take_any(displacement_words).empty()) return is(What::displacement, "m", "", need("point", measurables_.points));
    if (!words_.take_any(deflection_words).empty()) return is(What::deflection, "m", "", need("body", measurables_.bodies));
    return false;
  }

  bool read_motion() {
    Names all = measurables_.bodies;
    all.insert(all.end(), measurables_.points.begin(), measurables_.points.end());
    if (!words_.take_any(distance_words).empty()) {
      is(What::distance, "m", "", need("body or point", all));
      words_.take_any({"and", "to"});
      asked_.other = need("body or point", all);
      return true;
    }
    for (const MotionWord& m : motion_words)
      if (words_.take(m.words)) {
        const auto among = [&](const auto& parts) { return std::ranges::find(parts, std::string_view(m.part)) != parts.end(); };
        const std::string owner = among(of_bodies_alone)   ? need("body", measurables_.bodies)
                                  : among(of_points_alone) ? need("point", measurables_.points)
                                                           : need("body or point", all);
        const bool body = std::ranges::find(measurables_.bodies, owner) != measurables_.bodies.end();
        const bool turning = body && m.part == std::string_view("speed");
        return is(What::motion, turning ? "rad/s" : m.unit, turning ? "spin" : m.part, owner);
      }
    return false;
  }

  double time(const std::string& text) const {
    Parameters parameters;
    for (const SceneParameter& p : scene_.parameters)
      parameters[p.name] = {p.value, p.unit.empty() ? Dimension{} : read_quantity(p.unit).dimension};
    try {
      const double t = read_quantity(text, dimension::time, parameters);
      if (t < 0) throw ExpressionError("\"" + text + "\" is negative");
      return t;
    } catch (const ExpressionError& error) {
      fail(std::string(error.what()) +
           "; a time is written at the end of a measure: at 0.05 s, after 10 ms, before 1 s, from 10 ms to 20 ms, in the last 5 ms");
    }
  }

  /// Two times with a word between them.
  bool read_window(const std::string& rest, const char* word) {
    const std::string between = std::string(" ") + word + " ";
    const auto middle = lower(rest).find(between);
    if (middle == std::string::npos) return false;
    asked_.from = time(rest.substr(0, middle));
    asked_.to = time(rest.substr(middle + between.size()));
    if (!(asked_.to > asked_.from)) fail("its window \"" + rest + "\" is empty; write the earlier time first");
    return true;
  }

  void read_time() {
    words_.take_any({","});
    if (words_.done()) return;
    if (!words_.take_any({"at the end", "at end", "at last"}).empty() && words_.done()) {
      asked_.statistic = asked_.statistic == Statistic::none ? Statistic::last : asked_.statistic;
      return;
    }
    const auto instant = [&](double t) { asked_.instant = true, asked_.from = asked_.to = t; };
    if (!words_.take_any({"at the start", "at start", "at the beginning"}).empty() && words_.done()) return instant(0);
    const std::string how = words_.take_any({"at t =", "at", "after", "before", "until", "up to", "from", "between", "in the last",
                                             "over the last", "in the first", "over the first", "since"});
    const std::string rest = words_.rest();
    if (how.empty())
      fail("\"" + rest +
           "\" is not understood; a time may follow the quantity: at 0.05 s, after 10 ms, before 1 s, from 10 ms to 20 ms, in "
           "the last 5 ms." +
           described(measurables_));
    if (how.starts_with("at")) return instant(time(rest));
    if (how == "between" ? read_window(rest, "and") : how == "from" && (read_window(rest, "to") || read_window(rest, "until"))) return;
    if (how == "between") fail("a window has two times; write between 10 ms and 20 ms");
    if (how == "after" || how == "from" || how == "since")
      asked_.from = time(rest);
    else if (how.ends_with("last"))
      asked_.last = time(rest), asked_.from = std::max(0.0, scene_.run.until - asked_.last);
    else
      asked_.to = time(rest);
    if (!(asked_.to > 0) || (scene_.has_run && asked_.from == scene_.run.until)) fail("its window is empty");
  }

  /// Rejects what the analysis does not provide; statics provides only its single instant.
  void validate_analysis() {
    const Analysis analysis = measure_.question.analysis;
    if (analysis == Analysis::run) return;
    const bool motion = asked_.what == What::motion || asked_.what == What::distance || asked_.what == What::path ||
                        (asked_.what == What::written && is_of_motion(scene_, asked_));
    if (analysis == Analysis::kinematics && !motion)
      fail("kinematics computes motion only; write for example range of x of BODY.POINT, or analysis: inverse for forces");
    const bool of_the_ledger =
        asked_.what == What::energy || cumulative(asked_.what) || (asked_.what == What::column && asked_.owner.empty());
    if (of_the_ledger)
      fail(std::string(analysis == Analysis::statics ? "statics" : "inverse") +
           " does not record energies and impacts; ask for forces or motion, or write analysis: run");
    if (analysis != Analysis::statics) return;
    if (asked_.statistic != Statistic::none || asked_.instant || asked_.frequency || asked_.time_of)
      fail(
          "statics finds one state, so nothing has a time, a peak or a mean; write for example force at JOINT, x of BODY (the study's "
          "key `at` gives the instant of the loads)");
    asked_.instant = true, asked_.from = asked_.to = measure_.question.at.value_or(0);
  }

  void validate() const {
    const bool events = asked_.what == What::impacts || asked_.what == What::free_flight || asked_.what == What::contact_time;
    if (measure_.question.analysis == Analysis::statics) return;
    if (asked_.instant && (asked_.statistic != Statistic::none || asked_.time_of || asked_.frequency))
      fail("an instant has one value; leave out the word before what is measured, or give a window: after 10 ms, before 1 s");
    if (events && (asked_.statistic != Statistic::none && asked_.statistic != Statistic::last))
      fail("it is one number of a run; leave out the word before it");
    if (events && (asked_.frequency || asked_.time_of)) fail("it is not a function of time, so it has no frequency and no time of a peak");
    if (asked_.time_of && asked_.statistic != Statistic::peak && asked_.statistic != Statistic::greatest &&
        asked_.statistic != Statistic::least)
      fail("a time can only be that of the peak, greatest or least; write time of peak WHAT");
    if (asked_.statistic == Statistic::none && !asked_.instant && !asked_.frequency && !cumulative(asked_.what))
      fail(
          "it changes in time, and it is not clear which of its values is meant; write peak, greatest, least, mean, rms, range or final "
          "before it, or at 0.05 s after it");
  }

  const Measure& measure_;
  const Scene& scene_;
  Words words_;
  Measurables measurables_;
  std::string why_not_;  // the reason why it is no expression
  Asked asked_;
};

}  // namespace

bool cumulative(What what) {
  return what == What::lost || what == What::work || what == What::impacts || what == What::free_flight || what == What::contact_time;
}

Asked read_measure(const Measure& measure, const Scene& scene) { return Reading(measure, scene).read(); }

}  // namespace pintle
