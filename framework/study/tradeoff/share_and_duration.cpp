#include "framework/study/tradeoff/share_and_duration.h"

namespace pintle {

namespace {

/// Removes a unit used only here from the end of the text.
bool take(std::string& text, const std::string& unit) {
  const auto end = text.find_last_not_of(' ');
  if (end == std::string::npos || end + 1 < unit.size() || text.compare(end + 1 - unit.size(), unit.size(), unit) != 0) return false;
  text.erase(end + 1 - unit.size());
  return true;
}

}  // namespace

double read_share(const std::string& written) {
  std::string text = written;
  const double unit = take(text, "%") ? 0.01 : 1;
  const double share = unit * read_quantity(text, dimension::number);
  if (!(share > 0 && share <= 1)) throw ExpressionError("must be greater than 0 and at most 100 %, such as 1% or 0.01");
  return share;
}

double read_duration(const std::string& written) {
  std::string text = written;
  double unit = 0;
  if (take(text, "min"))
    unit = 60;
  else if (take(text, "h"))
    unit = 3600;
  const double time = unit > 0 ? unit * read_quantity(text, dimension::number) : read_quantity(text, dimension::time);
  if (!(time > 0)) throw ExpressionError("must be greater than 0, such as 0.5 s, 10 min or 2 h");
  return time;
}

}  // namespace pintle
