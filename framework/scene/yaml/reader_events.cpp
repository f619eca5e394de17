#include <algorithm>

#include "framework/scene/units/guard.h"
#include "framework/scene/yaml/reader_parts.h"

namespace pintle {

namespace {

std::vector<std::string> read_names(const Node& node) {
  constexpr const char* what = "the name of a joint, driver, force or contact, or a list of them";
  if (!node.is_list()) return {node.text(what)};
  std::vector<std::string> out;
  for (const Node& item : node.list(1, what)) out.push_back(item.text(what));
  return out;
}

SceneDoing read_doing(const Node& node, const std::string& keys) {
  check_keys(node, keys);
  SceneDoing out;
  if (node.has("release")) out.release = read_names(node.at("release"));
  if (node.has("engage")) out.engage = read_names(node.at("engage"));
  for (const std::string& name : out.release)
    if (std::ranges::find(out.engage, name) != out.engage.end())
      node.at("engage").fail("\"" + name + "\" is released and engaged by one event; keep one of them");
  if (node.has("stop")) out.stop = node.at("stop").text("why the run stops: \"the crank has come to rest\"");
  if (node.has("save")) out.save = node.at("save").yes();
  if (node.has("row")) out.row = node.at("row").yes();
  return out;
}

// Of a condition that never changes, a function that does not either.
std::vector<Law> read_comparisons(const Node& node, const Law& condition) {
  if (condition.constant) {
    const double holds = condition.at(0).value;
    if (holds != 0 && holds != 1) node.fail(node.shown() + " is no condition; write a comparison such as t > 0.1 s");
    return {{[holds](double) { return Jet{holds - 0.5, 0, 0}; }, condition.text, true}};
  }
  std::vector<Law> out;
  try {
    for (Program& one : comparisons(*condition.at.target<Program>())) out.push_back({std::move(one), condition.text, false});
  } catch (const ExpressionError& error) {
    node.fail("\"" + condition.text + "\": " + error.what());
  }
  return out;
}

SceneEvent read_event(const Node& node) {
  SceneEvent event;
  event.name = checked_name(node);
  event.place = node.place();
  check_keys(node, "events.*");
  const Node when = node.at("when");
  event.guard = when.law(dimension::number);
  event.when = read_comparisons(when, event.guard);
  if (node.has("once")) event.once = node.at("once").yes();
  if (node.has("from start")) event.from_start = node.at("from start").yes();
  event.then = read_doing(node.at("do"), "events.*.do");
  if (node.has("else")) event.otherwise = read_doing(node.at("else"), "events.*.else");
  if (event.once && node.has("else"))
    node.at("else").fail("never comes: an event that comes once does not wait for its end; leave out once or else");
  return event;
}

}  // namespace

void read_events(const Node& root, Scene& scene) {
  if (!root.has("events")) return;
  for (const Node& node : root.at("events").entries("names and events: {trip: {when: t > 0.1 s, do: {release: latch pin}}}"))
    scene.events.push_back(read_event(node));
}

bool read_engaged(const Node& node) { return !node.has("engaged") || node.at("engaged").yes(); }

}  // namespace pintle
