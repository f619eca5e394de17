#pragma once

#include <string>

namespace soak {

/// How a scene ended.
struct Verdict {
  bool good = false;
  std::string outcome;  ///< "finished", "scene refused: …": alike for alike endings, without numbers
  std::string detail;
  double steps = 0, seconds = 0;
};

/// What is asked of a scene; `agree`: whether another method comes to the same.
enum class Question { run, statics, kinematics, inverse, linearize, agree };
inline constexpr const char* question_names[] = {"run", "statics", "kinematics", "inverse", "linearize", "agree"};

/// Reads, builds and assembles a scene, and asks one thing of it. Good: refused with a reason; or an answer of finite numbers that says
/// it was found, or why not. Of a run also: points of every pin together, and books that close by their own columns. `twice`: a run must
/// repeat bit for bit. A run that takes longer than `seconds` is stopped.
Verdict judge(const std::string& scene, Question, bool twice, double seconds);

}  // namespace soak
