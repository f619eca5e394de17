#include "framework/study/measures/measure.h"

#include <algorithm>
#include <cmath>

#include "framework/scene/error.h"
#include "framework/study/measures/columns.h"
#include "framework/study/measures/measure_words.h"
#include "framework/study/measures/measurables.h"
#include "framework/study/measures/mode_measure.h"
#include "framework/study/measures/signal.h"

namespace pintle {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> lengths(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> out(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) out[i] = std::hypot(x[i], y[i]);
  return out;
}

/// The column for the rate of another.
std::string rate_of(const std::string& part) {
  for (const auto& [of, rate] :
       {std::pair{"x", "vx"}, {"y", "vy"}, {"vx", "ax"}, {"vy", "ay"}, {"angle", "speed"}, {"speed", "alpha"}, {"depth", "rate"}})
    if (part == of) return rate;
  return "";
}

/// The time at which a run should end; if an event stopped it, the time of the event.
double planned_end(const Scene& scene, const Run& run) {
  const bool in_order = run.status == Status::finished || run.status == Status::ledger_over_bound;
  return in_order ? std::min(scene.run.until, run.t_end) : scene.run.until;
}

/// Evaluates one measure of one run.
class Measuring {
 public:
  Measuring(const Asked& asked, const Scene& scene, const Model& model, const Run& run)
      : asked_(asked), scene_(scene), model_(model), run_(run), columns_(run) {}

  double value() const {
    const double until = planned_end(scene_, run_), slack = 1e-9 * scene_.run.until;
    if (asked_.what == What::end) return run_.t_end < until - slack ? nan : run_.t_end;
    const double from = asked_.last > 0 ? std::max(0.0, until - asked_.last) : asked_.from;
    const double to = asked_.instant ? asked_.to : std::min(asked_.to, until);
    if (to > run_.t_end + slack || from > to || (from == to && !asked_.instant) || run_.trajectory.rows() == 0) return nan;
    switch (asked_.what) {
      case What::impacts: return impacts(from, to);
      case What::free_flight: return free_flight(from, to);
      case What::contact_time: return contact_time(from, to);
      default: break;
    }
    Signal all = signal();
    if (all.y.empty()) return nan;
    all.t = columns_.times();
    for (const Impact& i : run_.impacts)
      if (is_rigid(model_.system.contacts[static_cast<std::size_t>(i.contact)])) all.jumps.push_back(i.begin);
    std::ranges::sort(all.jumps);
    if (all.t.back() < to - slack) return nan;  // the last rows are missing
    if (asked_.instant) return value_at(all, from);
    if (asked_.statistic == Statistic::none && !asked_.frequency)  // cumulative quantities
      return value_at(all, to) - (from > 0 ? value_at(all, from) : 0);
    return statistic(between(all, from, to), from, to);
  }

  std::vector<double> rows() const { return signal().y; }

 private:
  /// Without the rows that other measures have asked for.
  Signal regular_rows(const Signal& x) const {
    const double every = scene_.output.every > 0 ? scene_.output.every : scene_.run.until / 1000;
    Signal out;
    for (std::size_t i = 0; i < x.t.size(); ++i)
      if (std::abs(x.t[i] / every - std::round(x.t[i] / every)) < 1e-6) out.t.push_back(x.t[i]), out.y.push_back(x.y[i]);
    return out;
  }
  double statistic(const Signal& x, double from, double to) const {
    if (asked_.frequency) return dominant_frequency(regular_rows(x));
    switch (asked_.statistic) {
      case Statistic::greatest: return value_or_time(with_impacts(greatest(x), from, to));
      case Statistic::least: return value_or_time(least(x));
      case Statistic::range: return with_impacts(greatest(x), from, to).value - least(x).value;
      case Statistic::mean: return mean(x);
      case Statistic::rms: return rms(x);
      case Statistic::last: return x.y.back();
      default: break;
    }
    const Extreme high = with_impacts(greatest(x), from, to), low = least(x);
    const bool below = std::abs(low.value) > std::abs(high.value);
    return value_or_time({std::max(std::abs(high.value), std::abs(low.value)), below ? low.at : high.at});
  }
  double value_or_time(const Extreme& e) const { return asked_.time_of ? e.at : e.value; }

  bool concerns(const Impact& i) const {
    return asked_.owner.empty() || model_.system.contact_names[static_cast<std::size_t>(i.contact)] == asked_.owner;
  }
  double end_of(const Impact& i) const { return std::isnan(i.end) ? run_.t_end : i.end; }

  /// Rows may miss the peak of an impact; the integrator's record does not.
  Extreme with_impacts(Extreme e, double from, double to) const {
    const bool force = asked_.what == What::force && (asked_.part.empty() || asked_.part == "normal");
    if (!force && asked_.what != What::depth) return e;
    for (const Impact& i : run_.impacts) {
      const double peak = force ? i.peak_force : i.deepest;
      if (concerns(i) && i.begin >= from && end_of(i) <= to && peak > e.value) e = {peak, (i.begin + end_of(i)) / 2};
    }
    return e;
  }

