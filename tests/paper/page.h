#pragma once

#include <sstream>

#include "tests/paper/cases.h"

namespace paper {

struct Row {
  std::string result, paper, ours, difference;
};

struct Page {
  std::vector<Row> summary;
  std::ostringstream text;
};

const std::string converging_head = " 1e-9 | 1e-10 | 1e-11 | 1e-11, Fehlberg |\n|---|---|---|---|---|\n";
/// Four cells: a value at tolerance 1e-9, 1e-10 and 1e-11 by Dormand-Prince, and at 1e-11 by
/// Fehlberg.
std::string converging(const std::string& scene, const Overrides& set, const std::function<std::string(const Run&)>& value);

/// Gone from kinetic, gravity and what the contact stores.
double gone(const Run&, double t);

void figure3(Page&);
void figure4(Page&);
void figures5_and_6(Page&);
void table2(Page&);
void figure9(Page&);
void figure11(Page&);
void figure12(Page&);
void table3(Page&);
void findings(Page&);
void clearance_models(Page&);
/// @returns how many of its claims are false; says each
int check_models();

}  // namespace paper
