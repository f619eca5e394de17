#pragma once

#include "framework/integration/integrator.h"
#include "tests/contracts/scheme_cases.h"

/// A slider-crank with clearance, and an integrator of any scheme, for the exams of impacts and of going on from a saved state.
namespace pintle::scheme_cases {

inline Integrator integrator(const Case& k, double tolerance, const char* tableau = nullptr, Constraints c = Constraints::projection) {
  Scheme scheme;
  scheme.tableau = tableau ? find_tableau(tableau) : nullptr;
  scheme.tolerance = tolerance, scheme.constraints = c;
  return Integrator(k.system, scheme, k.start);
}

// The gudgeon pin with clearance.
inline Case loose_crank() {
  Case k = crank::make();
  System& s = k.system;
  const VectorXd before = k.start.y;
  s.joints.erase(s.joints.begin() + 2);
  ContactPair pair;
  pair.a = 5, pair.b = 4;
  pair.gap = JournalBearing{0.0099, 0.01};
  pair.normal = ImpactLaw{6.61e10, 1.5, 0.3};
  s.contacts = {pair};
  s.contact_names = {"pin"};
  number(s, true);
  k.start.y.setZero(s.n_y());
  k.start.y.head<18>() = before.head<18>();
  k.start.impact_rate = {0};
  return k;
}

}  // namespace pintle::scheme_cases
