#include "framework/scene/text_file.h"

#include "files/files.h"
#include "framework/scene/error.h"

namespace pintle {

namespace fs = std::filesystem;

namespace {

// Number of bytes of the UTF-8 character that begins at s[i]; 0 if there is none.
std::size_t character(const std::string& s, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(k < s.size() ? s[k] : 0); };
  const unsigned char c = byte(i);
  if (c == 0) return 0;
  if (c < 0x80) return 1;
  const std::size_t n = c >= 0xf5 ? 0 : c >= 0xf0 ? 4 : c >= 0xe0 ? 3 : c >= 0xc2 ? 2 : 0;
  const unsigned char next = byte(i + 1);
  const bool longer_than_needed = (c == 0xe0 && next < 0xa0) || (c == 0xf0 && next < 0x90);
  if (longer_than_needed || (c == 0xed && next > 0x9f) || (c == 0xf4 && next > 0x8f)) return 0;  // surrogate, or beyond Unicode
  for (std::size_t k = 1; k < n; ++k)
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
  return n;
}

}  // namespace

int line_not_text(const std::string& s) {
  int line = 1;
  for (std::size_t i = 0; i < s.size();) {
    const std::size_t n = character(s, i);
    if (n == 0) return line;
    if (s[i] == '\n') ++line;
    i += n;
  }
  return 0;
}

std::string read_text_file(const fs::path& path, std::size_t most_bytes, const std::string& key) {
  const auto fail = [&](const std::string& message, int line = 0) { throw SceneError(path.string(), {line, key}, message); };
  std::string text;
  try {
    text = read_file(path, most_bytes);
  } catch (const FileRejected& rejected) {
    fail(rejected.what());
  }
  if (const int line = line_not_text(text); line > 0)
    fail("is not text (a zero byte, or bytes that are not UTF-8); is it the right file?", line);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    fail(key.empty() ? "is empty; docs/scene.md describes scenes, docs/studies.md describes studies"
                     : "is empty; write a row of numbers for each point");
  return text;
}

}  // namespace pintle
