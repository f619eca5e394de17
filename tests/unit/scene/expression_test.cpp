#include "framework/scene/units/expression.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <thread>
#include <vector>

namespace pintle::expression_test {
namespace {

using pintle_test::expect_says;

constexpr double pi = std::numbers::pi;
constexpr double rounding = 1e-12;  // relative to the size of the terms summed

const Parameters parameters{
    {"clearance", {1e-5, dimension::length}}, {"speed", {150, dimension::angular_speed}}, {"turns", {3, dimension::number}}};

double value(const char* text, const Dimension& d) { return read_quantity(text, d, parameters); }

std::string refusal(const char* text, const Dimension& d = dimension::length) {
  return pintle_test::refusal_by<ExpressionError>([&] { read_quantity(text, d, parameters); });
}

std::string law_refusal(const char* text, const Dimension& d) {
  return pintle_test::refusal_by<ExpressionError>([&] { read_law(text, d, parameters); });
}

TEST(Quantity, UnitsConvertToSIToTheLastBit) {
  EXPECT_EQ(value("10 mm", dimension::length), 0.01);
  EXPECT_EQ(value("10 us", dimension::time), 1e-5);
  EXPECT_EQ(value("207 GPa", dimension::stress), 207e9);
  EXPECT_EQ(value("0.01 mm", dimension::length), 1e-5);
  EXPECT_EQ(value("300 g", dimension::mass), 0.3);
}

TEST(Quantity, AnglesAndTurningSpeedsAreInRadians) {
  EXPECT_DOUBLE_EQ(value("30 deg", dimension::angle), pi / 6);
  EXPECT_DOUBLE_EQ(value("30°", dimension::angle), pi / 6);
  EXPECT_DOUBLE_EQ(value("5000 rpm", dimension::angular_speed), 5000 * 2 * pi / 60);
  EXPECT_DOUBLE_EQ(value("2*pi/3", dimension::angle), 2 * pi / 3);
  EXPECT_DOUBLE_EQ(value("50*rev/s", dimension::angular_speed), 100 * pi);
}

// V = W/A, Ohm = V/A, H = V s/A, C = A s, F = C/V, and N m/A is V s.
TEST(Quantity, ElectricalUnitsAreThoseOfPower) {
  constexpr Dimension current{0, 0, 0, 0, 1}, voltage{2, 1, -3, 0, -1}, resistance{2, 1, -3, 0, -2};
  EXPECT_EQ(value("5 mA", current), 5e-3);
  EXPECT_DOUBLE_EQ(value("12 V*(2 A)", {2, 1, -3, 0}), 24);
  EXPECT_DOUBLE_EQ(value("2 kV/(4 A)", resistance), 500);
  EXPECT_DOUBLE_EQ(value("4.7 kΩ*(2 mA)", voltage), 9.4);
  EXPECT_DOUBLE_EQ(value("3 mH*(2 A)^2", dimension::torque), 12e-3);
  EXPECT_DOUBLE_EQ(value("10 uF*(2 V)^2", dimension::torque), 4e-5);
  EXPECT_DOUBLE_EQ(value("6 C/(2 s)", current), 3);
  EXPECT_DOUBLE_EQ(value("0.1 N m/A*(3 A)", dimension::torque), value("0.1 V s*(3 A)", dimension::torque));
  expect_says(refusal("3 V", current), {"a voltage [V]", "a current [A]"});
  expect_says(refusal("1 A + 1", current), {"a current [A]", "give the bare number its unit"});
  expect_says(refusal("2 A m", dimension::force), {"m*A"});
}

TEST(Quantity, BareNumberIsSI) {
  EXPECT_EQ(value("0.25", dimension::length), 0.25);
  EXPECT_EQ(value("-1.5e-3", dimension::force), -1.5e-3);
}

TEST(Quantity, ProductsAndPowersOfUnitsRead) {
  EXPECT_DOUBLE_EQ(value("3 N/mm", dimension::stiffness), 3000);
  EXPECT_EQ(value("5 N m", dimension::torque), 5);
  EXPECT_DOUBLE_EQ(value("2 mm^2", {2, 0, 0, 0}), 2e-6);
  EXPECT_EQ(value("1e-4 kg*m^2", dimension::inertia), 1e-4);
  EXPECT_EQ(value("1e-4 kg m²", dimension::inertia), 1e-4);
  EXPECT_EQ(value("9.81 m/s^2", dimension::acceleration), 9.81);
  EXPECT_EQ(value("8 N/m^1.5", {-0.5, 1, -2, 0}), 8);
  EXPECT_DOUBLE_EQ(value("sqrt(4 mm^2)", dimension::length), 2e-3);
  EXPECT_EQ(value("7 N m/rad", dimension::torsion_stiffness), 7);
}

TEST(Quantity, ArithmeticHasTheUsualPrecedence) {
  EXPECT_EQ(value("-2^2", {}), -4);
  EXPECT_EQ(value("2^3^2", {}), 512);
  EXPECT_EQ(value("5 - 3 - 1", {}), 1);
  EXPECT_EQ(value("8/4/2", {}), 1);
  EXPECT_EQ(value("2*-3", {}), -6);
  EXPECT_EQ(value("max(1, min(5, 4), 2)", {}), 4);
  EXPECT_EQ(value("if(1 < 2 && 2 != 3 || 1 > 2, 10, 20)", {}), 10);
}

TEST(Quantity, ParametersKeepTheirDimension) {
  EXPECT_EQ(value("clearance", dimension::length), 1e-5);
  EXPECT_DOUBLE_EQ(value("0.5*clearance + 1 um", dimension::length), 6e-6);
  EXPECT_DOUBLE_EQ(value("turns*30 deg", dimension::angle), pi / 2);
}

TEST(Quantity, PlainFractionOfAUnitIsAFraction) { EXPECT_DOUBLE_EQ(value("1/2 mm", dimension::length), 5e-4); }

TEST(Quantity, UnitAfterADivisionIsRefusedAsAmbiguous) {
  expect_says(refusal("10 mm/2 mm"), {"two ways", "/(2*mm)"});
  expect_says(refusal("5 N/m s"), {"two ways", "/(m*s)"});
  EXPECT_EQ(value("(10 mm)/(2 mm)", {}), 5);
}

TEST(Quantity, WrongDimensionNamesBoth) {
  expect_says(refusal("3 kg"), {"\"3 kg\"", "a mass [kg]", "expected a length [m]"});
  expect_says(refusal("30 deg"), {"an angle [rad]", "expected a length [m]"});
  expect_says(refusal("speed", dimension::angle), {"an angular speed [rad/s]"});
}

TEST(Quantity, SumOfDifferentDimensionsIsRefused) {
  expect_says(refusal("2 kg + 1 m"), {"+ mixes a mass [kg] and a length [m]"});
  expect_says(refusal("clearance + 1"), {"mixes", "give the bare number its unit"});
  EXPECT_EQ(value("max(clearance, 0)", dimension::length), 1e-5);  // zero fits every unit
}

TEST(Quantity, UnknownNameSuggestsTheNearest) {
  expect_says(refusal("clearence"), {"\"clearence\" is neither", "Did you mean \"clearance\"?"});
  expect_says(refusal("2 gpa"), {"there is no operator between 2 and gpa"});
  expect_says(refusal("gpa"), {"Did you mean \"GPa\"?"});
  expect_says(refusal("sine(1)"), {"no function \"sine\"", "Did you mean \"sin\"?"});
  expect_says(refusal("50 Hz"), {"Hz"});
  const std::string no_time = refusal("two kg");  // t is not offered where it may not stand
  expect_says(no_time, {"character 1: \"two\" is neither", "Known here: pi"});
  EXPECT_EQ(no_time.find("t, pi"), std::string::npos) << no_time;
}

TEST(Quantity, NonFiniteValuesAreRefused) {
  expect_says(refusal("1/0"), {"not a finite number"});
  expect_says(refusal("nan"), {"finite"});
  expect_says(refusal("inf"), {"finite"});
  expect_says(refusal(".inf"), {"no meaning"});
  expect_says(refusal("1e999"), {"too large"});
  expect_says(refusal("sqrt(-1)", {}), {"not a finite number"});
}

TEST(Quantity, MalformedTextSaysWhatIsMissing) {
  expect_says(refusal("2*(3"), {"parenthesis is not closed", "quotes"});
  expect_says(refusal("2)"), {"was not opened"});
  expect_says(refusal("2*"), {"ends too early"});
  expect_says(refusal("1,5 mm"), {"decimal point"});
  expect_says(refusal("2 3"), {"there is no operator between 2 and 3"});
  expect_says(refusal(""), {"empty"});
  expect_says(refusal("sin(1, 2)", {}), {"too many arguments"});
  expect_says(refusal("atan2(1)", {}), {"too few arguments"});
  expect_says(refusal("2**3", {}), {"written ^"});
  expect_says(refusal("a ? 1 : 2"), {"if(condition, a, b)"});
  expect_says(refusal("3*t"), {"depends on t"});
}

TEST(Quantity, EndlessTextIsRefused) {
  EXPECT_NE(refusal(std::string(100000, '(').c_str()).find("longer than"), std::string::npos);
  EXPECT_THROW(read_quantity(std::string(1999, '-'), Parameters{}), ExpressionError);
}

TEST(Law, ConstantKnowsThatItIs) {
  const Law law = read_law("2*clearance", dimension::length, parameters);
  EXPECT_TRUE(law.constant);
  EXPECT_EQ(law.at(7).value, 2e-5);
  EXPECT_EQ(law.at(7).rate, 0);
  EXPECT_FALSE(read_law("3*t", dimension::angle).constant);
}

struct ClosedForm {
  const char* text;
  std::function<double(double)> f, f1, f2;
};

using std::atan, std::cos, std::exp, std::log, std::pow, std::sin, std::sqrt, std::tan;
const std::vector<ClosedForm> closed_forms{
    ClosedForm{"3*t^2 - t + 4", [](double t) { return 3 * t * t - t + 4; }, [](double t) { return 6 * t - 1; }, [](double) { return 6; }},
    ClosedForm{"sin(5*t)", [](double t) { return sin(5 * t); }, [](double t) { return 5 * cos(5 * t); },
               [](double t) { return -25 * sin(5 * t); }},
    ClosedForm{"cos(t^2)", [](double t) { return cos(t * t); }, [](double t) { return -2 * t * sin(t * t); },
               [](double t) { return -2 * sin(t * t) - 4 * t * t * cos(t * t); }},
    ClosedForm{"tan(t)", [](double t) { return tan(t); }, [](double t) { return 1 / pow(cos(t), 2); },
               [](double t) { return 2 * sin(t) / pow(cos(t), 3); }},
    ClosedForm{"asin(t)", [](double t) { return std::asin(t); }, [](double t) { return 1 / sqrt(1 - t * t); },
               [](double t) { return t / pow(1 - t * t, 1.5); }},
    ClosedForm{"acos(t)", [](double t) { return std::acos(t); }, [](double t) { return -1 / sqrt(1 - t * t); },
               [](double t) { return -t / pow(1 - t * t, 1.5); }},
    ClosedForm{"atan(2*t)", [](double t) { return atan(2 * t); }, [](double t) { return 2 / (1 + 4 * t * t); },
               [](double t) { return -16 * t / pow(1 + 4 * t * t, 2); }},
    ClosedForm{"atan2(sin(3*t), cos(3*t))", [](double t) { return std::remainder(3 * t, 2 * pi); }, [](double) { return 3; },
               [](double) { return 0; }},
    ClosedForm{"sqrt(1 + t)", [](double t) { return sqrt(1 + t); }, [](double t) { return 0.5 / sqrt(1 + t); },
               [](double t) { return -0.25 / pow(1 + t, 1.5); }},
    ClosedForm{"exp(-2*t)/(1 + t)", [](double t) { return exp(-2 * t) / (1 + t); },
               [](double t) { return -exp(-2 * t) * (3 + 2 * t) / pow(1 + t, 2); },
               [](double t) { return exp(-2 * t) * (4 * t * t + 12 * t + 10) / pow(1 + t, 3); }},
    ClosedForm{"log(1 + t^2)", [](double t) { return log(1 + t * t); }, [](double t) { return 2 * t / (1 + t * t); },
               [](double t) { return 2 * (1 - t * t) / pow(1 + t * t, 2); }},
    ClosedForm{"2^t", [](double t) { return pow(2, t); }, [](double t) { return log(2) * pow(2, t); },
               [](double t) { return log(2) * log(2) * pow(2, t); }},
    ClosedForm{"t^2.5", [](double t) { return pow(t, 2.5); }, [](double t) { return 2.5 * pow(t, 1.5); },
               [](double t) { return 3.75 * pow(t, 0.5); }},
    ClosedForm{"abs(0.3 - t)*min(t, 9)", [](double t) { return std::abs(0.3 - t) * t; },
               [](double t) { return t < 0.3 ? 0.3 - 2 * t : 2 * t - 0.3; }, [](double t) { return t < 0.3 ? -2 : 2; }},
    ClosedForm{"if(t < 0.5, t, 1 - t^2)", [](double t) { return t < 0.5 ? t : 1 - t * t; }, [](double t) { return t < 0.5 ? 1 : -2 * t; },
               [](double t) { return t < 0.5 ? 0 : -2; }},
    ClosedForm{"step(t, 0, 1)", [](double t) { return t * t * t * (10 - 15 * t + 6 * t * t); },
               [](double t) { return 30 * t * t * (1 - 2 * t + t * t); }, [](double t) { return 60 * t * (1 - 3 * t + 2 * t * t); }}};

class LawDerivative : public testing::TestWithParam<ClosedForm> {};

// Tolerance: a few roundings of terms of the size of the largest.
TEST_P(LawDerivative, IsThatOfTheClosedForm) {
  const ClosedForm& form = GetParam();
  const Law law = read_law(form.text, dimension::number, parameters);
  for (const double t : {0.013, 0.2, 0.5, 0.77, 0.95}) {
    const Jet jet = law.at(t);
    const double size = 1 + std::abs(form.f(t)) + std::abs(form.f1(t)) + std::abs(form.f2(t));
    EXPECT_NEAR(jet.value, form.f(t), rounding * size) << form.text << " at " << t;
    EXPECT_NEAR(jet.rate, form.f1(t), rounding * size) << form.text << " at " << t;
    EXPECT_NEAR(jet.accel, form.f2(t), rounding * size) << form.text << " at " << t;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LawDerivative, testing::ValuesIn(closed_forms));

TEST(Law, PowersHaveDerivativesAtZero) {
  const Jet square = read_law("t^2", dimension::number).at(0);
  EXPECT_EQ(square.rate, 0);
  EXPECT_EQ(square.accel, 2);
  const Jet line = read_law("t^1", dimension::number).at(0);
  EXPECT_EQ(line.rate, 1);
  EXPECT_EQ(line.accel, 0);
}

TEST(Law, StepIsFlatOutsideAndSmoothAtItsEnds) {
  const Law law = read_law("step(t, 0.1 s, 0.3 s)", dimension::number);
  for (const double t : {-1.0, 0.0, 0.1}) EXPECT_EQ(law.at(t).value, 0) << t;
  for (const double t : {0.3 + 1e-15, 1.0}) EXPECT_EQ(law.at(t).value, 1) << t;
  EXPECT_NEAR(law.at(0.1 + 1e-9).accel, 0, 1e-4);  // 60 s/0.04 s², s = 5e-9
  EXPECT_NEAR(law.at(0.3 - 1e-9).accel, 0, 1e-4);
  expect_says(law_refusal("step(t, 1 s, 0 s)", dimension::number), {"t0 before t1"});
}

TEST(Law, TimeIsATimeWhereUnitsSaySo) {
  EXPECT_DOUBLE_EQ(read_law("speed*t", dimension::angle, parameters).at(2).value, 300);
  EXPECT_DOUBLE_EQ(read_law("5 mm*sin(2*pi*t/(0.5 s))", dimension::length).at(0.125).value, 5e-3);
  EXPECT_DOUBLE_EQ(read_law("if(t > 0.1 s, 5 N, 0)", dimension::force).at(0.2).value, 5);
}

TEST(Law, TimeIsSecondsWhereNoUnitsStand) {
  EXPECT_DOUBLE_EQ(read_law("150*t", dimension::angle).at(2).value, 300);
  EXPECT_DOUBLE_EQ(read_law("sin(2*pi*5*t)", dimension::number).at(0.05).value, 1);
  EXPECT_DOUBLE_EQ(read_law("10 N*cos(3*t)", dimension::force).at(0).value, 10);
}

TEST(Law, HalfGivenUnitsAreRefused) {
  expect_says(law_refusal("speed*t + sin(10*t)", dimension::angle), {"every factor of t"});
  expect_says(law_refusal("5 N*t", dimension::angle), {"expected an angle [rad]"});
}

TEST(Law, RunsOnManyThreadsAtOnce) {
  const Law law = read_law("sin(3*t)*exp(-t) + step(t, 0, 1)", dimension::number);
  const Jet expected = law.at(0.4);
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t k = 0; k < wrong.size(); ++k)
    threads.emplace_back([&, k] {
      for (int i = 0; i < 2000; ++i) wrong[k] += law.at(0.4).accel != expected.accel;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(ParameterName, MayNotHideAUnitAFunctionOrTime) {
  EXPECT_EQ(fault_of_name("clearance_2"), "");
  EXPECT_EQ(fault_of_name("F"), "");  // an electrical unit gives way
  for (const char* name : {"t", "pi", "mm", "N", "sin", "step", "2a", "a b", ""}) EXPECT_NE(fault_of_name(name), "") << name;
}

TEST(Units, AllReadBackByTheirName) {
  for (const Unit& unit : units()) {
    const Quantity q = read_quantity("1 " + std::string(unit.name));
    EXPECT_EQ(q.value, unit.factor) << unit.name;
    const std::string si = si_unit(q.dimension);
    EXPECT_TRUE(same(read_quantity("1 " + si).dimension, q.dimension)) << si;
  }
}

}  // namespace
}  // namespace pintle::expression_test