  double impacts(double from, double to) const {
    double n = 0;
    for (const Impact& i : run_.impacts) n += concerns(i) && i.begin >= from && i.begin <= to;
    return n;
  }
  bool is_asked(std::size_t contact) const { return asked_.owner.empty() || model_.system.contact_names[contact] == asked_.owner; }
  /// Whether a massless link holds the journal, which then is always at the wall, without impacts.
  bool held(std::size_t contact) const { return is_held(model_.system.contacts[contact]); }
  /// Contacts with a wall, in order of their begin; for two profiles those of all their pairs.
  std::vector<const Impact*> stays(std::size_t contact) const {
    std::vector<const Impact*> out;
    const int first = static_cast<int>(contact), past = first + model_.system.contacts[contact].pairs;
    for (const Impact& i : run_.impacts)
      if (i.contact >= first && i.contact < past) out.push_back(&i);
    return out;
  }
  /// Calls of(contact) for each contact of the measure.
  template <class F>
  void each_contact(F of) const {
    for (std::size_t c = 0; c < model_.system.contacts.size(); ++c)
      if (is_asked(c) && model_.system.contacts[c].pair == 0) of(c);
  }
  double contact_time(double from, double to) const {
    double sum = 0;
    each_contact([&](std::size_t c) {
      if (held(c)) sum += to - from;
      double until = from;
      for (const Impact* i : stays(c)) {
        sum += std::max(0.0, std::min(end_of(*i), to) - std::max(i->begin, until));
        until = std::max(until, end_of(*i));
      }
    });
    return sum;
  }
  double free_flight(double from, double to) const {
    double longest = 0;
    each_contact([&](std::size_t c) {
      if (held(c)) return;
      double since = from;
      for (const Impact* i : stays(c)) {
        if (end_of(*i) < from) continue;
        longest = std::max(longest, std::min(i->begin, to) - since);
        since = std::max(since, end_of(*i));
      }
      longest = std::max(longest, to - since);
    });
    return longest;
  }

  /// All rows; no rows: the scene has no such quantity.
  Signal signal() const {
    switch (asked_.what) {
      case What::force: return force();
      case What::torque: return of(columns_.motion(asked_.owner + ".torque"));
      case What::motion: return motion();
      case What::distance: return distance();
      case What::eccentricity: return clearance(lengths(columns_.motion(asked_.owner + ".ex"), columns_.motion(asked_.owner + ".ey")));
      case What::depth: return depth();
      case What::stress: return stress();
      case What::displacement: return displacement();
      case What::deflection: return deflection();
      case What::energy: return energy();
      case What::lost: return lost();
      case What::work: return work();
      case What::column: return column();
      case What::written: return of(columns_.motion(asked_.owner));
      default: return {};
    }
  }

  Signal zero() const { return {{}, std::vector<double>(run_.trajectory.rows(), 0.0), {}, true, true}; }
  /// Forces and accelerations jump where journals touch walls.
  Signal of(std::vector<double> y, bool magnitude = false) const {
    const bool jumps = std::ranges::any_of(model_.system.contacts, [](const ContactPair& c) { return !is_held(c); });
    return {{}, std::move(y), {}, !jumps, magnitude};
  }

  Signal force() const {
    const std::string& name = asked_.owner;
    if (asked_.part == "x") return of(columns_.motion(name + ".fx"));
    if (asked_.part == "y") return of(columns_.motion(name + ".fy"));
    if (asked_.part == "friction" && !columns_.has(name + ".friction")) return zero();
    if (!asked_.part.empty() && columns_.has(name + "." + asked_.part)) {
      std::vector<double> y = columns_.motion(name + "." + asked_.part);
      for (double& v : y) v = std::abs(v);
      return of(std::move(y), true);
    }
    return of(lengths(columns_.motion(name + ".fx"), columns_.motion(name + ".fy")), true);
  }

  /// Zero for an ideal joint.
  Signal clearance(std::vector<double> y) const {
    if (y.empty() && joint_named(scene_, asked_.owner)) return zero();
    Signal out = of(std::move(y), true);
    out.smooth = true;
    return out;
  }
  Signal depth() const {
    Signal out = clearance(columns_.motion(asked_.owner + ".depth"));
    for (double& v : out.y) v = std::max(0.0, v);
    out.smooth = false;
    return out;
  }

