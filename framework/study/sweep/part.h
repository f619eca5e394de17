#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// A share of the cases of a sweep, for a process that does not communicate with others: a task of a job array. docs/studies.md
namespace pintle {

struct Sweep;

/// Part `number` of `count`.
struct SweepPart {
  std::size_t number = 1, count = 1;
  /// Number of the part that has case k, from 1. Each part has one of `count` consecutive cases; the next `count` are shifted by one part,
  /// so that in a grid no part has the same value of the last name in all its cases.
  static std::size_t with(std::size_t k, std::size_t count) { return (k - 1 + (k - 1) / count) % count + 1; }
  bool has(std::size_t k) const { return with(k, count) == number; }
};

/// From "3/8". @throws SceneError  it is no part: naming --shard and the remedy
SweepPart read_part(const std::string& text);
std::string part_text(const SweepPart&);  ///< "part 3 of 8"
/// Number of `cases` that a part has.
std::size_t cases_in(const SweepPart&, std::size_t cases);

/// Description of a part in its folder: part.json.
struct PartFile {
  SweepPart part;
  std::size_t cases = 0;                      ///< of the whole study
  std::string file;                           ///< path of the study, as given by the user
  std::string version;                        ///< of the program that ran it
  std::string study, study_text, scene_text;  ///< fingerprints: of the study with all that it names; of its text; of its scene's text
  std::vector<std::string> measures;          ///< their names
  std::uint64_t print = 0;                    ///< fingerprint of all above except the file's name, in the headings of the journals
};
PartFile part_file(const Sweep&);  ///< @pre it has a part
std::string part_json(const PartFile&);
/// @throws SceneError  it is damaged  @param path  for messages
PartFile read_part_file(const std::string& path, const std::string& text);

}  // namespace pintle
