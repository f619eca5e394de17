// The scene's own states, and elements made of states: a lag, a PID controller, a rate limiter.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "framework/common/text.h"
#include "framework/scene/units/expression.h"
#include "framework/scene/units/signal_words.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

const std::array<KindKeys, 4> state_kinds{{{"rate", {"start", "unit", "scale", "repeat"}},
                                           {"lag", {"time", "lead", "start", "unit", "scale", "repeat"}},
                                           {"pid", {"gains", "filter", "limits", "tracking", "start", "unit", "scale", "repeat"}},
                                           {"rate limit", {"most", "time", "start", "unit", "scale", "repeat"}}}};

void need_key(const Node& node, std::string_view key, const std::string& example) {
  if (!node.has(key)) node.fail("lacks a required key; add for example " + std::string(key) + ": " + example);
}

Quantity quantity_of(const Node& node, const std::string& remedy) {
  try {
    return read_quantity(node.text(remedy), node.parameters());
  } catch (const ExpressionError& error) {
    node.fail(error.what());
  }
}

// A state of an element, with its rate as an expression.
struct StateOfKind {
  std::string name, rate;
};
struct MadeOfStates {
  std::vector<StateOfKind> states;
  std::string output = {};  // expression that its name stands for; empty: the state
  double size = 0;          // magnitude of its values; 0: unknown
};

std::string followed(const Node& node, const char* kind) { return "(" + node.at(kind).expression("an expression such as arm.angle") + ")"; }

// First-order lag: x' = (e - x)/T; with a lead L, the output is x + L x' = L/T e + (1 - L/T) x.
MadeOfStates lag_of(const Node& node) {
  need_key(node, "time", "20 ms");
  const std::string e = followed(node, "lag");
  const double time = node.at("time").quantity(dimension::time, rule::positive);
  const std::string T = exact_text(time, dimension::time);
  if (!node.has("lead")) return {{{node.name(), "(" + e + " - " + node.name() + ")/" + T}}};
  const double part = node.at("lead").quantity(dimension::time, rule::not_negative) / time;
  const std::string x = node.name() + " lag";
  return {{{x, "(" + e + " - " + x + ")/" + T}}, exact_text(part, {}) + "*" + e + " + " + exact_text(1 - part, {}) + "*" + x};
}

// r' = (e - r)/T, limited to the range [least, greatest].
MadeOfStates limited_rate_of(const Node& node, const Dimension& d) {
  need_key(node, "most", "3 rad/s");
  need_key(node, "time", "1 ms");
  const std::string e = followed(node, "rate limit");
  const std::string T = exact_text(node.at("time").quantity(dimension::time, rule::positive), dimension::time);
  const Node most = node.at("most");
  const Dimension rate = product(d, dimension::rate);
  double least = 0, greatest = 0;
  if (most.is_list()) {
    const std::vector<Node> ends = most.items(2, "one rate, or the least and the greatest: [-1 rad/s, 3 rad/s]");
    least = ends[0].quantity(rate), greatest = ends[1].quantity(rate);
    if (!(least < 0 && greatest > 0))
      most.fail(most.shown() + " must allow both directions, down below 0 and up above 0; write for example [-1 rad/s, 3 rad/s]");
  } else {
    greatest = most.quantity(rate, rule::positive), least = -greatest;
  }
  return {{{node.name(),
            "saturate((" + e + " - " + node.name() + ")/" + T + ", " + exact_text(least, rate) + ", " + exact_text(greatest, rate) + ")"}}};
}

struct Gains {
  Quantity proportional, integral, derivative;
};
Gains gains_of(const Node& node) {
  constexpr const char* remedy = "three gains, of the error, its integral and its rate, 0 for absent terms: [40 N m, 15 N m/s, 4 N m s]";
  need_key(node, "gains", "[40 N m, 15 N m/s, 4 N m s]");
  const std::vector<Node> list = node.at("gains").items(3, remedy);
  const Gains out{quantity_of(list[0], remedy), quantity_of(list[1], remedy), quantity_of(list[2], remedy)};
  if (out.proportional.value == 0 && out.integral.value == 0 && out.derivative.value == 0)
    node.at("gains").fail("has no gain; give one of them");
  return out;
}

