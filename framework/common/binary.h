#pragma once

#include <cstddef>
#include <istream>
#include <ostream>
#include <type_traits>

namespace pintle {

/// Numbers to and from a stream bit for bit, for the same machine; a vector is led by its size.
template <class T>
void put_binary(std::ostream& out, const T& value) {
  static_assert(sizeof(bool) == 1);
  if constexpr (std::is_arithmetic_v<T>) {
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  } else {
    const auto size = static_cast<std::size_t>(value.size());
    put_binary(out, size);
    out.write(reinterpret_cast<const char*>(value.data()), static_cast<std::streamsize>(size * sizeof(value[0])));
  }
}
/// Reads what put_binary wrote. A vector of another size than `value` has sets failbit and reads no further.
template <class T>
void get_binary(std::istream& in, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    unsigned char byte = 0;
    get_binary(in, byte);
    if (byte > 1) in.setstate(std::ios::failbit);
    value = byte == 1;
  } else if constexpr (std::is_arithmetic_v<T>) {
    in.read(reinterpret_cast<char*>(&value), sizeof value);
  } else {
    std::size_t size = 0;
    get_binary(in, size);
    if (in && size != static_cast<std::size_t>(value.size())) in.setstate(std::ios::failbit);
    if (in) in.read(reinterpret_cast<char*>(value.data()), static_cast<std::streamsize>(size * sizeof(value[0])));
  }
}

}  // namespace pintle
