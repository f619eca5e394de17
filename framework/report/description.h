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

/// Whether these are results of a run that is going on or was killed: tables end anywhere.
bool is_unfinished(const std::filesystem::path& directory);

/// The part shown on a page: the scene as text of at most `most_text` bytes, and no other entry that is as long.
nlohmann::ordered_json facts(const Description&, std::size_t most_text);

}  // namespace pintle
