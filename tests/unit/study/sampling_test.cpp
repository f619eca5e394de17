// Which cases a sweep has: grids, lists, samples, and what is said of a wrong one.
#include "framework/study/sweep/sampling.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "framework/scene/units/expression.h"
#include "tests/refusal.h"

namespace pintle::sampling_test {
namespace {

Cases cases(const std::string& text) {
  const Yaml tree = parse_yaml(text, "study.yaml");
  const Source source{"study.yaml", {}};
  return read_cases(Node(tree, source, {tree.line, {}}));
}

std::string complaint(const std::string& text) {
  return pintle_test::refusal_by([&] { cases(text); });
}

/// Of one name, as SI numbers.
std::vector<double> column(const Cases& c, std::size_t name) {
  std::vector<double> out;
  for (const auto& row : c.values) out.push_back(read_quantity(*row[name]).value);
  return out;
}

TEST(SweepCases, AGridRunsThroughItsLastNameFirst) {
  const Cases c = cases("grid: {a: [1, 2], run.method: [dopri5, rkf45, verner87]}");
  ASSERT_EQ(c.size(), 6u);
  EXPECT_EQ(c.overrides(0), (Overrides{{"a", "1"}, {"run.method", "dopri5"}}));
  EXPECT_EQ(c.overrides(2), (Overrides{{"a", "1"}, {"run.method", "verner87"}}));
  EXPECT_EQ(c.overrides(3), (Overrides{{"a", "2"}, {"run.method", "dopri5"}}));
}

TEST(SweepCases, AListSetsInEachCaseWhatThatCaseNames) {
  const Cases c = cases("list: [{a: 1}, {b: 2}, {b: 3, a: 4}]");
  EXPECT_EQ(c.overrides(0), (Overrides{{"a", "1"}}));
  EXPECT_EQ(c.overrides(1), (Overrides{{"b", "2"}}));
  EXPECT_EQ(c.overrides(2), (Overrides{{"a", "4"}, {"b", "3"}}));
}

TEST(SweepCases, ColumnsAreWalkedInStep) {
  const Cases c = cases("list: {a: [1, 2], b: {from: 3, to: 4, count: 2}}");
  ASSERT_EQ(c.size(), 2u);
  EXPECT_EQ(c.overrides(1), (Overrides{{"a", "2"}, {"b", "4"}}));
  EXPECT_NE(complaint("list: {a: [1, 2], b: [3]}").find("b: has 1 values, a has 2"), std::string::npos)
      << complaint("list: {a: [1, 2], b: [3]}");
}

TEST(SweepCases, TooManyValuesAreRefusedBeforeTheyAreMade) {
  std::string names = "{count: 1000000, ", columns = "{";
  for (int k = 0; k < 100; ++k) {
    const std::string name = (k > 0 ? ", a" : "a") + std::to_string(k);
    names += name + ": {from: 0, to: 1}";
    columns += name + ": {from: 0, to: 1, count: 1000000}";
  }
  for (const std::string& text :
       {"random: " + names + "}", "latin hypercube: " + names + "}", "list: " + columns + "}", "grid: " + columns + "}"})
    EXPECT_NE(complaint("{" + text + "}").find("has more than"), std::string::npos) << text.substr(0, 20);
}

TEST(SweepCases, GroupsAndListsAreValuesToo) {
  const Cases c = cases("grid: {bodies.rod.modes: [null, {craig-bampton: {count: 2}}]}");
  EXPECT_EQ(c.overrides(0)[0].second, "null");
  const Yaml back = parse_yaml("x: " + c.overrides(1)[0].second, "back");
  EXPECT_EQ(back.items[0].items[0].key, "craig-bampton");
  EXPECT_EQ(back.items[0].items[0].items[0].text, "2");
}

TEST(SweepCases, RangesMeetTheirEndsAndKeepTheirStepOrRatio) {
  const std::vector<double> even = column(cases("grid: {a: {from: 10 mm, to: 40 mm, count: 4}}"), 0);
  EXPECT_EQ(even, (std::vector<double>{0.01, 0.02, 0.03, 0.04}));
  const std::vector<double> log = column(cases("grid: {a: {from: 0.01 mm, to: 10 mm, count: 4, scale: log}}"), 0);
  EXPECT_EQ(log, (std::vector<double>{1e-5, 1e-4, 1e-3, 1e-2}));
}

TEST(SweepCases, APowerTakenByRootsIsThePower) {
  constexpr double rounding = 1e-11;  // half a unit of the twelfth digit, and 53 products
  for (double u : {0.0, 1e-9, 0.1, 1.0 / 3, 0.5, 0.77777, 1 - 1e-9, 1.0})
    for (double to : {3e-7, 1e-3, 2.0, 1e6}) {
      const double expected = 1e-3 * std::pow(to / 1e-3, u);
      EXPECT_NEAR((Span{1e-3, to, true}.at(u)), expected, rounding * expected) << u << " " << to;
    }
}

TEST(SweepCases, ALatinHypercubeHasOneCaseInEachStratum) {
  for (const int n : {1, 2, 7, 100}) {
    const Cases c =
        cases("latin hypercube: {count: " + std::to_string(n) + ", seed: 3, a: {from: -1, to: 4}, b: {from: 1 um, to: 1 mm, scale: log}}");
    std::set<int> a, b;
    for (double x : column(c, 0)) a.insert(static_cast<int>((x + 1) / 5 * n));
    for (double x : column(c, 1)) b.insert(static_cast<int>(std::log(x / 1e-6) / std::log(1e3) * n));
    EXPECT_EQ(a.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(b.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(*a.begin(), 0);
    EXPECT_EQ(*b.rbegin(), n - 1);
  }
}

TEST(SweepCases, RandomNumbersAreSpreadEvenly) {
  Stream stream(1, "clearance");
  constexpr int n = 100'000;
  double sum = 0, squares = 0;
  std::array<int, 10> counts{};
  for (int k = 0; k < n; ++k) {
    const double u = stream.uniform();
    ASSERT_TRUE(u >= 0 && u < 1);
    sum += u, squares += u * u;
    ++counts[static_cast<std::size_t>(10 * u)];
  }
  const double five_sigma = 5 / std::sqrt(12.0 * n);
  EXPECT_NEAR(sum / n, 0.5, five_sigma);
  EXPECT_NEAR(squares / n, 1.0 / 3, five_sigma);
  for (int c : counts) EXPECT_NEAR(c, n / 10, 5 * std::sqrt(0.09 * n));
}

TEST(SweepCases, TheSameStudyGivesTheSameCases) {
  const std::string text = "random: {count: 50, seed: 9, a: {from: 1 mm, to: 2 mm}, b: [x, y, z]}";
  EXPECT_EQ(cases(text).values, cases(text).values);
  EXPECT_NE(cases(text).values, cases("random: {count: 50, seed: 8, a: {from: 1 mm, to: 2 mm}, b: [x, y, z]}").values);
  // From the generator's recurrence, written out in another language: the same bits on every machine.
  Stream stream(9, "a");
  EXPECT_EQ(stream.uniform(), 0x1.85294f06f1be4p-1);
  EXPECT_EQ(stream.uniform(), 0x1.26e09107ee9efp-1);
  EXPECT_EQ(column(cases("random: {count: 3, seed: 9, a: {from: 1 mm, to: 2 mm}}"), 0),
            (std::vector<double>{0.00176008078537, 0.00157593205664, 0.00139598512157}));
}

TEST(SweepCases, WhatElseVariesDoesNotChangeAName) {
  const Cases one = cases("random: {count: 20, a: {from: 0, to: 1}}"),
              two = cases("random: {count: 30, b: {from: 0, to: 1}, a: {from: 0, to: 1}}");
  for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(one.values[k][0], two.values[k][1]);
}

TEST(SweepCases, WhatIsWrongIsNamedWithARemedy) {
  const std::map<std::string, std::string> faults{
      {"{limit: 3 s}", "does not say which cases it has; add grid, list, random or latin hypercube"},
      {"{grid: {a: [1]}, list: [{a: 1}]}", "at once; keep one of them"},
      {"{gird: {a: [1]}}", "Did you mean \"grid\"?"},
      {"{grid: {a: {from: 1 mm, to: 2 kg, count: 3}}}", "from is a length [m] and to is a mass [kg]"},
      {"{grid: {a: {from: 1 mm, to: 2 mm}}}", "add for example count: 50"},
      {"{grid: {a: {from: 0, to: 1, count: 3, scale: log}}}", "needs from and to greater than 0"},
      {"{grid: {a: {from: 1, to: 2, count: 3, scale: logarithmic}}}", "must be linear or log"},
      {"{grid: {a: {from: 0, to: 1, count: 2000}, b: {from: 0, to: 1, count: 2000}}}", "more than 1000000 combinations"},
      {"{random: {a: {from: 0, to: 1}}}", "add for example count: 100"},
      {"{random: {count: 3}}", "names nothing to vary"},
      {"{grid: {a: 5}}", "write a list such as [0.01 mm, 0.1 mm]"},
      {"{grid: {}}", "names nothing to vary"},
      {"{latin hypercube: {count: 3, a: 5}}", "{from: 0.01 mm"}};
  for (const auto& [text, words] : faults) EXPECT_NE(complaint(text).find(words), std::string::npos) << text << "\n" << complaint(text);
}

}  // namespace
}  // namespace pintle::sampling_test
