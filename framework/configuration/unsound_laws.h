#pragma once

#include <string>
#include <vector>

#include "framework/mechanism/model.h"
#include "framework/mechanism/table.h"
#include "framework/scene/scene.h"

/// Laws of signals that have no value: a root of what is below 0, a division by 0, a table left. They are named with what they see.
namespace pintle {

/// Which law of signals is no finite number in a state, or has grown beyond all that it was at the start, and what it sees there; empty:
/// none.
std::string explain_signals(const Scene&, const Model&, const State& start, const State&);

/// Tables of signals that the start lies outside of, or that drivers will turn or push what they see out of: in words, each table once.
std::vector<std::string> tables_left(const Scene&, const Model&, const State& start);

/// What a law sees: ", where cart.x = -1, …: keep it finite, …".
std::string seen_by_law(const Law&, const SignalFunction&, double t, const std::vector<double>& in);

/// Warns, once each, of outputs that are no numbers in the last row of a table, and of laws read beyond the ends of their tables, where the
/// scene does not say that these are held.
void warn_of_signals(const Scene&, const Model&, const State&, const Table& trajectory, std::vector<std::string>& warnings);

}  // namespace pintle
