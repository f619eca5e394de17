#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "framework/common/text.h"
#include "framework/scene/units/unit.h"
#include "framework/scene/yaml/json_text.h"
#include "framework/study/nonlinear/attractors.h"
#include "framework/study/nonlinear/nonlinear.h"

namespace pintle {

namespace {

/// The unit of the values of name i if all are numbers of one dimension; otherwise nothing.
std::optional<std::string> unit_of_parameter(const Nonlinear& study, std::size_t i) {
  std::optional<std::string> out;
  for (std::size_t k = 0; k < study.sweep.cases.size(); ++k) {
    const std::optional<Quantity> q = study.sweep.cases.quantity(k, i);
    if (!q) return {};
    const std::string unit = si_unit(q->dimension);
    if (out && *out != unit) return {};
    out = unit;
  }
  return out;
}

std::string with_its_unit(const std::string& name, const std::string& unit) { return unit.empty() ? name : name + " [" + unit + "]"; }

using Headings = std::vector<std::string>;

/// Headings of the first columns: what varies and the direction, if any; then others.
Headings after_values(const Nonlinear& study, const Headings& others) {
  Headings out = parameter_headers(study);
  if (study.order == Order::both) out.emplace_back("direction");
  out.insert(out.end(), others.begin(), others.end());
  return out;
}

/// "exponent 1 [1/s]"
std::string numbered(const char* name, std::size_t j, const char* unit) { return with_its_unit(name + (" " + std::to_string(j)), unit); }

Headings section_headings(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  Headings out = after_values(study, {"return", "t [s]"});
  for (const std::string& header : signal_headers(study, values)) out.push_back(header);
  return out;
}

Headings orbit_headings(const Nonlinear& study, const std::vector<FollowedValue>& values, std::size_t multipliers) {
  Headings out = after_values(study, {"return"});
  for (const std::string& header : signal_headers(study, values)) out.push_back(header);
  for (const char* own : {"period [s]", "least period", "found from", "stability"}) out.emplace_back(own);
  for (std::size_t j = 1; j <= multipliers; ++j)
    for (const auto& [name, unit] : {std::pair("modulus", ""), std::pair("argument", "rad"), std::pair("error", "")})
      out.push_back(numbered(name, j, unit));
  return out;
}

std::size_t exponents_of(const Nonlinear& study) {
  return study.question.lyapunov ? static_cast<std::size_t>(study.question.lyapunov->exponents) : 0;
}

Headings value_headings(const Nonlinear& study) {
  Headings out = after_values(study, {"status"});
  if (study.basins) out.emplace_back("attractor");
  if (study.question.section)
    for (const char* own : {"returns", "period", "K", "dimension", "impacts a return", "interval [s]", "least approach [m/s]",
                            "median approach [m/s]", "greatest approach [m/s]", "grazing", "share of time in contact"})
      out.emplace_back(own);
  for (std::size_t j = 1; j <= exponents_of(study); ++j)
    for (const char* own : {"exponent", "standard error"}) out.push_back(numbered(own, j, "1/s"));
  out.emplace_back("reason");
  return out;
}

/// Of each signal the least, mean and greatest value; of a random sample the bounds of the share; last a start that ends there.
Headings attractor_headings(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  Headings out{"attractor", "starts", "share"};
  if (study.basins->random) out.insert(out.end(), {"least share", "greatest share"});
  out.insert(out.end(), {"period", "K", "dimension"});
  for (const std::string& header : signal_headers(study, values))
    for (const char* which : {"least ", "mean ", "greatest "}) out.push_back(which + header);
  for (const std::string& header : parameter_headers(study)) out.push_back(header);
  return out;
}

Headings lyapunov_headings(const Nonlinear& study) {
  Headings out = after_values(study, {"t [s]"});
  for (std::size_t j = 1; j <= exponents_of(study); ++j) out.push_back(numbered("exponent", j, "1/s"));
  return out;
}

std::string heading_line(const Headings& headings) {
  std::string out;
  for (const std::string& each : headings) out += (out.empty() ? "" : ",") + csv_field(each);
  return out + "\n";
}

std::string fields_of(const Nonlinear& study, const FollowedValue& value) {
  std::string out;
  for (const std::string& one : value.parameters) out += csv_field(one) + ",";
  if (study.order == Order::both) out += value.backwards ? "backwards," : "forwards,";
  return out;
}

}  // namespace

std::vector<std::string> parameter_headers(const Nonlinear& study) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < study.sweep.cases.names.size(); ++i)
    out.push_back(with_its_unit(study.sweep.cases.names[i], unit_of_parameter(study, i).value_or("")));
  return out;
}

