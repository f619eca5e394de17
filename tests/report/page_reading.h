#pragma once

// Pages read back by hand: what is embedded in them, with a decoder of its own.
#include <cstring>
#include <limits>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "framework/build/build.h"
#include "framework/analysis/simulate/simulate.h"
#include "framework/bodies/segments.h"
#include "framework/configuration/assemble.h"
#include "framework/output/results.h"
#include "framework/scene/yaml/reader.h"

namespace pintle_report_test {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A folder of this test alone, gone at its end.
class Folder {
 public:
  Folder() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("pintle_") + test.test_suite_name() + "_" + test.name();
    for (char& c : name)
      if (c == '/') c = '_';
    path_ = fs::path(testing::TempDir()) / name;
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// Runs a scene and writes its results as `pintle run` does.
inline void write_run(const fs::path& directory, const pintle::Scene& read) {
  const pintle::Scene scene = pintle::with_pieces(read);
  const pintle::Model model = pintle::build(scene);
  const pintle::Assembly assembly = pintle::assemble(scene, model);
  pintle::write_results(directory, scene, model, assembly, pintle::simulate(scene, model, assembly));
}

inline std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before);
  if (from == std::string::npos) return "";
  const std::size_t begin = from + before.size();
  return text.substr(begin, text.find(after, begin) - begin);
}

/// What a page shows.
inline Json data_of(const std::string& page) {
  return Json::parse(between(page, "<script type=\"application/json\" id=\"data\">", "</script>"));
}

inline std::string decoded(const std::string& base64) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0, many = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((many += 6) < 8) continue;
    many -= 8;
    out += static_cast<char>(bits >> many & 255U);
  }
  return out;
}

template <class Number>
std::vector<Number> numbers(const Json& base64) {
  const std::string bytes = decoded(base64.get<std::string>());
  std::vector<Number> out(bytes.size() / sizeof(Number));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(Number));
  return out;
}

/// A .csv file without quotes, read by std::stod.
struct PlainTable {
  std::vector<std::string> header;
  std::vector<std::vector<double>> rows;
};
inline PlainTable plain_table(const fs::path& file) {
  PlainTable out;
  std::ifstream in(file);
  std::string line, field;
  std::getline(in, line);
  for (std::istringstream fields(line); std::getline(fields, field, ',');) out.header.push_back(field);
  while (std::getline(in, line)) {
    out.rows.emplace_back();
    for (std::istringstream fields(line); std::getline(fields, field, ',');)
      out.rows.back().push_back(field.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(field));
  }
  return out;
}

}  // namespace pintle_report_test
