#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pintle {

/// SHA-256 [FIPS 180-4]: equal checksums mean equal texts.
class Sha256 {
 public:
  void add(std::string_view);
  /// As 64 hexadecimal digits. Call once, last.
  std::string hex();

 private:
  void block(const unsigned char*);

  std::array<std::uint32_t, 8> h_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a, 0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> waiting_{};
  std::size_t many_ = 0;
  std::uint64_t bytes_ = 0;
};

std::string sha256(std::string_view);

}  // namespace pintle
