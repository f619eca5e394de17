#include "framework/run/text.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace pintle {

std::string csv_field(const std::string& s) {
  if (s.find_first_of(",\"\n") == std::string::npos) return s;
  std::string out(1, '"');
  for (char c : s) out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

void append_number(std::string& out, double x) {
  if (std::isnan(x)) return;
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x).ptr;
  out.append(text, end);
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace pintle
