#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// Writes values one after another such that different sequences give different bytes; all NaNs are equal. `Self` has
/// bytes(std::string_view) and `add` for its structures, which `add` decomposes by structured bindings: if a member is added to a structure
/// they no longer compile, so its author must decide whether it counts.
template <class Self>
class ValueWriter {
 public:
  template <class T>
  requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void add(T x) {
    if constexpr (std::is_floating_point_v<T>)
      if (std::isnan(x)) x = std::numeric_limits<T>::quiet_NaN();
    self().bytes({reinterpret_cast<const char*>(&x), sizeof x});
  }
  template <class... T>
  requires(sizeof...(T) > 1) void add(const T&... x) { (self().add(x), ...); }
  void add(const std::string& text) {
    add(text.size());
    self().bytes(text);
  }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& m) {
    add(m.rows(), m.cols());
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      for (Eigen::Index i = 0; i < m.rows(); ++i) add(m(i, j));
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    for (const T& x : list) self().add(x);
  }
  template <class T, std::size_t n>
  void add(const std::array<T, n>& list) {
    for (const T& x : list) self().add(x);
  }
  template <class T>
  void add(const std::optional<T>& x) {
    add(x.has_value());
    if (x) self().add(*x);
  }
  template <class... T>
  void add(const std::variant<T...>& x) {
    add(x.index());
    std::visit([&](const auto& one) { self().add(one); }, x);
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }
};

}  // namespace pintle
