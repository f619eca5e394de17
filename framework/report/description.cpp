#include "framework/report/description.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "framework/report/csv_reader.h"
#include "framework/scene/yaml/json_text.h"

namespace pintle {

namespace {

constexpr std::size_t most_of_a_fact = 20'000;  // bytes

/// Its beginning, cut between UTF-8 characters.
std::string cut(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "\n… (" + std::to_string(text.size()) + " bytes in all)";
}

}  // namespace

std::optional<Description> description(const std::filesystem::path& directory, const std::string& question) {
  const std::filesystem::path file = directory / (question + ".json");
  std::ifstream in(file, std::ios::binary);
  const int error = errno;
  if (!in && (error == EACCES || error == EPERM))
    throw ResultsError(file.string() + ": cannot be read (" + std::strerror(error) + "); check its permissions");
  if (!in) return {};
  try {
    Description out{question, file, nlohmann::ordered_json::parse(in)};
    if (!out.json.is_object()) throw ResultsError(file.string() + ": contains no results; run the scene again, or correct the file");
    return out;
  } catch (const nlohmann::ordered_json::parse_error& e) {
    throw ResultsError(file.string() + ": is not JSON at byte " + std::to_string(e.byte) + "; run the scene again, or correct the file");
  }
}

bool is_unfinished(const std::filesystem::path& directory) {
  const auto run = description(directory, "run");
  return run && run->json.value("status", std::string()) == "unfinished";
}

nlohmann::ordered_json facts(const Description& results, std::size_t most_text) {
  nlohmann::ordered_json out = nlohmann::ordered_json::object();
  for (const auto& [name, value] : results.json.items()) {
    if (name == "scene") {
      if (value.is_object()) out["scene text"] = cut(json_text(value), most_text);
    } else if (json_text(value, -1).size() <= most_of_a_fact || name == "warnings") {
      out[name] = value;
    }
  }
  return out;
}

}  // namespace pintle
