#pragma once

#include <array>
#include <istream>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace pintle {

/// Writes numbers as the bits they are, for the same program on the same machine to read. A class takes
/// part by `template <class A> void archive(A& a)`, which names its members once for both directions.
class Writer {
 public:
  static constexpr bool loading = false;
  explicit Writer(std::ostream& out) : stream(out) {}
  template <class... T>
  void operator()(const T&... x) {
    (put(x), ...);
  }
  std::ostream& stream;

 private:
  template <class T>
  void put(const T& x) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      stream.write(reinterpret_cast<const char*>(&x), sizeof x);
    else
      const_cast<T&>(x).archive(*this);  // which changes nothing when it writes
  }
  template <class T>
  void put(const std::vector<T>& v) {
    put(v.size());
    for (const T& x : v) put(x);
  }
  template <class T, std::size_t N>
  void put(const std::array<T, N>& v) {
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

/// Reads what Writer wrote. `good()` is false once something is missing or of absurd size.
class Reader {
 public:
  static constexpr bool loading = true;
  explicit Reader(std::istream& in) : stream(in) {}
  template <class... T>
  void operator()(T&... x) {
    (get(x), ...);
  }
  bool good() const { return static_cast<bool>(stream); }
  std::istream& stream;

 private:
  static constexpr std::size_t most = 100'000'000;
  template <class T>
  bool sized(T& size) {
    get(size);
    if (static_cast<std::size_t>(size) > most) stream.setstate(std::ios::failbit);
    return good();
  }
  template <class T>
  void get(T& x) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      stream.read(reinterpret_cast<char*>(&x), sizeof x);
    else
      x.archive(*this);
  }
  template <class T>
  void get(std::vector<T>& v) {
    std::size_t size = 0;
    v.clear();
    if (!sized(size)) return;
    for (std::size_t i = 0; i < size && good(); ++i) {
      T x{};
      get(x);
      v.push_back(x);
    }
  }
  template <class T, std::size_t N>
  void get(std::array<T, N>& v) {
    for (T& x : v) get(x);
  }
  void get(Eigen::VectorXd& v) {
    Eigen::Index size = 0;
    if (!sized(size)) return;
    v.resize(size);
    stream.read(reinterpret_cast<char*>(v.data()), size * static_cast<std::streamsize>(sizeof(double)));
  }
  void get(std::string& s) {
    std::size_t size = 0;
    if (!sized(size)) return;
    s.resize(size);
    stream.read(s.data(), static_cast<std::streamsize>(size));
  }
};

}  // namespace pintle