// Tracking time of the anti-windup [s]; by default the gain of the error over that of its integral.
double tracking_of(const Node& node, const Gains& k) {
  if (node.has("tracking")) return node.at("tracking").quantity(dimension::time, rule::positive);
  const double time = k.proportional.value / k.integral.value;
  if (time > 0) return time;
  node.fail(
      "does not say how fast its integral returns from beyond the limits; add tracking: 0.1 s (by default the gain of the error over "
      "that of its integral, if both have the same sign)");
}

std::optional<std::array<double, 2>> limits_of(const Node& node, const Dimension& d) {
  if (!node.has("limits")) return {};
  const std::vector<Node> ends = node.at("limits").items(2, "the least and the greatest value [-9 N m, 9 N m]");
  const double least = ends[0].quantity(d), greatest = ends[1].quantity(d);
  if (!(least < greatest)) node.at("limits").fail(node.at("limits").shown() + " must have the lower limit first");
  return std::array{least, greatest};
}

// v = P e + I + D ė with I' = K e and ė filtered: x' = (D/T e - x)/T, D ė = D/T e - x. The output u is v within the limits; anti-windup by
// back-calculation with the tracking time Tt: I' = K e + (u - v)/Tt.
MadeOfStates pid_of(const Node& node, const Dimension& d) {
  const Gains k = gains_of(node);
  const std::string e = followed(node, "pid");
  const std::string integral = node.name() + " integral", filter = node.name() + " filter";
  const auto limits = limits_of(node, d);
  MadeOfStates out;
  std::vector<std::string> terms;
  if (k.proportional.value != 0) terms.push_back(exact_text(k.proportional) + "*" + e);
  if (k.integral.value != 0) terms.push_back(integral);
  if (k.derivative.value != 0) {
    if (!node.has("filter"))
      node.fail("takes a rate of change, which needs a filter (a pure derivative would need future values); add for example filter: 2 ms");
    const double time = node.at("filter").quantity(dimension::time, rule::positive);
    const std::string part =
        exact_text({k.derivative.value / time, product(k.derivative.dimension, dimension::rate)}) + "*" + e + " - " + filter;
    terms.push_back(part);
    out.states.push_back({filter, "(" + part + ")/" + exact_text(time, dimension::time)});
  } else if (node.has("filter")) {
    node.at("filter").fail("belongs to a gain of the error's rate, the third of gains, which is 0; leave it out");
  }
  std::string asked;
  for (const std::string& term : terms) asked += (asked.empty() ? "" : " + ") + term;
  out.output = asked;
  if (limits) {
    out.output = "saturate(" + asked + ", " + exact_text((*limits)[0], d) + ", " + exact_text((*limits)[1], d) + ")";
    out.size = std::max(std::abs((*limits)[0]), std::abs((*limits)[1]));
  }
  const bool led_back = limits && k.integral.value != 0;
  if (!led_back && node.has("tracking")) node.at("tracking").fail("belongs to limits and a gain of the integral; leave it out");
  if (k.integral.value == 0) {
    if (node.has("start"))
      node.at("start").fail("is where the integral starts, but this pid has no integral; leave it out (unit says what it is measured in)");
    return out;
  }
  std::string rate = exact_text(k.integral) + "*" + e;
  if (led_back) rate += " + (" + out.output + " - (" + asked + "))/" + exact_text(tracking_of(node, k), dimension::time);
  out.states.insert(out.states.begin(), {integral, rate});
  return out;
}

// Dimension of an expression, if all its names are known by now; springs and later states are not.
std::optional<Dimension> dimension_if_known(const Node& node, const std::string& text, const Scene& scene) {
  try {
    return read_measured_law(text, node.source().parameters, signal_names(signal_words(scene), SignalUse::written)).dimension;
  } catch (const ExpressionError&) {
    return {};
  }
}