  /// The body's or point's name in the columns.
  std::string subject(const std::string& name) const {
    const PointRef p = point_named(scene_, name);
    return p.body.empty() ? name : p.body + "." + p.point;
  }
  Signal column_of(const std::string& owner, const std::string& part) const {
    Signal out = of(columns_.motion(owner + "." + part));
    if (const std::string rate = rate_of(part); !rate.empty()) out.rate = columns_.motion(owner + "." + rate);
    out.smooth = out.smooth || !out.rate.empty() || part.starts_with("mode ");
    return out;
  }
  Signal motion() const {
    const std::string owner = subject(asked_.owner), &part = asked_.part;
    const bool point = !point_named(scene_, asked_.owner).body.empty();
    if (part == "velocity" || part == "speed") {
      Signal v = of(lengths(columns_.motion(owner + ".vx"), columns_.motion(owner + ".vy")), true);
      v.smooth = true;
      return v;
    }
    if (part == "acceleration") return of(lengths(columns_.motion(owner + ".ax"), columns_.motion(owner + ".ay")), true);
    if (part == "spin") return column_of(owner, "speed");
    if (point && (part == "ux" || part == "uy" || part == "turn") && columns_.has(owner + ".x") && !columns_.has(owner + "." + part))
      return zero();
    return column_of(owner, part);
  }
  Signal distance() const {
    const std::string a = subject(asked_.owner), b = subject(asked_.other);
    const std::vector<double> ax = columns_.motion(a + ".x"), ay = columns_.motion(a + ".y"), bx = columns_.motion(b + ".x"),
                              by = columns_.motion(b + ".y");
    if (ax.empty() || bx.empty()) return {};
    Signal out = zero();
    for (std::size_t i = 0; i < out.y.size(); ++i) out.y[i] = std::hypot(bx[i] - ax[i], by[i] - ay[i]);
    return out;
  }
  Signal stress() const {
    const std::string owner = subject(asked_.owner);
    for (const char* part : {".von Mises", ".stress"})
      if (columns_.has(owner + part)) {
        Signal out = of(columns_.motion(owner + part), true);
        out.smooth = false;  // it may be the larger stress of two fibres: its peak may be a kink
        return out;
      }
    return {};
  }
  Signal displacement() const {
    const std::string owner = subject(asked_.owner);
    if (columns_.has(owner + ".ux")) return of(lengths(columns_.motion(owner + ".ux"), columns_.motion(owner + ".uy")), true);
    return columns_.has(owner + ".x") ? zero() : Signal{};
  }
  Signal deflection() const {
    Signal out = zero();
    out.smooth = false;
    for (const BendingProbe& p : model_.bending) {
      if (p.body != asked_.owner) continue;
      Eigen::MatrixXd eta(p.displacement.cols(), static_cast<Eigen::Index>(out.y.size()));
      for (Eigen::Index m = 0; m < eta.rows(); ++m) {
        const std::vector<double> mode = columns_.motion(p.body + ".mode " + std::to_string(m + 1));
        eta.row(m) = Eigen::Map<const Eigen::RowVectorXd>(mode.data(), eta.cols());
      }
      for (Eigen::Index r = 0; r < eta.cols(); ++r) {
        const Eigen::VectorXd u = p.displacement * eta.col(r);
        double& greatest = out.y[static_cast<std::size_t>(r)];
        for (Eigen::Index i = 0; i + 1 < u.size(); i += 2) greatest = std::max(greatest, u.segment<2>(i).norm());
      }
    }
    return out;
  }

  Signal energy() const {
    Signal out = zero();
    if (const std::vector<double> y = columns_.book(asked_.part); !y.empty()) out.y = y;  // strain: missing in a rigid scene
    out.magnitude = false;
    return out;
  }
  Signal lost() const {
    Signal out = zero();
    out.magnitude = false;
    const std::string end = ".lost to " + asked_.part;
    out.y = columns_.sum([&](const std::string& name) {
      const auto at = name.find(".lost to ");
      return at != std::string::npos && (asked_.owner.empty() || name.substr(0, at) == asked_.owner) &&
             (asked_.part.empty() || name.ends_with(end));
    });
    return out;
  }
  Signal work() const {
    Signal out = zero();
    out.magnitude = false;
    out.y = columns_.sum(
        [&](const std::string& name) { return asked_.owner.empty() ? name.ends_with(".work in") : name == asked_.owner + ".work in"; });
    return out;
  }
  Signal column() const {
    if (asked_.owner.empty()) return energy();
    return column_of(subject(asked_.owner), asked_.part);
  }

  const Asked& asked_;
  const Scene& scene_;
  const Model& model_;
  const Run& run_;
  Columns columns_;
};

}  // namespace

std::vector<Passage> passages_of(const Measure& measure, const Scene& scene, const Run& run) {
  const PointRef p = point_named(scene, measure.path->point);
  const std::string name = p.body + "." + p.point;
  const Columns columns(run);
  return passages(*measure.path, {columns.times(), columns.motion(name + ".x"), columns.motion(name + ".y"), columns.motion(name + ".vx"),
                                  columns.motion(name + ".vy")});
}

MeasuredValue measured(const Measure& measure, const Scene& scene, const Model& model, const Run& run) {
  const Asked asked = read_measure(measure, scene);
  if (asked.what == What::path)
    return {run.t_end < planned_end(scene, run) * (1 - 1e-9) ? nan : rms_distance(passages_of(measure, scene, run)), asked.unit};
  return {Measuring(asked, scene, model, run).value(), asked.unit};
}

std::vector<double> curve(const Measure& measure, const Scene& scene, const Model& model, const Run& run) {
  const Asked asked = read_measure(measure, scene);
  return Measuring(asked, scene, model, run).rows();
}

std::string measured_unit(const Measure& measure, const Scene& scene) {
  return of_modes(measure.question) ? read_mode_measure(measure, scene).unit : read_measure(measure, scene).unit;
}

}  // namespace pintle
