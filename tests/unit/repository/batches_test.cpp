// Files that are compiled together share one anonymous namespace: a helper of one that fits a call in another better than the
// function meant there is taken for it without a word.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace pintle::batches_test {
namespace {

namespace fs = std::filesystem;

/// Without comments and strings.
std::string code_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream out;
  static const std::regex noise(R"(//.*|"(\\.|[^"\\])*")");
  for (std::string line; std::getline(in, line);) out << std::regex_replace(line, noise, "") << '\n';
  return out.str();
}

/// Names of the functions in anonymous namespaces, whose lines begin at the margin.
std::set<std::string> helpers_in(const fs::path& file) {
  static const std::regex function(R"(^[\w:<>,&*\[\] ]+[ &*](\w+)\()");
  std::set<std::string> out;
  std::ifstream in(file);
  bool local = false;
  for (std::string line; std::getline(in, line);) {
    if (line == "namespace {") local = true;
    if (line == "}  // namespace") local = false;
    std::smatch match;
    if (local && !line.empty() && line[0] != ' ' && line[0] != '/' && std::regex_search(line, match, function)) out.insert(match.str(1));
  }
  return out;
}

/// A function, lambda or member of this name is declared in the code itself.
bool declares(const std::string& code, const std::string& name) {
  const std::regex declaration(R"((\w+|[>&*\]])\s+[&*]?)" + name + R"(\s*[=({])");
  for (std::sregex_iterator i(code.begin(), code.end(), declaration), end; i != end; ++i)
    if (const std::string before = i->str(1); before != "return" && before != "else" && before != "throw" && before != "case") return true;
  return false;
}
bool calls(const std::string& code, const std::string& name) {
  return std::regex_search(code, std::regex(R"((^|[^\w.:>]))" + name + R"(\()"));
}

TEST(Batches, NoFileCallsAHelperOfAnother) {
  const fs::path batches = fs::path(PINTLE_BINARY_DIR) / "CMakeFiles/pintle.dir/Unity";
  if (!fs::exists(batches)) GTEST_SKIP() << "each file is compiled by itself";
  const std::regex include(R"re(#include "([^"]+)")re");
  for (const auto& entry : fs::directory_iterator(batches)) {
    std::vector<fs::path> files;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);)
      if (std::smatch match; std::regex_search(line, match, include)) files.emplace_back(match.str(1));
    std::vector<std::string> code;
    for (const fs::path& file : files) code.push_back(code_of(file));
    for (std::size_t i = 0; i < files.size(); ++i)
      for (const std::string& name : helpers_in(files[i]))
        for (std::size_t k = i + 1; k < files.size(); ++k)
          EXPECT_FALSE(calls(code[k], name) && !declares(code[k], name))
              << files[k] << " calls " << name << ", of which " << files[i]
              << ", compiled with it, has a helper; give the helper another name";
  }
}

TEST(Batches, CallsAndDeclarationsAreToldApart) {
  EXPECT_TRUE(calls("x = listed(names);", "listed"));
  EXPECT_FALSE(calls("x = a.listed(names);", "listed"));
  EXPECT_FALSE(declares("return listed(names);", "listed"));
  EXPECT_TRUE(declares("std::string listed(int n) {", "listed"));
  EXPECT_TRUE(declares("const auto listed = [&] {", "listed"));
}

}  // namespace
}  // namespace pintle::batches_test