// Dimension of the value of a key; a number without a unit has none.
Dimension dimension_at(const Node& node, const char* key) {
  if (!node.has(key)) return {};
  const Node value = node.at(key);
  return quantity_of(value.is_list() ? value.list(1, "the least and the greatest value [-9 N m, 9 N m]")[0] : value,
                     "a value such as 0 rad s")
      .dimension;
}

// From the unit, or that of a value; otherwise from the expression that the state follows.
Dimension dimension_of_state(const Node& node, const std::string& kind, const Scene& scene) {
  if (node.has("unit")) return quantity_of(node.at("unit"), "a unit such as rad s").dimension;
  const Dimension start = dimension_at(node, "start");
  if (kind == "rate" || !bare(start)) return start;
  if (const Dimension limits = dimension_at(node, "limits"); !bare(limits)) return limits;
  const std::string e = followed(node, kind.c_str());
  if (kind == "rate limit" && !bare(dimension_at(node, "most")))
    return dimension_if_known(node, e, scene).value_or(product(dimension_at(node, "most"), dimension::time));
  if (kind != "pid") return dimension_if_known(node, e, scene).value_or(Dimension{});
  const Gains k = gains_of(node);
  const std::string per_time = k.proportional.value != 0 ? exact_text(k.proportional) + "*" + e
                               : k.integral.value != 0   ? exact_text(k.integral) + "*(1 s)*" + e
                                                         : exact_text(k.derivative) + "/(1 s)*" + e;
  return dimension_if_known(node, per_time, scene).value_or(Dimension{});
}

MadeOfStates made_of_states(const Node& node, const std::string& kind, const Dimension& d) {
  if (kind == "lag") return lag_of(node);
  if (kind == "pid") return pid_of(node, d);
  if (kind == "rate limit") return limited_rate_of(node, d);
  return {{{node.name(), ""}}};
}

void check_part_name(const Node& node, const std::string& part, const Scene& scene, const Node& root) {
  const bool taken = root.at("states").has(part) || (root.has("outputs") && root.at("outputs").has(part)) ||
                     std::ranges::find(scene.states, part, &SceneState::name) != scene.states.end();
  if (part != node.name() && taken)
    node.fail("has a state \"" + part + "\" of its own, but something else already has this name; rename one of them");
}

std::string hint_of_unit(const Node& node) {
  return node.has("unit") || node.has("start") || node.has("limits") ? "" : " (unit: says what " + node.name() + " is measured in)";
}

/// The value that gives the unit of a state.
std::optional<Node> says_unit(const Node& node) {
  for (const char* key : {"unit", "start", "limits"})
    if (!bare(dimension_at(node, key))) return node.at(key).is_list() ? node.at(key).list(1, "")[0] : node.at(key);
  return {};
}

[[noreturn]] void fail_for_unit(const Node& node, const std::string& subject, const Dimension& is, const Dimension& expected,
                                const std::string& whose) {
  node.fail(subject + " is " + describe(is) + "; expected " + describe(expected) + whose);
}

/// Dimension of the term of each gain that is not 0, and its index in the list.
struct MadeByGain {
  std::size_t gain;
  Dimension dimension;
};
std::vector<MadeByGain> made_by_gains(const Node& node, const std::string& e, const SignalNames& names) {
  const Gains k = gains_of(node);
  const std::array<std::pair<Quantity, const char*>, 3> terms{{{k.proportional, "*"}, {k.integral, "*(1 s)*"}, {k.derivative, "/(1 s)*"}}};
  std::vector<MadeByGain> out;
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (terms[i].first.value != 0)
      out.push_back({i, read_measured_law(exact_text(terms[i].first) + terms[i].second + e, node.source().parameters, names).dimension});
  return out;
}

