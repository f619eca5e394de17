#include "fmi/tally.h"

#include <algorithm>
#include <cmath>

#include "framework/common/index.h"

namespace pintle::fmi {

void Tally::look(const std::vector<FmuVariable>& variables, const std::vector<std::string>& contact_names,
                 const std::vector<Happening>& happenings, const std::vector<Impact>& impacts) {
  values_.resize(variables.size());
  const auto each = [&](FmuVariable::Kind kind, const std::string& of, auto act) {
    for (std::size_t v = 0; v < variables.size(); ++v)
      if (variables[v].kind == kind && variables[v].of == of) act(values_[v]);
  };
  for (; happenings_ < happenings.size(); ++happenings_) each(FmuVariable::happened, happenings[happenings_].event, [](int& n) { ++n; });
  for (; impacts_ < impacts.size(); ++impacts_) {
    each(FmuVariable::contacts, contact_names[at(impacts[impacts_].contact)], [](int& n) { ++n; });
    open_.push_back(impacts_);
  }
  std::erase_if(open_, [&](std::size_t i) { return !std::isnan(impacts[i].end); });
  for (std::size_t v = 0; v < variables.size(); ++v)
    if (variables[v].kind == FmuVariable::touching)
      values_[v] = std::ranges::any_of(open_, [&](std::size_t i) { return contact_names[at(impacts[i].contact)] == variables[v].of; });
}

}  // namespace pintle::fmi
