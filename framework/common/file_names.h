#pragma once

#include <string>
#include <vector>

namespace pintle {

/// Names of files for things whose names may hold anything. What is no ASCII letter, digit, `.`, `-` or `_` becomes `_`, long
/// names are cut, and a number follows where two would be the same but for case.
class FileNames {
 public:
  /// @param taken  names that others have
  explicit FileNames(std::vector<std::string> taken = {});
  /// @param otherwise  for a name of nothing
  std::string add(const std::string& name, const std::string& otherwise);

 private:
  std::vector<std::string> taken_;  ///< in lower case
};

}  // namespace pintle
