#include "framework/common/text.h"

#include <charconv>
#include <cmath>
#include <sstream>

namespace pintle {

std::string csv_field(const std::string& s) {
  if (s.find_first_of(",\"\r\n") == std::string::npos) return s;
  std::string out(1, '"');
  for (char c : s) out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

std::string number_text(double x, int digits) {
  std::ostringstream s;
  s.precision(digits);
  s << x;
  return s.str();
}

std::string counted(std::size_t n, const std::string& what) { return std::to_string(n) + " " + what + (n == 1 ? "" : "s"); }

std::string quoted(const std::string& s) { return "\"" + s + "\""; }

void append_number(std::string& out, double x) {
  if (std::isnan(x)) return;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x).ptr;
  out.append(text, end);
}

std::string number_exactly(double x) {
  std::string out;
  append_number(out, x);
  return out;
}

}  // namespace pintle
