#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace pintle {

/// The description in a folder of results: run.json, sweep.json, …
struct Description {
  std::string question;  ///< the file's name without .json
  std::filesystem::path file;
  nlohmann::ordered_json json;
};

/// Nothing if there is no such file. @throws ResultsError  it is not a JSON object
std::optional<Description> description(const std::filesystem::path& directory, const std::string& question);

/// Whether these are results of a run in progress or killed, whose tables may end anywhere.
bool is_unfinished(const std::filesystem::path& directory);

/// The part shown on a page: the scene, cut to `most_text` bytes, the warnings, and all other entries of at most 20 kB.
nlohmann::ordered_json facts(const Description&, std::size_t most_text);

}  // namespace pintle
