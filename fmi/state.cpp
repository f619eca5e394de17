// The state of an instance: kept in memory, and as bytes.
#include <cmath>

#include <nlohmann/json.hpp>

#include "fmi/instance.h"
#include "framework/analysis/simulate/identity.h"
#include "framework/mechanism/result_tables.h"

namespace pintle::fmi {

namespace {

using Json = nlohmann::json;
constexpr std::string_view state_kind = "pintle fmu state 1\n";

Json number_or_none(const std::optional<double>& x) { return x ? Json(*x) : Json(); }
std::optional<double> read_number(const Json& said) { return said.is_null() ? std::nullopt : std::optional<double>(said.get<double>()); }

}  // namespace

FmuState FmuInstance::state() const {
  FmuState out{mode_, settings_, time_, inputs_, applied_, shown_, {}, {}, over_};
  if (!simulation_)
    out.row = row_;
  else if (mode_ != FmuMode::initialization)
    out.saved = simulation_->saved();
  return out;
}

void FmuInstance::set_state(const FmuState& from) {
  simulation_.reset();
  row_ = from.row, over_ = from.over;
  settings_ = from.settings, time_ = from.time, inputs_ = from.inputs, applied_ = from.applied, shown_ = from.shown;
  mode_ = from.mode;
  if (mode_ != FmuMode::instantiated && mode_ != FmuMode::initialization) prepared_for(settings_);
  if (from.saved) begin(&*from.saved);
}

std::string FmuInstance::text(const FmuState& s) {
  Json values = Json::array();
  for (const auto& value : s.settings.values) values.push_back(number_or_none(value));
  const Json head{{"mode", s.mode},
                  {"values", values},
                  {"tolerance", number_or_none(s.settings.tolerance)},
                  {"stop", number_or_none(s.settings.stop)},
                  {"time", s.time},
                  {"inputs", s.inputs},
                  {"applied", s.applied},
                  {"shown", s.shown},
                  {"row", s.row},
                  {"over", s.over},
                  {"token", contents_.token}};
  std::string out = std::string(state_kind) + head.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n";
  if (!s.saved) return out;
  const auto of = prepared_for(s.settings);
  return out + state_text(identity(of->scene, of->model, of->assembly), *s.saved);
}

FmuState FmuInstance::state_of(const std::string& text) {
  const std::size_t end = text.find('\n', state_kind.size());
  if (!text.starts_with(state_kind) || end == std::string::npos)
    throw FmuError("these bytes are no state that fmi3SerializeFMUState wrote");
  try {
    const Json head = Json::parse(text.substr(state_kind.size(), end - state_kind.size()));
    if (head.at("token") != contents_.token) throw FmuError("this state is of another unit");
    FmuState out{head.at("mode"), {}, head.at("time"), head.at("inputs"), head.at("applied"), head.at("shown"), {}, {}, head.at("over")};
    for (const Json& value : head.at("values")) out.settings.values.push_back(read_number(value));
    for (const Json& value : head.at("row")) out.row.push_back(read_number(value).value_or(std::nan("")));
    out.settings.tolerance = read_number(head.at("tolerance")), out.settings.stop = read_number(head.at("stop"));
    const std::size_t n = contents_.variables.size();
    const bool whole = out.settings.values.size() == n && out.inputs.size() == n && out.applied.size() == n && out.shown.size() == n &&
                       std::isfinite(out.time);
    if (!whole || out.mode < FmuMode::instantiated || out.mode > FmuMode::terminated) throw FmuError("this state is not whole");
    const bool ran = out.mode == FmuMode::event || out.mode == FmuMode::step;
    if (ran && out.over.empty()) {
      const auto of = prepared_for(out.settings);
      out.saved = pintle::state_of(text.substr(end + 1), "the state", of->scene, of->model, of->assembly);
    }
    if (!out.row.empty() && out.row.size() != trajectory_table(prepared_for(out.settings)->model).columns())
      throw FmuError("this state is not whole");
    return out;
  } catch (const Json::exception& error) {
    throw FmuError(std::string("this state cannot be read: ") + error.what());
  }
}

}  // namespace pintle::fmi
