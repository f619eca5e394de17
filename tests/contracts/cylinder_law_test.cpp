// What the exam in normal_law_test.cpp does not ask of laws of cylinders and tables: where they end, that they agree with each other
// and with Persson's theory, that tables keep to their points.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/contracts/elastic_samples.h"

namespace pintle::cylinder_law_test {
namespace {

using namespace elastic_samples;

double force(const DampedLaw& law, double depth) { return evaluate(law, {depth, 0, 1}).force; }
/// Hertz's half-width over the smaller radius.
double half_angle(const Geometry& g, double f) {
  return 2 * std::sqrt(f * g.R / (M_PI * modulus() * length)) / std::min(std::abs(g.a), std::abs(g.b));
}

TEST(CylinderLaws, AllSitTheExam) {
  for (const CylinderLaw& law : cylinder_laws()) {
    const auto sat = std::ranges::count(all(), law.name, &Sample::name);
    EXPECT_GE(sat, law.external ? 2 : 1) << law.name << ": add a line to elastic_samples.h";
  }
  EXPECT_EQ(find_cylinder_law("hertz"), nullptr);
}

// The ledger's stored energy against Simpson's rule in the root of the depth, between the points of a table.
TEST(CylinderLaws, StoreTheIntegralOfTheirForce) {
  constexpr int parts = 2000;
  for (const Sample& sample : all())
    for (const double end : {1e-6, 1.2e-5, 3.7e-5, 1e-3}) {
      const auto integrand = [&](double root) { return 2 * root * sample.force(root * root); };
      std::vector<double> ends{0};
      for (const auto& point : points())
        if (sample.name == "table" && point[0] > 0 && point[0] < end) ends.push_back(std::sqrt(point[0]));
      ends.push_back(std::sqrt(end));
      double sum = 0;
      for (std::size_t i = 1; i < ends.size(); ++i) {
        const double h = (ends[i] - ends[i - 1]) / parts;
        for (int j = 0; j < parts; j += 2) {
          const double x = ends[i - 1] + j * h;
          sum += h / 3 * (integrand(x) + 4 * integrand(x + h) + integrand(x + 2 * h));
        }
      }
      EXPECT_NEAR(evaluate(sample.law, {end, 0, 1}).stored / sum, 1, 1e-8) << sample.name << " at " << end;
    }
}

TEST(CylinderLaws, EndWhereTheContactIsWide) {
  for (const double clearance : {1e-5, 1e-4, 1e-3})
    for (const char* name : {"johnson", "radzimovsky", "esdu", "pereira"}) {
      const Geometry g = pin_in_hole(clearance);
      const DampedLaw known = law(name, g);
      EXPECT_NEAR(half_angle(g, force(known, known.deepest)), M_PI / 6, 1e-12) << name;
      EXPECT_EQ(range_warning(known, known.deepest), "");
      EXPECT_NE(range_warning(known, 1.001 * known.deepest).find("30 degrees"), std::string::npos);
    }
  EXPECT_EQ(range_warning(ImpactLaw{.k = 1e9}, 1), "");
  const DampedLaw thin = find_cylinder_law("goldsmith")->law({9.9e-3, -10e-3, 2e-3, modulus()});
  EXPECT_NE(range_warning(thin, 1e-3).find("wider than it is long"), std::string::npos);
  const DampedLaw wide = law("liu", pin_in_hole(1e-4));
  EXPECT_NEAR(std::acos(1e-4 / (1e-4 + wide.deepest)), M_PI / 3, 1e-12);
}

// At the end of its range a half-space carries a sixth less than two like bodies of Persson's at the same half-angle, b = tan²(ε/2).
TEST(CylinderLaws, EndNearPerssonsTheory) {
  const auto persson_over_hertz = [](double angle) {
    const double b = std::pow(std::tan(angle / 2), 2);
    return 8 * b * (1 + b) / (2 - std::log1p(b) - 2 * b * b) / (angle * angle);
  };
  EXPECT_NEAR(persson_over_hertz(1e-4), 1, 1e-7);
  EXPECT_NEAR(persson_over_hertz(M_PI / 6), 1.17, 5e-3);
}

TEST(CylinderLaws, AgreeByOrderOfMagnitude) {
  for (const double clearance : {5e-5, 1e-4, 5e-4})
    for (const double load : {1e2, 1e3, 1e4, 1e5}) {
      const Geometry g = pin_in_hole(clearance);
      if (half_angle(g, load) > M_PI / 6) continue;
      const auto depth = [&](const char* name) {
        const DampedLaw known = law(name, g);
        return bisect(0, 1e-2, [&](double x) { return force(known, x) - load; });
      };
      const double here = depth("johnson");
      const auto between = [&](const char* name, double least, double most) {
        EXPECT_GT(depth(name) / here, least) << name << " at " << clearance << " m, " << load << " N";
        EXPECT_LT(depth(name) / here, most) << name << " at " << clearance << " m, " << load << " N";
      };
      between("radzimovsky", 1.02, 1.1), between("pereira", 0.9, 1.2), between("goldsmith", 1.05, 1.45), between("esdu", 1.15, 1.75);
      between("liu", 1.5, 6);  // soft where the contact is narrow
    }
}

TEST(CylinderLaws, GoOnStraightWhereTheirLogarithmWouldTurn) {
  for (const Sample& sample : all()) {
    const auto* line = std::get_if<LogarithmicForce>(&sample.law.elastic);
    if (!line) continue;
    const double end = 2 * line->G * std::exp(-2.0) / line->S;
    EXPECT_GT(end, sample.law.deepest);
    for (const double part : {1 - 1e-9, 1 + 1e-9})
      EXPECT_NEAR(evaluate(sample.law, {part * end, 0, 1}).d_depth / line->S, 1, 1e-8) << sample.name;
  }
}

// Johnson 1985, §4.3: under a line load P/L the foundation touches over a half-width a with P/L = ⅔ (K a/h) (a²/R); ν = ¼ makes
// (1 − ν)E/((1 + ν)(1 − 2ν)) = 1.2 E.
TEST(Winkler, IsTheFoundationOfJohnsonWhereTheContactIsNarrow) {
  EXPECT_NEAR(foundation_modulus(2e9, 0.25, 1e-3), 2.4e12, 1e-3);
  for (const Geometry& g : {pin_in_hole(1e-4), pin_in_hole(1e-3), discs()})
    for (const double depth : {1e-12, 1e-10, 1e-9}) {
      const double a = std::sqrt(2 * g.R * depth);
      EXPECT_NEAR(force(law("winkler", g), depth) / (length * 2 / 3 * foundation * a * a * a / g.R), 1, 2 * depth / g.D + 1e-13) << depth;
    }
}

TEST(Winkler, EndsWhereItsLayerOrItsShapeDoes) {
  const DampedLaw thin = law("winkler", pin_in_hole(1e-4));
  EXPECT_NEAR(thin.deepest, layer / 10, 1e-15);
  EXPECT_NE(range_warning(thin, 1.1e-4).find("a tenth of its thickness"), std::string::npos);
  Cylinders thick = cylinders(discs());
  thick.layer = 1;
  const DampedLaw wide = find_cylinder_law("winkler")->law(thick);
  EXPECT_NEAR(std::sqrt(2 * discs().R * wide.deepest), 5e-3, 1e-12);
  EXPECT_NE(range_warning(wide, 1e-2).find("wider than the smaller radius"), std::string::npos);
  thick = cylinders(pin_in_hole(1e-4));
  thick.layer = 1;
  EXPECT_NEAR(find_cylinder_law("winkler")->law(thick).deepest, 9.9e-4, 1e-12);
}

TEST(Winkler, LiesOnAFlatToo) {
  Cylinders c = cylinders(discs());
  c.b = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(force(find_cylinder_law("winkler")->law(c), 1e-6), winkler({10e-3, c.b, 0, 10e-3}, 1e-6), 1e-9);
}

TEST(ForceTable, KeepsToItsPoints) {
  const ElasticLaw table = force_table(points());
  double last = 0;
  for (const auto& [depth, force] : points()) {
    if (depth == 0) continue;
    EXPECT_NEAR(evaluate(table, depth).force / force, 1, 1e-13);
    EXPECT_NEAR(evaluate(table, depth * (1 - 1e-12)).stiffness / evaluate(table, depth * (1 + 1e-12)).stiffness, 1, 1e-9);
  }
  for (int i = 1; i < 5000; ++i) {
    const double now = evaluate(table, 1e-8 * i).force;
    EXPECT_GT(now, last);
    last = now;
  }
  EXPECT_NEAR(evaluate(ElasticLaw(force_table({{0, 0}, {2e-6, 50}})), 5e-6).force, 125, 1e-11);
}

TEST(ForceTable, RefusesWhatDoesNotRise) {
  EXPECT_THROW(force_table({{0, 0}}), std::invalid_argument);
  EXPECT_THROW(force_table({{1e-6, 0}, {2e-6, 5}}), std::invalid_argument);
  EXPECT_THROW(force_table({{0, 1}, {2e-6, 5}}), std::invalid_argument);
  EXPECT_THROW(force_table({{0, 0}, {1e-6, 5}, {1e-6, 6}}), std::invalid_argument);
  EXPECT_THROW(force_table({{0, 0}, {1e-6, 5}, {2e-6, 5}}), std::invalid_argument);
}

TEST(NormalLaw, SaysHowStiffItIs) {
  const NormalLaw table = DampedLaw{.elastic = force_table({{0, 0}, {2e-6, 50}}), .deepest = 2e-6, .name = "table"};
  EXPECT_EQ(stiffness_text(table), "2.5e+07 N/m (table, at 2e-06 m)");
  EXPECT_EQ(stiffness_text(NormalLaw(ImpactLaw{.k = 1e10, .n = 1.5})), "1e+10 N/m^1.5");
  EXPECT_EQ(range_warning(table, 3e-6), "its depth reached 3e-06 m, beyond 2e-06 m where its law, table, ends: ");
}

}  // namespace
}  // namespace pintle::cylinder_law_test
