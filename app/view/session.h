#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "framework/configuration/moved_by_hand.h"
#include "framework/mechanism/drawing.h"
#include "framework/scene/yaml/reader.h"

namespace pintle::app {

using SavedFiles = std::map<std::filesystem::path, std::filesystem::file_time_type>;

/// A scene being viewed: read again when a file that it reads is saved, and movable by hand. Answers are JSON, including errors.
/// Thread-safe.
class ViewSession {
 public:
  ViewSession(std::filesystem::path scene, Overrides);
  ~ViewSession();

  /// The scene to be drawn, or only {"version": n} if the page already has it.
  std::string now(long known);
  /// @param request  {"version", "body", "point": [x, y], "to": [x, y]}, the point in the body's axes from its mass centre
  /// @returns nothing if it is not such a request
  std::optional<std::string> drag(const std::string& request);
  /// Resets the motion to the assembled configuration of the scene.
  std::string again();

 private:
  struct Assembled;
  void read_if_saved();
  std::string drawing() const;

  std::filesystem::path scene_;
  Overrides overrides_;
  std::mutex one_at_a_time_;
  long version_ = 0;                         ///< of the files and the configuration
  std::vector<std::filesystem::path> read_;  ///< files that the scene named at the last reading
  SavedFiles saved_;
  std::string error_;
  std::unique_ptr<Assembled> assembled_;
};

}  // namespace pintle::app