std::string place_words(const Nonlinear& study, const FollowedValue& value) {
  std::string out;
  const std::vector<std::string> headers = parameter_headers(study);
  for (std::size_t i = 0; i < headers.size(); ++i) out += (i > 0 ? ", " : "") + headers[i] + " = " + value.parameters[i];
  return out;
}

std::vector<std::vector<double>> parameter_numbers(const Nonlinear& study) {
  const Cases& cases = study.sweep.cases;
  std::vector<std::vector<double>> out(cases.size());
  for (std::size_t i = 0; i < cases.names.size(); ++i) {
    const bool numbers = unit_of_parameter(study, i).has_value();
    for (std::size_t k = 0; k < cases.size(); ++k) out[k].push_back(numbers ? cases.quantity(k, i)->value : static_cast<double>(k + 1));
  }
  return out;
}

std::vector<std::string> signal_headers(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  std::vector<std::string> out;
  if (!study.question.section) return out;
  for (std::size_t i = 0; i < study.question.section->record.size(); ++i) {
    std::string unit;
    for (const FollowedValue& value : values)
      if (unit.empty() && i < value.units.size()) unit = value.units[i];
    out.push_back(with_its_unit(study.question.section->record[i].name, unit));
  }
  return out;
}

std::vector<FollowedValue> followed(const Nonlinear& study, const std::vector<Row>& rows) {
  const Cases& cases = study.sweep.cases;
  std::vector<bool> numbers;
  for (std::size_t i = 0; i < cases.names.size(); ++i) numbers.push_back(unit_of_parameter(study, i).has_value());
  const std::vector<std::vector<double>> at = parameter_numbers(study);
  std::vector<FollowedValue> out;
  for (const Row& row : rows) {
    FollowedValue& value = out.emplace_back();
    const std::size_t k = study.case_of(row.number);
    value.at = at[k];
    for (std::size_t i = 0; i < numbers.size(); ++i)
      value.parameters.push_back(numbers[i] ? number_exactly(value.at[i]) : cases.values[k][i].value_or(""));
    value.backwards = study.backwards(row.number);
    value.status = row.status, value.reason = row.reason, value.units = row.units;
    value.orbit = Orbit::of(row.values);
    if (study.question.section) value.period = period_of(value.orbit, row.units, study.question.section->tolerance);
  }
  if (study.basins) {
    std::vector<SettledMotion> motions;
    for (const FollowedValue& value : out)
      motions.push_back(value.status == "finished" ? SettledMotion{value.orbit.signals, value.orbit.largest} : SettledMotion{});
    const Nearness nearness{.tolerance = study.basins->tolerance, .equal = study.question.section->tolerance};
    const std::vector<std::size_t> found = attractors(motions, nearness);
    for (std::size_t k = 0; k < out.size(); ++k) out[k].attractor = found[k];
  }
  return out;
}

std::vector<std::vector<std::string>> headings_of_tables(const Nonlinear& study) {
  constexpr std::size_t multipliers = 100;  // their number is known only from the steps
  std::vector<Headings> out{value_headings(study)};
  if (study.question.section) out.push_back(section_headings(study, {}));
  if (study.question.cycle) out.push_back(orbit_headings(study, {}, multipliers));
  if (study.basins) out.push_back(attractor_headings(study, {}));
  if (study.question.lyapunov) out.push_back(lyapunov_headings(study));
  return out;
}

