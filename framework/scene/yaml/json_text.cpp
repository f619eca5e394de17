#include "framework/scene/yaml/json_text.h"

#include <string_view>

#include <nlohmann/json.hpp>

#include "framework/scene/scene.h"

namespace pintle {

namespace {
template <class Json>
std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}
}  // namespace

std::string json_text(const nlohmann::ordered_json& json, int indent) { return text_of(json, indent); }
std::string json_text(const nlohmann::json& json, int indent) { return text_of(json, indent); }

std::string text_with_scene(const nlohmann::ordered_json& object, const Scene& scene) {
  if (scene.filled_in.empty()) {
    nlohmann::ordered_json with_none = object;
    with_none["scene"] = nullptr;
    return json_text(with_none) + "\n";
  }
  std::string out = json_text(object);
  out.resize(out.size() - 2);  // "\n}"
  out.reserve(out.size() + scene.filled_in.size() * 3 / 2);
  out += ",\n  \"scene\": ";
  std::string_view rest = scene.filled_in;
  for (std::size_t end; (end = rest.find('\n')) != rest.npos; rest.remove_prefix(end + 1)) out.append(rest, 0, end + 1).append("  ");
  out += rest;
  return out + "\n}\n";
}

}  // namespace pintle
