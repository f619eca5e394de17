#pragma once

#include <string>
#include <vector>

#include "framework/mechanism/model.h"
#include "framework/mechanism/table.h"
#include "framework/scene/scene.h"

/// Laws of signals without a value: a root of a negative number, a division by 0, an input outside a table. They are reported with their
/// inputs.
namespace pintle {

/// Reports a law of signals that is not finite in a state, or has grown beyond all its values at the start, with its inputs there; empty:
/// none.
std::string explain_signals(const Scene&, const Model&, const State& start, const State&);

/// Tables of signals whose range the start is outside of, or that drivers will leave: in words, each table once.
std::vector<std::string> tables_left(const Scene&, const Model&, const State& start);

/// The inputs of a law: ", where cart.x = -1, …: keep it finite, …".
std::string seen_by_law(const Law&, const SignalFunction&, double t, const std::vector<double>& in);

/// Warns, once each, of outputs that are not numbers in the last row of a table, and of laws evaluated beyond the ends of their tables
/// where the scene does not say that the end values are held.
void warn_of_signals(const Scene&, const Model&, const State&, const Table& trajectory, std::vector<std::string>& warnings);

}  // namespace pintle
