#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/equations/energy.h"
#include "framework/mechanism/model.h"
#include "framework/mechanism/table.h"

namespace pintle {

/// Motion of each body's origin, of a flexible one its modal coordinates; wrench of each joint on a named
/// body, motion in each clearance; motion and stress of the points that the scene asks for.
Table trajectory_table(const Model&);
void record(const Model&, const State&, const Equations&, Table& trajectory);

/// What an output's input is, of a state whose row of columns and outputs is known.
double input_value(const Model&, const WrittenOutput::Input&, const State&, const double* columns, const double* outputs);

/// Energies, and each integral of the ledger.
Table ledger_table(const System&);
void record_ledger(const System&, const State&, const Energies&, double unexplained, Table& ledger);

/// Its column of the first integral.
std::size_t first_integral(const System&);

/// Wrench of joint k on its body b (on a if b is the ground), world axes [N, N, N m].
Wrench joint_wrench(const System&, const Equations&, int joint);
/// The body that joint_wrench names.
std::string joint_subject(const System&, int joint);
/// "gudgeon pin.lost to friction", the name of an integral
std::string integral_name(const System&, const Integral&);

}  // namespace pintle
