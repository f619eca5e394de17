#include "framework/scene/error.h"

#include <locale>
#include <sstream>

namespace pintle {

namespace {
std::string file_of(const std::string& file, const Place& place) {
  return !place.file.empty() ? place.file : file.empty() ? "scene" : file;
}
std::string sentence(const std::string& file, const Place& place, const std::string& message) {
  std::ostringstream s;
  s.imbue(std::locale::classic());
  s << file_of(file, place);
  if (place.line > 0) s << ':' << place.line;
  if (!place.key.empty()) s << (place.line == set_by_override ? ": --set " : ": ") << place.key;
  s << ": " << message;
  return s.str();
}
}  // namespace

SceneError::SceneError(const std::string& in, const Place& where, const std::string& text)
    : std::runtime_error(sentence(in, where, text)), file(file_of(in, where)), message(text), place(where) {}

AssemblyError::AssemblyError(const std::string& in, const Place& where, const std::string& text)
    : std::runtime_error(sentence(in, where, text)), file(file_of(in, where)), message(text), place(where) {}

}  // namespace pintle
