#include "framework/scene/yaml/filled_in_parts.h"

namespace pintle {

namespace {

Json json(const SceneDoing& doing) {
  Json out = Json::object();
  if (!doing.release.empty()) out["release"] = doing.release;
  if (!doing.engage.empty()) out["engage"] = doing.engage;
  for (const auto& [state, value] : doing.set) out["set"][state] = value.constant ? Json(value.at(0).value) : Json(value.text);
  if (!doing.stop.empty()) out["stop"] = doing.stop;
  if (doing.save) out["save"] = true;
  if (doing.row) out["row"] = true;
  return out;
}

}  // namespace

Json json(const SceneEvent& event) {
  Json out = {{"when", event.guard.text}, {"once", event.once}, {"from start", event.from_start}, {"do", json(event.then)}};
  if (event.otherwise.does()) out["else"] = json(event.otherwise);
  return out;
}

}  // namespace pintle
