#include "framework/scene/units/unit.h"

#include <array>
#include <cmath>
#include <locale>
#include <numbers>
#include <sstream>
#include <vector>

#include "framework/common/nearest.h"

namespace pintle {

namespace {

constexpr double pi = std::numbers::pi;
namespace d = dimension;
constexpr Dimension power_of_work{2, 1, -3, 0};
constexpr Dimension resistance{2, 1, -3, 0, -2}, inductance{2, 1, -2, 0, -2}, capacitance{-2, -1, 4, 0, 2}, charge{0, 0, 1, 0, 1},
    torque_of_current{2, 1, -2, 0, -1};

constexpr std::array known_units{Unit{"m", 1, d::length},         Unit{"km", 1e3, d::length},     Unit{"cm", 1e-2, d::length},
                                 Unit{"mm", 1e-3, d::length},     Unit{"um", 1e-6, d::length},    Unit{"nm", 1e-9, d::length},
                                 Unit{"kg", 1, d::mass},          Unit{"g", 1e-3, d::mass},       Unit{"mg", 1e-6, d::mass},
                                 Unit{"s", 1, d::time},           Unit{"ms", 1e-3, d::time},      Unit{"us", 1e-6, d::time},
                                 Unit{"ns", 1e-9, d::time},       Unit{"rad", 1, d::angle},       Unit{"mrad", 1e-3, d::angle},
                                 Unit{"deg", pi / 180, d::angle}, Unit{"rev", 2 * pi, d::angle},  Unit{"rpm", pi / 30, d::angular_speed},
                                 Unit{"N", 1, d::force},          Unit{"mN", 1e-3, d::force},     Unit{"kN", 1e3, d::force},
                                 Unit{"MN", 1e6, d::force},       Unit{"Pa", 1, d::stress},       Unit{"kPa", 1e3, d::stress},
                                 Unit{"MPa", 1e6, d::stress},     Unit{"GPa", 1e9, d::stress},    Unit{"bar", 1e5, d::stress},
                                 Unit{"J", 1, d::torque},         Unit{"mJ", 1e-3, d::torque},    Unit{"kJ", 1e3, d::torque},
                                 Unit{"W", 1, power_of_work},     Unit{"kW", 1e3, power_of_work}, Unit{"A", 1, d::current},
                                 Unit{"mA", 1e-3, d::current},    Unit{"kA", 1e3, d::current},    Unit{"V", 1, d::voltage},
                                 Unit{"mV", 1e-3, d::voltage},    Unit{"kV", 1e3, d::voltage},    Unit{"Ohm", 1, resistance},
                                 Unit{"mOhm", 1e-3, resistance},  Unit{"kOhm", 1e3, resistance},  Unit{"MOhm", 1e6, resistance},
                                 Unit{"H", 1, inductance},        Unit{"mH", 1e-3, inductance},   Unit{"uH", 1e-6, inductance},
                                 Unit{"F", 1, capacitance},       Unit{"mF", 1e-3, capacitance},  Unit{"uF", 1e-6, capacitance},
                                 Unit{"nF", 1e-9, capacitance},   Unit{"C", 1, charge},           Unit{"mC", 1e-3, charge}};

constexpr std::array turns{Unit{"Hz", 2 * pi, d::angular_speed}, Unit{"kHz", 2e3 * pi, d::angular_speed}};

struct AbsentWord {
  std::string_view name, remedy;
};
constexpr const char* write_ohm = "resistances are written in Ohm, mOhm, kOhm or MOhm";
constexpr std::array absent_words{
    AbsentWord{"Hz", "Hz counts turns, not radians: write 50*rev/s or 3000 rpm if turns are meant, otherwise 50/s"},
    AbsentWord{"kHz", "Hz counts turns, not radians: write 1000*rev/s if turns are meant, otherwise 1000/s"},
    AbsentWord{"min", "minutes are not supported: write 60 s"},
    AbsentWord{"inch", "inches are not supported: write 25.4 mm"},
    AbsentWord{"in", "inches are not supported: write 25.4 mm"},
    AbsentWord{"ft", "feet are not supported: write 0.3048 m"},
    AbsentWord{"lb", "pounds are not supported: write 0.45359237 kg"},
    AbsentWord{"lbf", "pounds are not supported: write 4.4482216 N"},
    AbsentWord{"psi", "pounds are not supported: write 6894.7573 Pa"},
    AbsentWord{"ton", "write 1000 kg"},
    AbsentWord{"ohm", write_ohm},
    AbsentWord{"kohm", write_ohm},
    AbsentWord{"Ah", "write 3600 C, or 1 A*(3600 s)"},
    AbsentWord{"Nm", "a product of units is written with a space: N m"},
    AbsentWord{"Nmm", "a product of units is written with a space: N mm"},
    AbsentWord{"kNm", "a product of units is written with a space: kN m"},
    AbsentWord{"Ns", "a product of units is written with a space: N s"},
    AbsentWord{"kgm", "a product of units is written with a space: kg m"},
    AbsentWord{"inf", "every value must be finite"},
    AbsentWord{"Inf", "every value must be finite"},
    AbsentWord{"infinity", "every value must be finite"},
    AbsentWord{"nan", "every value must be finite"},
    AbsentWord{"NaN", "every value must be finite"},
    AbsentWord{"e", "Euler's number is exp(1); a power of ten is written 1e-3"},
    AbsentWord{"ln", "the natural logarithm is log"}};

struct Named {
  Dimension dimension;
  const char *words, *unit;
};
// "unit" must be readable as an expression.
const std::array named{Named{d::number, "a number", ""},
                       Named{d::length, "a length", "m"},
                       Named{d::mass, "a mass", "kg"},
                       Named{d::time, "a time", "s"},
                       Named{d::speed, "a speed", "m/s"},
                       Named{d::angular_speed, "an angular speed", "rad/s"},
                       Named{d::acceleration, "an acceleration", "m/s^2"},
                       Named{d::inertia, "a moment of inertia", "kg*m^2"},
                       Named{d::force, "a force", "N"},
                       Named{d::torque, "a torque or energy", "N*m"},
                       Named{d::stress, "a stress", "Pa"},
                       Named{d::stiffness, "a stiffness or line load", "N/m"},
                       Named{d::damping, "a damping", "N*s/m"},
                       Named{d::torsion_damping, "a torsional damping", "N*m*s/rad"},
                       Named{power_of_work, "a power", "W"},
                       Named{d::area, "an area", "m^2"},
                       Named{d::second_moment, "a second moment of area", "m^4"},
                       Named{{3, 0, 0, 0}, "a volume", "m^3"},
                       Named{d::density, "a density", "kg/m^3"},
                       Named{d::current, "a current", "A"},
                       Named{d::voltage, "a voltage", "V"},
                       Named{resistance, "a resistance", "Ohm"},
                       Named{inductance, "an inductance", "H"},
                       Named{capacitance, "a capacitance", "F"},
                       Named{charge, "a charge", "C"},
                       Named{torque_of_current, "a motor constant or flux", "N*m/A"}};

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

const Named* name_of(const Dimension& q) {
  for (const Named& n : named)
    if (same(n.dimension, q)) return &n;
  return nullptr;
}

std::string base_units(const Dimension& q) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  const std::array<std::pair<const char*, double>, 4> parts{{{"kg", q.mass}, {"m", q.length}, {"s", q.time}, {"A", q.current}}};
  const auto put = [&](const char* name, double exponent) {
    out << name;
    if (near(exponent, 1)) return;
    const bool whole = near(exponent, std::round(exponent));
    out << (whole ? "^" : "^(") << exponent << (whole ? "" : ")");
  };
  for (const auto& [name, exponent] : parts)
    if (exponent > 0 && !near(exponent, 0)) {
      if (out.tellp() > 0) out << '*';
      put(name, exponent);
    }
  if (out.tellp() == 0) out << '1';
  for (const auto& [name, exponent] : parts)
    if (exponent < 0 && !near(exponent, 0)) {
      out << '/';
      put(name, -exponent);
    }
  return out.str();
}

}  // namespace

