#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

/// Names and units of the columns of results, in one place for those who write them (framework/mechanism/result_tables.cpp), for signals
/// (framework/scene/units/signal_words.cpp) and for measures (framework/study/measures/).
namespace pintle {

struct Column {
  const char *name, *unit;  ///< the name follows that of the column's owner: "crank" + ".x"
};

namespace column {

// of trajectory.csv
inline constexpr Column body_pose[] = {{".x", "m"}, {".y", "m"}, {".angle", "rad"}};
inline constexpr Column body_speed[] = {{".vx", "m/s"}, {".vy", "m/s"}, {".speed", "rad/s"}};
inline constexpr Column body_acceleration[] = {{".ax", "m/s^2"}, {".ay", "m/s^2"}, {".alpha", "rad/s^2"}};
inline constexpr Column mode[] = {{".mode ", "m kg^0.5"}};  ///< and its number
inline constexpr Column point[] = {{".x", "m"}, {".y", "m"}, {".vx", "m/s"}, {".vy", "m/s"}, {".ax", "m/s^2"}, {".ay", "m/s^2"}};
inline constexpr Column deformation[] = {{".ux", "m"}, {".uy", "m"}, {".turn", "rad"}};
inline constexpr Column beam_stress[] = {{".N", "N"}, {".V", "N"}, {".M", "N m"}, {".stress", "Pa"}};
inline constexpr Column plane_stress[] = {{".sx", "Pa"}, {".sy", "Pa"}, {".txy", "Pa"}, {".von Mises", "Pa"}};
inline constexpr Column force[] = {{".fx", "N"}, {".fy", "N"}};
inline constexpr Column couple[] = {{".torque", "N m"}};
inline constexpr Column tension[] = {{".tension", "N"}};
inline constexpr Column journal[] = {{".ex", "m"},        {".ey", "m"},     {".depth", "m"},   {".rate", "m/s"},
                                     {".sliding", "m/s"}, {".normal", "N"}, {".friction", "N"}};
inline constexpr Column profiles[] = {{".x", "m"},         {".y", "m"},      {".depth", "m"},   {".rate", "m/s"},
                                      {".sliding", "m/s"}, {".normal", "N"}, {".friction", "N"}};
inline constexpr Column pressure[] = {{".pressure", "Pa"}, {".half angle", "rad"}};
inline constexpr Column flank[] = {{".force", "N"}, {".travel", "m"}};
inline constexpr Column joint_friction[] = {{".sliding", "m/s"}, {".load", "N"}, {".friction", "N"}};
inline constexpr Column bristle[] = {{".bristle", "m"}, {".dwell", "-"}};
inline constexpr Column damper_length[] = {{".damper length", "m"}};

// of ledger.csv
inline constexpr Column energies[] = {{"kinetic", "J"}, {"gravity", "J"}, {"springs", "J"}, {"contacts", "J"}};
inline constexpr Column strain[] = {{"strain", "J"}};
inline constexpr Column stored[] = {{"stored", "J"}};
inline constexpr Column unexplained[] = {{"unexplained", "J"}};
inline constexpr Column to_hysteresis{".lost to hysteresis", "J"}, to_friction{".lost to friction", "J"}, to_damper{".lost to damper", "J"},
    to_engaging{".lost to engaging", "J"}, to_switching{".lost to switching", "J"}, work_in{".work in", "J"},
    to_damping{".lost to damping", "J"};
inline constexpr Column transfers[] = {to_hysteresis, to_friction, to_damper, to_engaging, to_switching, work_in};
inline constexpr Column body_transfers[] = {to_damping};

/// One list of several.
template <std::size_t... n>
constexpr auto joined(const Column (&... lists)[n]) {
  std::array<Column, (n + ...)> out{};
  auto end = out.begin();
  ((end = std::copy(lists, lists + n, end)), ...);
  return out;
}

}  // namespace column

}  // namespace pintle
