#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace pintle {

/// What a folder of results says of itself: run.json, sweep.json, …
struct Description {
  std::string question;  ///< the file's name without .json
  std::filesystem::path file;
  nlohmann::ordered_json json;
};

/// Nothing if there is no such file. @throws ResultsError  it is no JSON object
std::optional<Description> description(const std::filesystem::path& directory, const std::string& question);

/// What a page shows of it: the scene as text of at most so many bytes, nothing that is as long by itself.
nlohmann::ordered_json facts(const Description&, std::size_t most_text);

}  // namespace pintle