Dimension product(const Dimension& a, const Dimension& b) {
  return {a.length + b.length, a.mass + b.mass, a.time + b.time, a.angle + b.angle, a.current + b.current};
}

Dimension power(const Dimension& a, double n) { return {n * a.length, n * a.mass, n * a.time, n * a.angle, n * a.current}; }

bool same(const Dimension& a, const Dimension& b) {
  return near(a.length, b.length) && near(a.mass, b.mass) && near(a.time, b.time) && near(a.current, b.current);
}

bool bare(const Dimension& a) { return same(a, {}) && near(a.angle, 0); }

std::string describe(const Dimension& q) {
  if (same(q, d::number) && !bare(q)) return "an angle [rad]";
  const Named* n = name_of(q);
  if (!n) return "a quantity in " + base_units(q);
  return n->unit[0] == '\0' ? n->words : std::string(n->words) + " [" + n->unit + "]";
}

std::string si_unit(const Dimension& q) {
  if (same(q, d::number)) return bare(q) ? "" : "rad";
  const Named* n = name_of(q);
  return n ? n->unit : base_units(q);
}

std::span<const Unit> units() { return known_units; }

const Unit* find_unit(std::string_view name) {
  for (const Unit& u : known_units)
    if (u.name == name) return &u;
  return nullptr;
}

std::span<const Unit> frequency_units() { return turns; }

std::string_view instead_of(std::string_view word) {
  for (const AbsentWord& a : absent_words)
    if (a.name == word) return a.remedy;
  return {};
}

std::string no_unit(const std::string& word) {
  std::vector<std::string> known;
  for (const Unit& u : known_units) known.emplace_back(u.name);
  const std::string best = nearest(word, known);
  std::string out = word + " is not a unit here";
  if (const std::string_view remedy = instead_of(word); !remedy.empty())
    out.append(": ").append(remedy);
  else if (!best.empty())
    out += ": did you mean " + best + "?";
  return out + (out.back() == '?' ? "" : ".") + " Units: " + listed(known, "and");
}

}  // namespace pintle
