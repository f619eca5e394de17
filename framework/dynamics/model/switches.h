#pragma once

#include <string>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/joints.h"

/// Elements that events may take out of the mechanism and put back while it runs. Theory: docs/theory/events.md.
namespace pintle {

struct System;

/// A joint or driver, a force, or a contact with all its pairs. A state holds two numbers of each, which only events change: 1 while it is
/// released, and how far the angle or length that it holds is from the one that it was built with.
struct Switch {
  enum Of { joint, force, contact } of;
  int index;              ///< of a contact its first pair
  bool released = false;  ///< at the start
};

/// The row in which a joint takes what it finds when it is engaged: its angle, how it makes bodies move together, or what a driver imposes;
/// −1: it has none.
int latched_row(const Joint&);

/// Is the element out of the mechanism? Never, where no event can take it out.
bool is_released(const System&, Switch::Of, int index, const Eigen::VectorXd& y);
/// Sets what the state holds of the switches as the scene starts them.
void begin_switches(const System&, Eigen::VectorXd& y);
/// An element leaves the lists of a system for good, and the indices of those behind it go down by one.
void forget_switch(System&, Switch::Of, int index);
/// As messages and results call it.
const std::string& switch_name(const System&, const Switch&);

}  // namespace pintle
