#include "framework/scene/units/signal_law.h"

#include <algorithm>
#include <array>
#include <cmath>

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

double SignalTable::operator()(double t, const double* in, double* slope) const {
  double x = over(t, in, slope);
  if (period > 0) x = begin + (x - begin) - period * std::floor((x - begin) / period);
  const Jet f = std::visit([x](const auto& samples) { return samples(x); }, table);
  if (slope)
    for (std::size_t i = 0; i < over.inputs; ++i) slope[i] *= f.rate;
  return f.value;
}

// What the ends of a spline do dies away by 0.27 a sample: after so many before and behind, below the last digit.
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
