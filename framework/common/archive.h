#pragma once

#include <algorithm>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/common/members.h"

namespace pintle {

/// Checksum of the names and the order of members, and of the sizes of their numbers.
template <class... T>
constexpr std::uint32_t layout(std::string_view names) {
  std::uint32_t h = 2166136261u;  // FNV-1a
  for (const char c : names) h = (h ^ static_cast<unsigned char>(c)) * 16777619u;
  const auto add = [&](std::size_t size) { h = (h ^ static_cast<std::uint32_t>(size)) * 16777619u; };
  (add(std::is_arithmetic_v<T> || std::is_enum_v<T> ? 2 * sizeof(T) + std::is_floating_point_v<T> : 0), ...);
  return h;
}

/// Writes numbers as raw bits, to be read by the same program on the same machine. A class supports this with `template <class A> void
/// archive(A& a)`, which names its members once for both directions.
class Writer {
 public:
  static constexpr bool loading = false;
  explicit Writer(std::ostream& out) : stream(out) {}
  template <class... T>
  void operator()(std::string_view names, const T&... x) {
    put(layout<T...>(names));
    (put(x), ...);
  }
  template <class T>
  void whole(const T& x) {
    put(x);
  }
  std::ostream& stream;

 private:
  template <class T>
  void put(const T& x) {
    if constexpr (std::is_same_v<T, bool>)
      put(static_cast<unsigned char>(x));
    else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      stream.write(reinterpret_cast<const char*>(&x), sizeof x);
    else
      const_cast<T&>(x).archive(*this);  // does not change x when writing
  }
  template <class T>
  void put(const std::vector<T>& v) {
    put(v.size());
    for (const T& x : v) put(x);
  }
  void put(const Eigen::VectorXd& v) {
    put(v.size());
    stream.write(reinterpret_cast<const char*>(v.data()), v.size() * static_cast<std::streamsize>(sizeof(double)));
  }
  void put(const std::string& s) {
    put(s.size());
    stream.write(s.data(), static_cast<std::streamsize>(s.size()));
  }
};

/// Reads what Writer wrote, from a stream that is completely in memory (std::istringstream). `good()` is false once something is missing,
/// invalid, or of another layout.
class Reader {
 public:
  static constexpr bool loading = true;
  explicit Reader(std::istream& in) : stream(in) {}
  template <class... T>
  void operator()(std::string_view names, T&... x) {
    std::uint32_t found = 0;
    get(found);
    if (good() && found != layout<T...>(names)) other_layout_ = true, fail();
    (get(x), ...);
  }
  template <class T>
  void whole(T& x) {
    get(x);
  }
  bool good() const { return static_cast<bool>(stream); }
  bool other_layout() const { return other_layout_; }
  void fail() { stream.setstate(std::ios::failbit); }
  std::istream& stream;

 private:
  /// The size is limited by what is left in the stream.
  template <class T>
  bool sized(T& size, std::size_t each) {
    size = 0;
    get(size);
    const std::streamsize left = good() ? std::max<std::streamsize>(stream.rdbuf()->in_avail(), 0) : 0;
    if (size < 0 || static_cast<std::uint64_t>(size) > static_cast<std::uint64_t>(left) / each) fail();
    if (!good()) size = 0;
    return good();
  }
  template <class T>
  void get(T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      unsigned char byte = 0;
      get(byte);
      if (byte > 1) fail();
      x = byte == 1;
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      stream.read(reinterpret_cast<char*>(&x), sizeof x);
    } else if (good()) {
      x.archive(*this);
    }
  }
  template <class T>
  void get(std::vector<T>& v) {
    std::size_t size = 0;
    v.clear();
    if (!sized(size, 1)) return;
    for (std::size_t i = 0; i < size && good(); ++i) {
      T x{};
      get(x);
      v.push_back(x);
    }
  }
  void get(Eigen::VectorXd& v) {
    Eigen::Index size = 0;
    if (!sized(size, sizeof(double))) return;
    v.resize(size);
    stream.read(reinterpret_cast<char*>(v.data()), size * static_cast<std::streamsize>(sizeof(double)));
  }
  void get(std::string& s) {
    std::size_t size = 0;
    if (!sized(size, 1)) return;
    s.resize(size);
    stream.read(s.data(), static_cast<std::streamsize>(size));
  }

  bool other_layout_ = false;
};

}  // namespace pintle
