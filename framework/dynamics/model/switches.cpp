#include "framework/dynamics/model/switches.h"

#include "framework/common/index.h"
#include "framework/dynamics/model/system.h"

namespace pintle {

namespace {

// Whether the row couples motions of bodies instead of fixing a position: gears, racks, rolling discs, belts and linear relations.
bool moves_together(const Joint& joint, int row) {
  if (const auto* relation = std::get_if<Relation>(&joint)) return !relation->curve;
  const std::string_view name = properties_of(joint).equations[at(row)];
  return name == "teeth" || name == "slip";
}

}  // namespace

int latched_row(const Joint& joint) {
  for (int row = 0; row < rows(joint); ++row)
    if (is_angle_row(joint, row) || moves_together(joint, row)) return row;
  return is_driver(joint) ? 0 : -1;
}

bool is_released(const System& system, Switch::Of of, int index, const Eigen::VectorXd& y) {
  if (system.switches.empty()) return false;
  const std::vector<int>& places = of == Switch::joint   ? system.joint_switch
                                   : of == Switch::force ? system.force_switch
                                                         : system.contact_switch;
  return places[at(index)] >= 0 && y[system.switch_begin() + 2 * places[at(index)]] > 0.5;
}

void begin_switches(const System& system, Eigen::VectorXd& y) {
  for (std::size_t k = 0; k < system.switches.size(); ++k)
    y.segment<2>(system.switch_begin() + 2 * static_cast<Eigen::Index>(k)) << (system.switches[k].released ? 1 : 0), 0;
}

void forget_switch(System& system, Switch::Of of, int index) {
  std::erase_if(system.switches, [&](const Switch& s) { return s.of == of && s.index == index; });
  for (Switch& s : system.switches)
    if (s.of == of && s.index > index) --s.index;
}

const std::string& switch_name(const System& system, const Switch& s) {
  return (s.of == Switch::joint ? system.joint_names : s.of == Switch::force ? system.force_names : system.contact_names)[at(s.index)];
}

}  // namespace pintle
