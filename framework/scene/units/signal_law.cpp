#include "framework/scene/units/signal_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/common/text.h"

namespace pintle {

SignalFormula::SignalFormula(Program of) : program(std::move(of)) {
  for (const Program::Instruction& i : program.code)
    if (i.op == Op::input) inputs = std::max(inputs, static_cast<std::size_t>(i.value) + 1);
}

double SignalFormula::operator()(double t, const double* in, double* slope) const {
  std::array<Jet, most_signals> jets;
  for (std::size_t i = 0; i < inputs; ++i) jets[i] = {in[i], 0, 0};
  if (slope)
    for (std::size_t i = 0; i < inputs; ++i) {
      jets[i].rate = 1;
      slope[i] = program({t, 0, 0}, jets.data()).rate;
      jets[i].rate = 0;
    }
  return program({t, 0, 0}, jets.data()).value;
}

namespace {

using Ends = std::array<double, 2>;
Ends ends_of_table(const SignalTable& of) {
  return std::visit([](const auto& table) { return Ends{table.samples().t.front(), table.samples().t.back()}; }, of.table);
}
Ends ends_of_numbers(const std::vector<double>& x) { return {x.front(), x.back()}; }
// A value beyond an end by rounding only does not count as beyond it.
bool is_beyond(const Ends& ends, double x) {
  const double rounding = 1e-12 * std::max(std::abs(ends[0]), std::abs(ends[1]));
  return !(x >= ends[0] - rounding && x <= ends[1] + rounding);
}

double no_number(std::size_t inputs, double* slope) {
  if (slope) std::fill_n(slope, inputs, std::numeric_limits<double>::quiet_NaN());
  return std::numeric_limits<double>::quiet_NaN();
}

std::string told_beyond(const Ends& ends, double x, const std::string& unit) {
  const std::string si = unit.empty() ? "" : " " + unit;
  return "it is read at " + number_text(x, 9) + si + ", and goes from " + number_text(ends[0], 9) + " to " + number_text(ends[1], 9) + si;
}

}  // namespace

double SignalTable::operator()(double t, const double* in, double* slope) const {
  double x = over(t, in, slope);
  if (period > 0) x = begin + (x - begin) - period * std::floor((x - begin) / period);
  if (rejects(x)) return no_number(over.inputs, slope);
  const Jet f = std::visit([x](const auto& samples) { return samples(x); }, table);
  if (slope)
    for (std::size_t i = 0; i < over.inputs; ++i) slope[i] *= f.rate;
  return f.value;
}

bool SignalTable::rejects(double x) const { return outside == Outside::rejected && is_beyond(ends_of_table(*this), x); }

bool SignalMap::rejects(double a, double b) const {
  return outside == Outside::rejected && (is_beyond(ends_of_numbers(table.grid().a), a) || is_beyond(ends_of_numbers(table.grid().b), b));
}

double SignalMap::operator()(double t, const double* in, double* slope) const {
  std::array<double, most_signals> by_b{};
  const std::size_t inputs = std::max(over[0].inputs, over[1].inputs);
  if (slope) std::fill_n(slope, inputs, 0.0);
  const double a = over[0](t, in, slope), b = over[1](t, in, slope ? by_b.data() : nullptr);
  if (rejects(a, b)) return no_number(inputs, slope);
  const Bilinear::Value f = table(a, b);
  if (slope)
    for (std::size_t i = 0; i < inputs; ++i) slope[i] = f.by_a * slope[i] + f.by_b * by_b[i];
  return f.value;
}

std::string beyond_its_table(const SignalFunction& law, double t, const double* in, Outside outside) {
  if (const auto* one = law.target<SignalTable>()) {
    const double x = one->over(t, in, nullptr);
    if (one->outside == outside && is_beyond(ends_of_table(*one), x)) return told_beyond(ends_of_table(*one), x, one->unit);
  } else if (const auto* two = law.target<SignalMap>()) {
    for (const std::size_t k : {0, 1}) {
      const double x = two->over[k](t, in, nullptr);
      const Ends ends = ends_of_numbers(k == 0 ? two->table.grid().a : two->table.grid().b);
      if (two->outside == outside && is_beyond(ends, x)) return told_beyond(ends, x, two->units[k]);
    }
  }
  return "";
}

// The effect of the ends of a spline decays by a factor 0.27 per sample: after this many it is below the last digit.
SignalTable periodic_table(Samples samples, bool linear, SignalFormula over) {
  constexpr std::size_t many = 30;
  const double begin = samples.t.front(), period = samples.t.back() - begin;
  if (linear) return {Polyline(std::move(samples)), std::move(over), begin, period};
  const std::size_t n = samples.t.size() - 1, rounds = (many + n - 1) / n;
  Samples around;
  for (std::size_t k = 0; k <= 2 * rounds; ++k)
    for (std::size_t i = 0; i < n + (k == 2 * rounds ? 1 : 0); ++i) {
      around.t.push_back(samples.t[i] + (static_cast<double>(k) - static_cast<double>(rounds)) * period);
      around.value.push_back(samples.value[i]);
    }
  return {Spline(std::move(around)), std::move(over), begin, period};
}

}  // namespace pintle
