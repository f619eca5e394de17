#include "framework/mechanism/row_law.h"

#include <limits>

namespace pintle {

std::vector<double> RowLaw::inputs(const State& state) const {
  const Model& model = *of_;
  if (!work_) work_ = std::make_unique<Work>(model.system);
  std::vector<double>& row = work_->row.data;
  row.clear();
  if (!evaluate(model.system, state, work_->eq, work_->dy))
    return std::vector<double>(law_.in.size(), std::numeric_limits<double>::quiet_NaN());
  record(model, state, work_->eq, work_->row);
  const double* outputs = row.data() + row.size() - model.outputs.size();
  std::vector<double> out;
  for (const WrittenOutput::Input& input : law_.in) out.push_back(input_value(model, input, state, row.data(), outputs));
  return out;
}

double RowLaw::operator()(const State& state) const { return law_.of(state.t, inputs(state).data(), nullptr); }

}  // namespace pintle
