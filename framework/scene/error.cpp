#include "framework/scene/error.h"

#include <locale>
#include <sstream>

namespace pintle {

namespace {
std::string sentence(const std::string& file, const Place& place, const std::string& message) {
  std::ostringstream s;
  s.imbue(std::locale::classic());
  s << (!place.file.empty() ? place.file : file.empty() ? "scene" : file);
  if (place.line > 0) s << ':' << place.line;
  if (!place.key.empty()) s << (place.line == set_by_override ? ": --set " : ": ") << place.key;
  s << ": " << message;
  return s.str();
}
}  // namespace

SceneError::SceneError(const std::string& file, const Place& place, const std::string& message)
    : std::runtime_error(sentence(file, place, message)) {}

AssemblyError::AssemblyError(const std::string& file, const Place& place, const std::string& message)
    : std::runtime_error(sentence(file, place, message)) {}

}  // namespace pintle