std::string section_csv(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  std::string out = heading_line(section_headings(study, values));
  for (const FollowedValue& value : values) {
    const std::string head = fields_of(study, value);
    for (std::size_t k = 0; k < value.orbit.t.size(); ++k) {
      out += head + std::to_string(k + 1) + "," + number_exactly(value.orbit.t[k]);
      for (const double x : value.orbit.signals[k]) out += "," + number_exactly(x);
      out += '\n';
    }
  }
  return out;
}

std::string orbits_csv(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  std::size_t multipliers = 0;
  for (const FollowedValue& value : values) multipliers = std::max(multipliers, value.orbit.cycle.re.size());
  std::string out = heading_line(orbit_headings(study, values, multipliers));
  for (const FollowedValue& value : values) {
    const Cycle& cycle = value.orbit.cycle;
    if (!cycle.found()) continue;
    std::string tail = "," + number_exactly(cycle.period) + "," + number_exactly(cycle.least) +
                       (cycle.continued > 0 ? ",branch," : ",motion,") + stability_word(stability(cycle));
    for (std::size_t j = 0; j < multipliers; ++j)
      tail += j < cycle.re.size()
                  ? "," + number_exactly(cycle.modulus(j)) + "," + number_exactly(cycle.argument(j)) + "," + number_exactly(cycle.error[j])
                  : ",,,";
    for (std::size_t k = 0; k < cycle.signals.size(); ++k) {
      out += fields_of(study, value) + std::to_string(k + 1);
      for (const double x : cycle.signals[k]) out += "," + number_exactly(x);
      out += tail + "\n";
    }
  }
  return out;
}

std::vector<Basin> basins(const std::vector<FollowedValue>& values) {
  std::vector<Basin> out;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k].attractor == 0) continue;
    out.resize(std::max(out.size(), values[k].attractor));
    Basin& one = out[values[k].attractor - 1];
    if (one.starts++ == 0) one.first = k;
  }
  for (Basin& one : out) one.share = static_cast<double>(one.starts) / static_cast<double>(values.size());
  return out;
}

std::string attractors_csv(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  std::string out = heading_line(attractor_headings(study, values));
  std::size_t number = 0;
  for (const Basin& basin : basins(values)) {
    const FollowedValue& first = values[basin.first];
    out += std::to_string(++number) + "," + std::to_string(basin.starts) + "," + number_exactly(basin.share);
    if (study.basins->random) {
      const ShareBounds bounds = share_bounds(basin.starts, values.size());
      out += "," + number_exactly(bounds.least) + "," + number_exactly(bounds.most);
    }
    out += "," + std::to_string(first.period) + "," + number_exactly(first.orbit.zero_one) + "," + number_exactly(first.orbit.dimension);
    const Returns& returns = first.orbit.signals;
    for (std::size_t i = 0; i < returns[0].size(); ++i) {
      double least = returns[0][i], most = least, sum = 0;
      for (const std::vector<double>& one : returns) least = std::min(least, one[i]), most = std::max(most, one[i]), sum += one[i];
      for (const double x : {least, sum / static_cast<double>(returns.size()), most}) out += "," + number_exactly(x);
    }
    for (const std::string& one : first.parameters) out += "," + csv_field(one);
    out += "\n";
  }
  return out;
}

