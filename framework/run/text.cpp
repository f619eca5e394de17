#include "framework/run/text.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace pintle {

namespace fs = std::filesystem;

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

void write_text(const fs::path& path, const std::string& text) {
  const auto fail = [&](const std::string& why) { throw std::runtime_error(path.string() + ": cannot be written (" + why + ")"); };
  fs::path part = path;
  part += ".part";
  errno = 0;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  std::error_code error, ignored;
  if (!out) {
    const std::string why = errno != 0 ? std::strerror(errno) : "the disk may be full";
    fs::remove(part, ignored);
    fail(why);
  }
  fs::rename(part, path, error);
  if (error) {
    fs::remove(part, ignored);
    fail(error.message());
  }
}

}  // namespace pintle
