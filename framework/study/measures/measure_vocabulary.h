#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>

#include "framework/common/result_columns.h"
#include "framework/common/words.h"
#include "framework/study/measures/measure_words.h"

/// The words of measures; if one word begins with another, the longer one comes first.
namespace pintle {

struct StatisticWord {
  const char* words;
  Statistic statistic;
};
inline constexpr std::array statistic_words{StatisticWord{"range of", Statistic::range},
                                            StatisticWord{"range", Statistic::range},
                                            StatisticWord{"peak to peak", Statistic::range},
                                            StatisticWord{"peak-to-peak", Statistic::range},
                                            StatisticWord{"span of", Statistic::range},
                                            StatisticWord{"peak", Statistic::peak},
                                            StatisticWord{"greatest", Statistic::greatest},
                                            StatisticWord{"maximum", Statistic::greatest},
                                            StatisticWord{"max", Statistic::greatest},
                                            StatisticWord{"largest", Statistic::greatest},
                                            StatisticWord{"highest", Statistic::greatest},
                                            StatisticWord{"least", Statistic::least},
                                            StatisticWord{"minimum", Statistic::least},
                                            StatisticWord{"min", Statistic::least},
                                            StatisticWord{"smallest", Statistic::least},
                                            StatisticWord{"lowest", Statistic::least},
                                            StatisticWord{"mean", Statistic::mean},
                                            StatisticWord{"average", Statistic::mean},
                                            StatisticWord{"rms", Statistic::rms},
                                            StatisticWord{"root mean square", Statistic::rms},
                                            StatisticWord{"final", Statistic::last},
                                            StatisticWord{"last", Statistic::last}};

struct MotionWord {
  const char *words, *part, *unit;
};
/// Longer ones first. `speed` of a body is its angular velocity, as in scenes; of a point the magnitude of its velocity.
inline constexpr std::array motion_words{MotionWord{"angular acceleration", "alpha", "rad/s^2"},
                                         MotionWord{"angular velocity", "spin", "rad/s"},
                                         MotionWord{"angular speed", "spin", "rad/s"},
                                         MotionWord{"x velocity", "vx", "m/s"},
                                         MotionWord{"y velocity", "vy", "m/s"},
                                         MotionWord{"velocity x", "vx", "m/s"},
                                         MotionWord{"velocity y", "vy", "m/s"},
                                         MotionWord{"acceleration x", "ax", "m/s^2"},
                                         MotionWord{"acceleration y", "ay", "m/s^2"},
                                         MotionWord{"position x", "x", "m"},
                                         MotionWord{"position y", "y", "m"},
                                         MotionWord{"acceleration", "acceleration", "m/s^2"},
                                         MotionWord{"velocity", "velocity", "m/s"},
                                         MotionWord{"rotation", "angle", "rad"},
                                         MotionWord{"angle", "angle", "rad"},
                                         MotionWord{"speed", "speed", "m/s"},
                                         MotionWord{"alpha", "alpha", "rad/s^2"},
                                         MotionWord{"vx", "vx", "m/s"},
                                         MotionWord{"vy", "vy", "m/s"},
                                         MotionWord{"ax", "ax", "m/s^2"},
                                         MotionWord{"ay", "ay", "m/s^2"},
                                         MotionWord{"ux", "ux", "m"},
                                         MotionWord{"uy", "uy", "m"},
                                         MotionWord{"turn", "turn", "rad"},
                                         MotionWord{"x", "x", "m"},
                                         MotionWord{"y", "y", "m"}};
inline constexpr std::array<std::string_view, 5> of_bodies_alone{"angle", "spin", "alpha"}, of_points_alone{"ux", "uy", "turn"};

/// Columns by their names in results. A name that is not among them is read as an expression.
inline constexpr auto elastic_columns = column::joined(column::deformation, column::beam_stress, column::plane_stress);
inline constexpr auto body_columns =
    column::joined(column::body_pose, column::body_speed, column::body_acceleration, column::body_transfers);
inline constexpr auto point_columns = column::joined(column::point, column::deformation, column::beam_stress, column::plane_stress);
inline constexpr auto actor_columns =
    column::joined(column::force, column::couple, column::damper_length, column::journal, column::transfers);
inline constexpr auto ledger_columns = column::joined(column::energies, column::strain, column::stored, column::unexplained);

/// Parts of a force, or the whole.
struct ForceWord {
  const char *words, *part;
};
inline constexpr std::array force_words{ForceWord{"force x", "x"},
                                        ForceWord{"force y", "y"},
                                        ForceWord{"x force", "x"},
                                        ForceWord{"y force", "y"},
                                        ForceWord{"fx", "x"},
                                        ForceWord{"fy", "y"},
                                        ForceWord{"normal force", "normal"},
                                        ForceWord{"friction force", "friction"},
                                        ForceWord{"joint force", ""},
                                        ForceWord{"contact force", ""},
                                        ForceWord{"driving force", ""},
                                        ForceWord{"force", ""}};

using Phrases = std::initializer_list<const char*>;
inline constexpr Phrases torque_words{"driving torque", "torque", "moment", "couple"};
inline constexpr Phrases eccentricity_words{"eccentricity"};
inline constexpr Phrases depth_words{"depth", "penetration"};
inline constexpr Phrases impact_words{"number of impacts", "number of contacts", "impacts", "impact count", "count of impacts"};
inline constexpr Phrases flight_words{"longest free flight", "longest flight"};
inline constexpr Phrases contact_time_words{"time in contact", "contact time"};
inline constexpr Phrases work_words{"work done", "work put in", "work in", "work"};
inline constexpr Phrases loss_words{"energy lost",       "lost energy",    "energy loss", "energy dissipated",
                                    "dissipated energy", "loss of energy", "losses"};
inline constexpr Phrases stress_words{"von mises stress", "stress"};
inline constexpr Phrases displacement_words{"elastic displacement", "displacement"};
inline constexpr Phrases deflection_words{"deflection"};
inline constexpr Phrases distance_words{"distance between", "distance from"};

/// Causes of energy loss.
struct AccountWord {
  const char *words, *column;
};
inline constexpr std::array account_words{AccountWord{"friction", "friction"},
                                          AccountWord{"hysteresis", "hysteresis"},
                                          AccountWord{"impacts", "hysteresis"},
                                          AccountWord{"dampers", "damper"},
                                          AccountWord{"damper", "damper"},
                                          AccountWord{"damping", "damping"},
                                          AccountWord{"engaging", "engaging"},
                                          AccountWord{"switching", "switching"},
                                          AccountWord{"numerical dissipation", "numerical dissipation"},
                                          AccountWord{"scheme", "numerical dissipation"}};

struct EnergyWord {
  const char *words, *column;
};
inline constexpr std::array energy_words{EnergyWord{"kinetic energy", "kinetic"},         EnergyWord{"potential energy", "gravity"},
                                         EnergyWord{"gravity energy", "gravity"},         EnergyWord{"energy of gravity", "gravity"},
                                         EnergyWord{"spring energy", "springs"},          EnergyWord{"energy of springs", "springs"},
                                         EnergyWord{"energy of the springs", "springs"},  EnergyWord{"contact energy", "contacts"},
                                         EnergyWord{"energy of contacts", "contacts"},    EnergyWord{"strain energy", "strain"},
                                         EnergyWord{"stored energy", "stored"},           EnergyWord{"energy stored", "stored"},
                                         EnergyWord{"mechanical energy", "stored"},       EnergyWord{"total energy", "stored"},
                                         EnergyWord{"unexplained energy", "unexplained"}, EnergyWord{"energy unexplained", "unexplained"}};

/// All words for what can be measured, and for which of its values if `statistics`.
Names what_phrases(bool statistics);

/// The text with its first words replaced by the nearest candidate of as many words: "paek force at pin" becomes "peak force at pin". Of
/// candidates of more and of fewer words the longer one. Empty if none is near, or it begins so already.
std::string with_nearest_beginning(std::string_view text, const Names& candidates);

}  // namespace pintle
