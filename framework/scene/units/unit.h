#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pintle {

/// Powers of length, mass, time, angle and electric current. Half powers occur: a contact stiffness is in N/m^1.5. Angle is included so
/// that 30 deg is not taken for a bare number, but it does not distinguish dimensions: N m and N m/rad, 1/s and rad/s are the same.
struct Dimension {
  double length = 0, mass = 0, time = 0, angle = 0, current = 0;
};

namespace dimension {
inline constexpr Dimension number{}, length{1, 0, 0, 0}, mass{0, 1, 0, 0}, time{0, 0, 1, 0}, angle{0, 0, 0, 1}, speed{1, 0, -1, 0},
    angular_speed{0, 0, -1, 1}, acceleration{1, 0, -2, 0}, inertia{2, 1, 0, 0}, force{1, 1, -2, 0}, torque{2, 1, -2, 0},
    stress{-1, 1, -2, 0}, stiffness{0, 1, -2, 0}, damping{0, 1, -1, 0}, torsion_stiffness{2, 1, -2, -1}, torsion_damping{2, 1, -1, -1},
    area{2, 0, 0, 0}, second_moment{4, 0, 0, 0}, density{-3, 1, 0, 0}, line_load{0, 1, -2, 0}, rate{0, 0, -1, 0}, current{0, 0, 0, 0, 1},
    voltage{2, 1, -3, 0, -1};
}  // namespace dimension

Dimension product(const Dimension&, const Dimension&);
Dimension power(const Dimension&, double exponent);
/// Equal except for angle.
bool same(const Dimension&, const Dimension&);
/// No unit: neither dimension nor angle.
bool bare(const Dimension&);

/// "a length [m]", "a moment of inertia [kg m^2]", or the base units if it has no name.
std::string describe(const Dimension&);
/// The SI unit as readable in an expression: "m", "kg*m^2", empty for a number.
std::string si_unit(const Dimension&);

struct Unit {
  std::string_view name;
  double factor;  ///< to SI
  Dimension dimension;
};
/// Every unit the language knows.
std::span<const Unit> units();
/// @returns nullptr if there is none of this name; names are case-sensitive
const Unit* find_unit(std::string_view name);

/// Hz and kHz as turns per second: units only where the value can only be a frequency (`modes.below`).
std::span<const Unit> frequency_units();

/// What to write instead of a unit, constant or function that users may try but that is intentionally absent ("Hz", "Nm", "e", "ln"); empty
/// for any other word.
std::string_view instead_of(std::string_view word);
/// "lb is not a unit here: write 0.45359237 kg. Units: m, km, …".
std::string no_unit(const std::string& word);

}  // namespace pintle
