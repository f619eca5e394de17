#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace soak {

/// Random numbers that are the same with every standard library (SplitMix64, Steele, Lea and Flood 2014).
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< [0, 1)
  double between(double a, double b) { return a + (b - a) * unit(); }
  double decades(double low, double high) { return std::pow(10.0, between(low, high)); }
  double either_way(double size) { return between(-size, size); }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  int from_to(int a, int b) { return a + below(b - a + 1); }
  bool one_in(double n) { return unit() * n < 1; }
  template <class T>
  const T& of(const std::vector<T>& choices) {
    return choices[static_cast<std::size_t>(below(static_cast<int>(choices.size())))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace soak
