#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace pintle {

namespace fs = std::filesystem;

/// A folder of its own, gone at the end.
class SweepFolder {
 public:
  SweepFolder()
      : path_(fs::temp_directory_path() / ("pintle-sweep-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                                           "-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "-" +
                                           std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id())))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~SweepFolder() { fs::remove_all(path_); }
  fs::path operator/(const std::string& name) const { return path_ / name; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

 private:
  fs::path path_;
};

inline std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream s;
  s << in.rdbuf();
  return s.str();
}

/// A pendulum whose length, mass and start angle are parameters.
inline std::string pendulum_scene(const std::string& run = "{until: 0.2 s, tolerance: 1e-8}") {
  return R"(
gravity: [0, -9.81]
parameters: {mass: 0.5 kg, angle: 0 deg, length: 0.2 m}
bodies: {rod: {rigid: {mass: mass, inertia: 0.01 kg m^2}, points: {O: [-length, 0]}}}
joints: {hinge: {revolute: [ground, rod.O]}}
start: {rod: {angle: angle}}
run: )" + run +
         "\n";
}

}  // namespace pintle
