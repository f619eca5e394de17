#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "framework/configuration/moved_by_hand.h"
#include "framework/mechanism/drawing.h"
#include "framework/scene/yaml/reader.h"

namespace pintle::app {

/// A scene as it is looked at: read again when a file of its folder is saved, moved by hand. Answers are JSON, errors included. For
/// several threads.
class ViewSession {
 public:
  ViewSession(std::filesystem::path scene, Overrides);
  ~ViewSession();

  /// What is to be drawn, or {"version": n} alone if that is what the page has.
  std::string now(long known);
  /// @param request  {"version", "body", "point": [x, y], "to": [x, y]}, the point in the body's axes from its mass centre
  /// @returns nothing: that is no such request
  std::optional<std::string> drag(const std::string& request);
  /// As the scene assembles it.
  std::string again();

 private:
  struct Assembled;
  void read_if_saved();
  std::string drawing() const;

  std::filesystem::path scene_;
  Overrides overrides_;
  std::mutex one_at_a_time_;
  long version_ = 0;                                                        ///< of the files and the pose
  std::map<std::filesystem::path, std::filesystem::file_time_type> saved_;  ///< files that the scene may read from its folder
  std::string error_;
  std::unique_ptr<Assembled> assembled_;
};

}  // namespace pintle::app
