#pragma once

// What is asked of a refusal: that it comes, and what it says.
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pintle {
struct SceneError;
}

namespace pintle_test {

/// What the error says that `act` throws; "accepted": it throws none.
template <class Error = pintle::SceneError, class Act>
std::string refusal_by(const Act& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

inline bool says(const std::string& said, const std::string& part) { return said.find(part) != std::string::npos; }

inline void expect_says(const std::string& said, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_TRUE(says(said, part)) << "\"" << said << "\" lacks \"" << part << "\"";
}

/// It begins with its place: file, line and key.
inline void expect_one_line(const std::string& said, const std::string& place, const std::vector<std::string>& parts) {
  EXPECT_TRUE(said.starts_with(place)) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << "more than one line: " << said;
  expect_says(said, parts);
}

/// `act` is refused, in one line.
template <class Error = pintle::SceneError, class Act>
void expect_refused(const Act& act, const std::vector<std::string>& parts) {
  const std::string said = refusal_by<Error>(act);
  EXPECT_NE(said, "accepted");
  expect_one_line(said, "", parts);
}

}  // namespace pintle_test
