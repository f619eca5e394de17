#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pintle {

/// Extension of a file name, with its dot, in lower case: ".png" of "Frame.PNG".
std::string ending_of(const std::filesystem::path&);

/// File names for elements with arbitrary names. Anything except ASCII letters, digits, `.`, `-` and `_` becomes `_`, long names are
/// shortened, and a number is added where two would be equal apart from case.
class FileNames {
 public:
  /// @param taken  names already in use
  explicit FileNames(std::vector<std::string> taken = {});
  /// @param otherwise  used for an empty name
  std::string add(const std::string& name, const std::string& otherwise);

 private:
  std::vector<std::string> taken_;  ///< in lower case
};

}  // namespace pintle