std::string values_csv(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  std::string out = heading_line(value_headings(study));
  for (const FollowedValue& value : values) {
    const Orbit& orbit = value.orbit;
    out += fields_of(study, value) + value.status;
    if (study.basins) out += "," + std::to_string(value.attractor);
    if (study.question.section) {
      const ImpactFigures& f = orbit.impacts;
      const double n = static_cast<double>(orbit.t.size()), none = std::numeric_limits<double>::quiet_NaN();
      const auto known = [&](double x) { return f.count > 0 ? x : none; };
      out += "," + std::to_string(orbit.t.size()) + "," + std::to_string(value.period) + "," + number_exactly(orbit.zero_one) + "," +
             number_exactly(orbit.dimension);
      for (const double x : {n > 0 ? f.count / n : none, f.count > 1 ? f.interval : none, known(f.least_approach), known(f.median),
                             known(f.most_approach), n > 0 ? f.grazing : none, n > 0 ? f.contact_share : none})
        out += "," + number_exactly(x);
    }
    for (std::size_t j = 0; j < exponents_of(study); ++j) {
      const bool there = j < orbit.exponents.size();
      out += "," + (there ? number_exactly(orbit.exponents[j].value) : "") + "," + (there ? number_exactly(orbit.exponents[j].error) : "");
    }
    out += "," + csv_field(value.reason) + "\n";
  }
  return out;
}

std::string nonlinear_json(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  using Json = nlohmann::ordered_json;
  const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  const std::vector<std::string> headers = parameter_headers(study);
  Json all = Json::array();
  for (const FollowedValue& value : values) {
    Json& one = all.emplace_back(Json::object());
    for (std::size_t i = 0; i < headers.size(); ++i) one[headers[i]] = value.parameters[i];
    if (study.varies() && !study.basins) one["direction"] = value.backwards ? "backwards" : "forwards";
    if (study.basins) one["attractor"] = value.attractor;
    one["status"] = value.status, one["reason"] = value.reason;
    if (study.question.section) {
      one["returns"] = value.orbit.t.size(), one["period"] = value.period, one["K"] = number(value.orbit.zero_one),
      one["dimension"] = number(value.orbit.dimension);
      one["impacts"] = value.orbit.impacts.count, one["grazing"] = value.orbit.impacts.grazing;
    }
    if (const Cycle& cycle = value.orbit.cycle; cycle.found()) {
      Json multipliers = Json::array(), errors = Json::array();
      for (std::size_t j = 0; j < cycle.re.size(); ++j)
        multipliers.push_back({cycle.re[j], cycle.im[j]}), errors.push_back(number(cycle.error[j]));
      one["orbit"] = {{"period [s]", cycle.period},
                      {"least period", cycle.least},
                      {"stability", stability_word(stability(cycle))},
                      {"multipliers", multipliers},
                      {"errors of multipliers", errors}};
    }
    for (const Exponent& e : value.orbit.exponents)
      one["exponents [1/s]"].push_back({{"value", number(e.value)}, {"standard error", number(e.error)}});
  }
  Json found = Json::array();
  for (const Basin& basin : basins(values)) {
    found.push_back({{"starts", basin.starts}, {"share", basin.share}, {"period", values[basin.first].period}});
    if (!study.basins->random) continue;
    const ShareBounds bounds = share_bounds(basin.starts, values.size());
    found.back()["bounds of share"] = {bounds.least, bounds.most};
  }
  Json out = {{"program", "pintle"},
              {"version", PINTLE_VERSION},
              {"title", study.sweep.study.title},
              {"file", study.sweep.study.file},
              {"varied", headers},
              {"recorded", study.question.section ? signal_headers(study, values) : std::vector<std::string>()},
              {"values", all}};
  if (values.size() < study.size()) out["values missing"] = study.size() - values.size();
  if (study.basins) out["attractors"] = found;
  return json_text(out) + "\n";
}

std::string lyapunov_csv(const Nonlinear& study, const std::vector<FollowedValue>& values) {
  std::string out = heading_line(lyapunov_headings(study));
  for (const FollowedValue& value : values) {
    const std::string head = fields_of(study, value);
    for (std::size_t k = 0; k < value.orbit.running_t.size(); ++k) {
      out += head + number_exactly(value.orbit.running_t[k]);
      for (const double x : value.orbit.running[k]) out += "," + number_exactly(x);
      out += '\n';
    }
  }
  return out;
}

}  // namespace pintle
