// What a tolerance delivers: errors of whole runs, over the tolerance, by what the columns hold. The table in docs/results.md is these
// figures, printed by  run_tests --gtest_filter='Delivered*'.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/build/build.h"
#include "framework/scene/yaml/reader.h"

namespace pintle_scenes::delivered_error_test {
namespace {

using namespace pintle;

enum Kind { places, speeds, forces, energies, kinds };

/// By the unit of a column; none of time, of what is no motion or force.
int kind_of(const std::string& header) {
  static const std::map<std::string, Kind> units{{"[m]", places}, {"[rad]", places}, {"[m/s]", speeds}, {"[rad/s]", speeds},
                                                 {"[N]", forces}, {"[N m]", forces}, {"[J]", energies}};
  const std::size_t at = header.find('[');
  const auto found = at == std::string::npos ? units.end() : units.find(header.substr(at));
  return found == units.end() || header.starts_with("unexplained") ? kinds : found->second;
}

using Errors = std::array<double, kinds>;

/// Largest difference of columns of one unit, over the largest number of that unit.
void compare(const Table& found, const Table& truth, Errors& errors) {
  ASSERT_EQ(found.rows(), truth.rows());
  std::map<std::string, std::pair<double, double>> by_unit;  // largest difference, largest number
  for (const std::string& header : truth.header) {
    if (kind_of(header) == kinds) continue;
    const std::vector<double> a = found.column(header), b = truth.column(header);
    auto& [apart, size] = by_unit[header.substr(header.find('['))];
    for (std::size_t i = 0; i < b.size(); ++i) {
      apart = std::max(apart, std::abs(a[i] - b[i]));
      size = std::max(size, std::abs(b[i]));
    }
  }
  for (const auto& [unit, each] : by_unit) {
    double& worst = errors[static_cast<std::size_t>(kind_of(unit))];
    if (each.second > 0) worst = std::max(worst, each.first / each.second);
  }
}

struct Mechanism {
  std::string file;
  Overrides set;
};

Run run_by(const Mechanism& m, const std::string& method, const std::string& tolerance) {
  Overrides set = m.set;
  for (const auto& [key, value] : {std::pair<std::string, std::string>{"run.method", method},
                                   {"run.tolerance", tolerance},
                                   {"output.frames", "0"},
                                   {"output.every", "5 ms"}})
    set.emplace_back(key, value);
  const Scene scene = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/" + m.file, set);
  const Model model = build(scene);
  return simulate(scene, model, assemble(scene, model));
}

/// What docs/results.md says, from figures measured here and some three times as large.
struct Promise {
  std::string method;
  std::vector<std::string> tolerances;
  Errors times;  ///< of the tolerance, at the most
};
void PrintTo(const Promise& p, std::ostream* out) { *out << p.method; }

class Delivered : public testing::TestWithParam<Promise> {};

TEST_P(Delivered, ErrorsAreSoManyTimesTheTolerance) {
  const Mechanism mechanisms[] = {{"four_bar_spring.yaml", {{"run.until", "1 s"}}},
                                  {"slider_crank_clearance.yaml", {{"joints.gudgeon pin.clearance", "null"}, {"run.until", "0.2 s"}}},
                                  {"pendulum.yaml", {{"run.until", "2 s"}}}};
  const Promise& promise = GetParam();
  Errors worst{};
  for (const Mechanism& m : mechanisms) {
    const pintle::Run truth = run_by(m, "verner87", "1e-13");
    ASSERT_EQ(truth.status, Status::finished) << truth.reason;
    for (const std::string& tolerance : promise.tolerances) {
      SCOPED_TRACE(m.file + " at " + tolerance);
      const pintle::Run found = run_by(m, promise.method, tolerance);
      ASSERT_EQ(found.status, Status::finished) << found.reason;
      Errors errors{};
      compare(found.trajectory, truth.trajectory, errors);
      compare(found.ledger, truth.ledger, errors);
      for (std::size_t k = 0; k < kinds; ++k) worst[k] = std::max(worst[k], errors[k] / std::stod(tolerance));
    }
  }
  std::printf("| %s | %.3g | %.3g | %.3g | %.3g |\n", promise.method.c_str(), worst[places], worst[speeds], worst[forces], worst[energies]);
  for (std::size_t k = 0; k < kinds; ++k) EXPECT_LT(worst[k], promise.times[k]) << k;
}

INSTANTIATE_TEST_SUITE_P(Each, Delivered,
                         testing::Values(Promise{"rkf45", {"1e-5", "1e-6", "1e-7", "1e-8"}, {100, 600, 400, 100}},
                                         Promise{"dopri5", {"1e-5", "1e-6", "1e-7", "1e-8"}, {20, 100, 60, 20}},
                                         Promise{"verner87", {"1e-6", "1e-8", "1e-10"}, {20, 100, 60, 20}},
                                         Promise{"generalized-alpha", {"1e-4", "1e-5", "1e-6"}, {1e3, 1e4, 5e3, 1e3}}),
                         [](const auto& each) {
                           return each.param.method == "generalized-alpha" ? std::string("alpha") : each.param.method;
                         });

}  // namespace
}  // namespace pintle_scenes::delivered_error_test
