#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pintle {

/// 64-bit FNV-1a: distinguishes texts that differ by accident, not by intent. `onto` chains several.
constexpr std::uint64_t fingerprint(std::string_view text, std::uint64_t onto = 0xcbf29ce484222325u) {
  for (const char c : text) onto = (onto ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return onto;
}

/// Sixteen hexadecimal digits.
inline std::string fingerprint_text(std::uint64_t x) {
  std::string out(16, '0');
  for (std::size_t k = 16; k-- > 0; x >>= 4) out[k] = "0123456789abcdef"[x & 15];
  return out;
}

}  // namespace pintle
