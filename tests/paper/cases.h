#pragma once

#include <functional>

#include "framework/analysis/simulate/simulate.h"
#include "framework/configuration/assemble.h"
#include "framework/scene/yaml/reader.h"
#include "tests/paper/plot.h"

namespace paper {

using namespace pintle;
using Change = std::function<void(Scene&)>;
const std::string pin = "gudgeon pin.";
const std::string lost_h = pin + "lost to hysteresis [J]", lost_f = pin + "lost to friction [J]";

struct Printed {
  const char* scene;
  const char* what;
  double energy, loss;  ///< 0: not printed
  int collisions;
};
const std::array<Printed, 6> in_print{{{"table2_050", "50 rad/s, 0.01 mm", 0.5777, 0.0002, 29},
                                       {"table2_100", "100 rad/s, 0.01 mm", 2.3108, 0.0008, 22},
                                       {"table2_150", "150 rad/s, 0.01 mm", 5.1992, 0.0019, 4},
                                       {"table2_200", "200 rad/s, 0.01 mm", 9.2431, 0.0038, 3},
                                       {"fig05_clearance_010", "150 rad/s, 0.1 mm", 0, 0, 19},
                                       {"fig05_clearance_050", "150 rad/s, 0.5 mm", 0, 0, 33}}};

Run run(const std::string& name, const Change& change = {}, const Overrides& set = {});
SceneClearance& clearance(Scene& s);
Change tolerance(double value);
Change output(double every, double until = 0, double tol = 1e-11);
/// Kinetic, gravity and strain: the paper's energy (Eqs. 24 and 25), without what a contact stores.
double energy(const Energies& e);
double loss(const Run& r);
int ended(const Run& r);
Vector scaled(Vector v, double by);
Vector column(const Run& r, const std::string& name, double by = 1);
Vector ms(const Run& r);
Vector energies(const Run& r);
double loss_at(const Run& r, double t);
/// Zero if the run keeps no such account.
double ledger_at(const Run& r, const std::string& name, double t);
double largest(const Vector& v);
Vector magnitude(const Run& r, const std::string& x, const std::string& y);
/// Where the joint is open: zero.
Vector while_touching(const Run& r, const std::string& name, double by);
Curve circle(const std::string& label, double radius);
Curve orbit(const std::string& label, const Run& r, double by);
std::string six_headers(const std::string& first);
std::string printed_row();
/// One row: contacts that ended and loss, of the six cases under one change.
std::string six_row(const std::string& first, const Change& change, bool judge = false);

}  // namespace paper
