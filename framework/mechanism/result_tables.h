#pragma once

#include <string>
#include <vector>

#include "framework/dynamics/equations/energy.h"
#include "framework/mechanism/model.h"
#include "framework/mechanism/table.h"

namespace pintle {

/// Columns: motion of each body's origin and the modal coordinates of flexible bodies; wrench of each joint on a named body; motion and
/// force in each clearance; motion and stress of the points that the scene asks for.
Table trajectory_table(const Model&);
void record(const Model&, const State&, const Equations&, Table& trajectory);

/// Value of an input of an output. @pre the row's columns and the outputs before it are known
double input_value(const Model&, const WrittenOutput::Input&, const State&, const double* columns, const double* outputs);

/// Columns: the energies and each integral of the ledger.
Table ledger_table(const System&);
void record_ledger(const System&, const State&, const Energies&, double unexplained, Table& ledger);

/// Column of the first integral in the ledger.
std::size_t first_integral(const System&);

/// Wrench of joint k on its body b (on a if b is the ground), world axes [N, N, N m].
Wrench joint_wrench(const System&, const Equations&, int joint);
/// Name of the body that joint_wrench acts on.
std::string joint_subject(const System&, int joint);
/// "gudgeon pin.lost to friction", the name of an integral
std::string integral_name(const System&, const Integral&);

}  // namespace pintle
