#include "app/cost_text.h"

#include <cmath>
#include <iostream>
#include <numbers>

#include "app/options.h"

namespace pintle::app {

namespace {

std::string join(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& p : parts) out += (out.empty() ? "" : ", ") + p;
  return out;
}

/// Rounded to the accuracy of the estimate.
double rounded(double x, int digits) {
  if (!(x > 0)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(x)) + 1 - digits);
  return std::round(x / unit) * unit;
}

std::string duration(double seconds) {
  struct Unit {
    double least, size;
    const char* name;
  };
  constexpr Unit units[] = {{2 * 3600, 3600, "h"}, {120, 60, "min"}, {1, 1, "s"}, {1e-3, 1e-3, "ms"}, {0, 1e-6, "us"}};
  const double x = rounded(seconds, 2);
  for (const Unit& u : units)
    if (x >= u.least) return number(x / u.size, 3) + " " + u.name;
  return "0 s";
}

std::string size(double bytes) {
  constexpr double kilo = 1e3;
  if (bytes < kilo * kilo) return number(std::ceil(bytes / kilo), 4) + " kB";
  return bytes < kilo * kilo * kilo ? number(bytes / (kilo * kilo), 3) + " MB" : number(bytes / (kilo * kilo * kilo), 3) + " GB";
}

template <class Text>
std::string about(const Estimate& e, Text text) {
  const std::string low = text(e.low), likely = text(e.likely), high = text(e.high);
  return low == high ? likely : "about " + likely + " (" + low + " to " + high + ")";
}

std::string frequency(double rate) { return number(rate / (2 * std::numbers::pi), 4) + " Hz"; }

std::string steps_text(const RunCost& c) {
  if (c.trial.whole) return std::to_string(c.trial.steps);
  return about(c.steps, [](double x) { return std::to_string(std::lround(rounded(x, 3))); });
}

std::string what_it_takes(const Saving& s) {
  const Trial& t = s.cost.trial;
  if (!t.trouble.empty()) return "unknown: " + t.trouble;
  std::string part = number(100 * std::abs(s.saved), 2) + " %";
  if (std::abs(s.saved) < 0.02)
    part = "negligible";
  else if (s.saved < 0)
    part += " more time instead";
  return s.of_outputs ? part : part + "; " + steps_text(s.cost) + " steps";
}

}  // namespace

void print_cost(const CostEstimate& p, double build_seconds) {
  const OutputCost& o = p.output;
  std::cout << "  cost of the run\n";
  Rows rows{{"  an evaluation runs", join(p.terms)}};
  if (p.largest_rate > 0) rows.emplace_back("  largest frequency", frequency(p.largest_rate) + ", " + p.largest_rate_of);
  if (p.contact_rate > 0) rows.emplace_back("  of a slow contact", frequency(p.contact_rate));
  rows.emplace_back("  steps", steps_text(p.run) + ", each " + duration(p.run.step) + " of the motion on average");
  const std::string frames = o.frames > 0 ? ", " + std::to_string(o.frames) + " frames " + duration(o.frames * o.frame_seconds) : "";
  rows.emplace_back("  processor time", about(p.seconds, duration) + ": computing " + duration(p.run.seconds.likely) + ", " +
                                            std::to_string(o.rows) + " rows " + duration(static_cast<double>(o.rows) * o.row_seconds) +
                                            frames + "; and " + duration(build_seconds) + " to build the model");
  rows.emplace_back("  memory, files", size(p.memory) + ", " + size(o.bytes()));
  rows.emplace_back("  how sure", certainty(p));
  print_rows(std::cout, rows);
  if (!p.simpler.empty()) std::cout << "  share of that time that each simplification would save\n";
  Rows savings;
  for (const Saving& s : p.simpler) savings.emplace_back("  " + s.what, what_it_takes(s));
  print_rows(std::cout, savings);
  if (!p.untried.empty()) std::cout << "    not tried, to save time: " << join(p.untried) << "\n";
}

}  // namespace pintle::app
