#pragma once

#include <string>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/dynamics/model/joints.h"

/// Elements that events may release and engage during a run. Theory: docs/theory/events.md.
namespace pintle {

struct System;

/// A joint or driver, a force, or a contact with all its pairs. A state holds two numbers for each, which only events change: 1 while it is
/// released, and the offset of the angle or length that it holds from its original value.
struct Switch {
  enum Of { joint, force, contact } of;
  int index;              ///< for a contact, its first pair
  bool released = false;  ///< at the start
};

/// The row for which a joint adopts the present value when it is engaged: its angle, its coupling of the motions, or what a driver imposes;
/// −1: none.
int latched_row(const Joint&);

/// Whether the element is released; always false if no event can release it.
bool is_released(const System&, Switch::Of, int index, const Eigen::VectorXd& y);
/// Sets the switches in the state to their start values.
void begin_switches(const System&, Eigen::VectorXd& y);
/// Removes an element from the lists of a system permanently; the indices of those after it decrease by one.
void forget_switch(System&, Switch::Of, int index);
/// Name in messages and results.
const std::string& switch_name(const System&, const Switch&);

}  // namespace pintle
