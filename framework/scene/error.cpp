#include "framework/scene/error.h"

namespace pintle {

namespace {
std::string sentence(const std::string& file, const Place& place, const std::string& message) {
  std::string s = file.empty() ? "scene" : file;
  if (place.line > 0) s += ":" + std::to_string(place.line);
  if (!place.key.empty()) s += ": " + place.key;
  return s + ": " + message;
}
}  // namespace

SceneError::SceneError(const std::string& file, const Place& place, const std::string& message)
    : std::runtime_error(sentence(file, place, message)) {}

}  // namespace pintle