void blame_gains(const Node& node, const std::string& e, const Dimension& d, const SignalNames& names) {
  constexpr std::array of{"the error", "the error's integral", "the error's rate"};
  const std::vector<MadeByGain> made = made_by_gains(node, e, names);
  const auto fits = [&](const MadeByGain& one) { return same(one.dimension, d); };
  const bool agree = std::ranges::all_of(made, [&](const MadeByGain& one) { return same(one.dimension, made.front().dimension); });
  if (const auto unit = says_unit(node); unit && agree && !fits(made.front()))
    fail_for_unit(*unit, unit->shown(), d, made.front().dimension, ", as the gains require");
  const auto wrong = std::ranges::find_if_not(made, fits);
  if (wrong == made.end()) return;
  const Node gain = node.at("gains").items(3, "three gains")[wrong->gain];
  fail_for_unit(gain, gain.shown() + " times " + of[wrong->gain], wrong->dimension, d, hint_of_unit(node));
}

/// Reports the key whose value makes an element unreadable; returns if none is found.
void blame_a_key(const Node& node, const std::string& kind, const Dimension& d, const SignalNames& names) {
  const Node followed_at = node.at(kind);
  const std::string e = followed_at.expression("an expression such as arm.angle");
  try {
    const Dimension of = read_measured_law(e, node.source().parameters, names).dimension;
    if (kind == "pid") return blame_gains(node, "(" + e + ")", d, names);
    if (same(of, d)) return;
    if (const auto unit = says_unit(node)) fail_for_unit(*unit, unit->shown(), d, of, ", as what it follows");
    fail_for_unit(followed_at, followed_at.shown(), of, d, hint_of_unit(node));
  } catch (const ExpressionError& error) {
    followed_at.fail(error.what());
  }
}

}  // namespace

void read_states(const Node& root, Scene& scene) {
  if (!root.has("states")) return;
  for (const Node& node : root.at("states").entries("names and states: {integral: {rate: setpoint - arm.angle, start: 0 rad s}}")) {
    check_signal_name(node, scene, "a state");
    check_keys(node, "states.*");
    if (std::ranges::none_of(state_kinds, [&](const KindKeys& k) { return node.has(k.kind); }))
      node.fail("lacks a required key; add for example rate: setpoint - arm.angle, or say what it is by lag, pid or rate limit");
    const std::string kind = state_kinds[which_kind(node, state_kinds)].kind;
    const Dimension d = dimension_of_state(node, kind, scene);
    SceneState state;
    state.place = node.place();
    state.unit = si_unit(d);
    const MadeOfStates made = made_of_states(node, kind, d);
    read_optional(node, "start", d, rule::any, state.start);
    if (state.start != 0) state.scale = std::abs(state.start);
    if (made.size > 0) state.scale = made.size;
    read_optional(node, "scale", d, rule::positive, state.scale);
    for (const StateOfKind& part : made.states) {
      check_part_name(node, part.name, scene, root);
      state.name = part.name, state.rate.text = part.rate;
      scene.states.push_back(state);
      state.start = 0;
    }
    if (!made.output.empty())
      scene.outputs.push_back({node.name(), {.at = {}, .text = made.output, .constant = false}, state.unit, node.place()});
  }
}

void read_state_rates(const Node& root, Scene& scene) {
  if (!root.has("states")) return;
  ActingSignals signals(root, scene);
  const SignalNames& names = signals.names();
  const auto made = [&](const Node& node, const std::string& text, const Dimension& d) {
    try {
      return read_law(text, d, node.source().parameters, &names);
    } catch (const ExpressionError& error) {
      blame_a_key(node, state_kinds[which_kind(node, state_kinds)].kind, names.find(node.name())->second.dimension, names);
      node.fail(error.what() + hint_of_unit(node));
    }
  };
  const std::vector<Node> entries = root.at("states").entries("");
  const auto entry = [&](const Place& place) {
    return *std::ranges::find_if(entries, [&](const Node& node) { return node.place().key == place.key; });
  };
  for (SceneState& state : scene.states) {
    if (state.place.key.starts_with("parameters.")) continue;
    const Node node = entry(state.place);
    const Dimension rate = product(names.find(state.name)->second.dimension, dimension::rate);
    state.rate = node.has("rate") ? read_rate(node.at("rate"), rate, scene, names) : made(node, state.rate.text, rate);
  }
  for (SceneOutput& output : scene.outputs)
    output.law = made(entry(output.place), output.law.text, names.find(output.name)->second.dimension);
}

}  // namespace pintle
