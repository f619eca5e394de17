#include "framework/scene/units/table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "framework/common/text.h"
#include "framework/scene/error.h"
#include "framework/scene/text_file.h"

namespace pintle {

namespace {

constexpr std::size_t most_bytes = std::size_t{50} << 20;

std::vector<std::string_view> columns(std::string_view line) {
  constexpr std::string_view separators = " \t\r,;";
  std::vector<std::string_view> out;
  for (std::size_t begin = line.find_first_not_of(separators); begin != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    out.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return out;
}

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Interval [i, i + 1] that contains `at`; the outer ones also for values beyond the samples.
std::size_t interval(const std::vector<double>& t, double at) {
  const auto above = std::upper_bound(t.begin() + 1, t.end() - 1, at);
  return static_cast<std::size_t>(above - t.begin()) - 1;
}

std::optional<Jet> held_end(const Samples& s, double t) {
  if (t < s.t.front()) return Jet{s.value.front(), 0, 0};
  if (t > s.t.back()) return Jet{s.value.back(), 0, 0};
  return std::nullopt;
}

class SampleReader {
 public:
  SampleReader(std::string file, std::string key, std::string first, bool rising = true)
      : file_(std::move(file)), key_(std::move(key)), first_(std::move(first)), rising_(rising) {}

  void line(std::string_view text, double time_unit, double value_unit) {
    ++line_;
    if (line_ == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte-order mark
    const auto words = columns(text.substr(0, text.find('#')));
    if (words.empty()) return;
    const bool header = !seen_a_line_ && !number(words[0]);
    seen_a_line_ = true;
    if (header) return;
    if (words.size() != 2) fail("holds " + std::to_string(words.size()) + " columns; write two: " + first_ + " and value");
    const double t = finite(words[0], 1) * time_unit, value = finite(words[1], 2) * value_unit;
    if (rising_ && !samples_.t.empty() && !(t > samples_.t.back()))
      fail(first_ + " " + std::string(words[0]) + " is not greater than the one before; " + first_ + "s must increase");
    samples_.t.push_back(t);
    samples_.value.push_back(value);
  }
  Samples samples() {
    if (samples_.t.size() < 2) {
      line_ = 0;
      fail("holds " + std::to_string(samples_.t.size()) + " samples; a table needs at least two");
    }
    return std::move(samples_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(file_, {line_, key_}, message); }
  double finite(std::string_view word, int column) const {
    const std::optional<double> value = number(word);
    // Lines before the first row of numbers may contain anything, and are not quoted.
    if (!value)
      fail((samples_.t.empty() ? "column " + std::to_string(column) : "\"" + std::string(word) + "\"") +
           " is not a number; write one, like 0.25 or 2.5e-1");
    if (!std::isfinite(*value)) fail("the value " + std::string(word) + " is not finite; correct or remove the line");
    return *value;
  }

  std::string file_, key_, first_;
  bool rising_;
  int line_ = 0;
  bool seen_a_line_ = false;
  Samples samples_;
};

// Second derivatives at the samples from continuity of the first derivative, with the third continuous at the second and the last but one
// sample.
std::vector<double> curvatures(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> m(n, 0.0);
  if (n == 2) return m;
  const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
  if (n == 3) {
    std::ranges::fill(m, 2 * (slope(1) - slope(0)) / (t[2] - t[0]));
    return m;
  }
  // Rows i = 1 … n − 2:  lower m_{i−1} + diagonal m_i + upper m_{i+1} = right.
  std::vector<double> diagonal(n), upper(n), right(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    double lower = h(i - 1);
    diagonal[i] = 2 * (h(i - 1) + h(i));
    upper[i] = h(i);
    right[i] = 6 * (slope(i) - slope(i - 1));
    if (i == 1) {
      const double r = h(0) / h(1);  // m₀ = (1 + r) m₁ − r m₂
      diagonal[i] += h(0) * (1 + r);
      upper[i] -= h(0) * r;
      lower = 0;
    }
    if (i == n - 2) {
      const double r = h(n - 2) / h(n - 3);  // the same from the other end
      diagonal[i] += h(i) * (1 + r);
      lower -= h(i) * r;
      upper[i] = 0;
    }
    if (i > 1) {
      const double w = lower / diagonal[i - 1];
      diagonal[i] -= w * upper[i - 1];
      right[i] -= w * right[i - 1];
    }
  }
  for (std::size_t i = n - 2; i >= 1; --i) m[i] = (right[i] - upper[i] * m[i + 1]) / diagonal[i];
  m[0] = m[1] + (m[1] - m[2]) * h(0) / h(1);
  m[n - 1] = m[n - 2] + (m[n - 2] - m[n - 3]) * h(n - 2) / h(n - 3);
  return m;
}

}  // namespace

namespace {

template <class Line>
void each_line(const std::filesystem::path& file, const std::string& key, Line line) {
  const std::string text = read_text_file(file, most_bytes, key);
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    line(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
}

Samples read_lines(const std::filesystem::path& file, SampleReader reader, double first_unit, double value_unit, const std::string& key) {
  each_line(file, key, [&](std::string_view line) { reader.line(line, first_unit, value_unit); });
  return reader.samples();
}

class GridReader {
 public:
  GridReader(std::string file, std::string key, const std::array<double, 3>& units, const std::array<std::string, 2>& names)
      : file_(std::move(file)), key_(std::move(key)), units_(units), names_(names) {}

  void line(std::string_view text) {
    ++line_;
    if (line_ == 1 && text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte-order mark
    const auto words = columns(text.substr(0, text.find('#')));
    if (words.empty()) return;
    if (!seen_first_) return first(words);
    if (corner_ && words.size() == head_.size()) head_.erase(head_.begin());  // a number in the corner is ignored
    corner_ = false;
    if (words.size() != head_.size() + 1)
      fail("holds " + counted(words.size(), "number") + "; write " + std::to_string(head_.size() + 1) + ": one of " + names_[0] +
           ", then a value for each of the " + std::to_string(head_.size()) + " of " + names_[1] + " in the first line");
    append(grid_.a, words[0], units_[0], names_[0]);
    for (std::size_t i = 1; i < words.size(); ++i) grid_.value.push_back(finite(words[i]) * units_[2]);
  }
  Grid grid() {
    for (const auto& word : head_) {
      const int last = std::exchange(line_, first_line_);
      append(grid_.b, word, units_[1], names_[1]);
      line_ = last;
    }
    line_ = 0;
    if (grid_.a.size() < 2 || grid_.b.size() < 2)
      fail("holds a grid of " + std::to_string(grid_.a.size()) + " by " + std::to_string(grid_.b.size()) +
           "; it needs at least two lines for " + names_[0] + " and two columns for " + names_[1]);
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(file_, {line_, key_}, message); }

  void first(const std::vector<std::string_view>& words) {
    seen_first_ = true, first_line_ = line_;
    std::size_t begin = 0;
    while (begin < words.size() && !number(words[begin])) ++begin;
    corner_ = begin == 0;
    for (; begin < words.size(); ++begin) head_.emplace_back(words[begin]);
    if (head_.empty()) fail("its first line holds no numbers; write those of " + names_[1] + " there, after a word");
  }
  double finite(std::string_view word) const {
    const std::optional<double> value = number(word);
    if (!value)
      fail((grid_.value.empty() ? std::string("a column") : quoted(std::string(word))) +
           " is not a number; write one, like 0.25 or 2.5e-1");
    if (!std::isfinite(*value)) fail("the value " + std::string(word) + " is not finite; correct it");
    return *value;
  }
  void append(std::vector<double>& to, std::string_view word, double unit, const std::string& name) const {
    const double x = finite(word) * unit;
    if (!to.empty() && !(x > to.back()))
      fail(name + " " + std::string(word) + " is not greater than the one before; numbers of " + name + " must increase");
    to.push_back(x);
  }

  std::string file_, key_;
  std::array<double, 3> units_;
  std::array<std::string, 2> names_;
  int line_ = 0, first_line_ = 0;
  bool seen_first_ = false, corner_ = false;  ///< the first line may begin with a number that does not belong to b
  std::vector<std::string> head_;
  Grid grid_;
};

}  // namespace

Samples read_samples(const std::filesystem::path& file, double time_unit, double value_unit, const std::string& key,
                     const std::string& first) {
  return read_lines(file, {file.string(), key, first}, time_unit, value_unit, key);
}

std::vector<std::array<double, 2>> read_pairs(const std::filesystem::path& file, double unit, const std::string& key) {
  const Samples samples = read_lines(file, {file.string(), key, "x", false}, unit, unit, key);
  std::vector<std::array<double, 2>> out;
  for (std::size_t i = 0; i < samples.t.size(); ++i) out.push_back({samples.t[i], samples.value[i]});
  return out;
}

Grid read_grid(const std::filesystem::path& file, const std::array<double, 3>& units, const std::string& key,
               const std::array<std::string, 2>& names) {
  GridReader reader(file.string(), key, units, names);
  each_line(file, key, [&](std::string_view line) { reader.line(line); });
  return reader.grid();
}

Bilinear::Value Bilinear::operator()(double a, double b) const {
  const auto cell = [](const std::vector<double>& x, double at) {
    const int last = static_cast<int>(x.size()) - 1;
    return at > x.back() ? last : at == x.back() ? last - 1 : at < x.front() ? -1 : static_cast<int>(interval(x, at));
  };
  return on_cell(cell(grid_.a, a), cell(grid_.b, b), a, b);
}

Bilinear::Value Bilinear::on_cell(int i, int j, double a, double b) const {
  struct Axis {
    std::size_t cell;
    double part, rate;
  };
  const auto axis = [](const std::vector<double>& x, int k, double at) -> Axis {
    if (k < 0) return {0, 0, 0};
    const auto cell = static_cast<std::size_t>(k);
    if (cell + 1 >= x.size()) return {x.size() - 2, 1, 0};
    const double h = x[cell + 1] - x[cell];
    return {cell, (at - x[cell]) / h, 1 / h};
  };
  const Axis u = axis(grid_.a, i, a), v = axis(grid_.b, j, b);
  const std::size_t n = grid_.b.size();
  const double* z = grid_.value.data() + u.cell * n + v.cell;
  const double low = z[0] + v.part * (z[1] - z[0]), high = z[n] + v.part * (z[n + 1] - z[n]);
  const double left = z[0] + u.part * (z[n] - z[0]), right = z[1] + u.part * (z[n + 1] - z[1]);
  return {low + u.part * (high - low), (high - low) * u.rate, (right - left) * v.rate};
}

Spline::Spline(Samples samples) : samples_(std::move(samples)), curvature_(curvatures(samples_.t, samples_.value)) {}

Jet Spline::operator()(double t) const {
  if (const auto held = held_end(samples_, t)) return *held;
  const std::size_t i = interval(samples_.t, t);
  const double h = samples_.t[i + 1] - samples_.t[i];
  const double a = (samples_.t[i + 1] - t) / h, b = 1 - a;  // weights of the two ends
  const double ya = samples_.value[i], yb = samples_.value[i + 1];
  const double ma = curvature_[i], mb = curvature_[i + 1];
  return {a * ya + b * yb + ((a * a * a - a) * ma + (b * b * b - b) * mb) * h * h / 6,
          (yb - ya) / h + ((1 - 3 * a * a) * ma + (3 * b * b - 1) * mb) * h / 6, a * ma + b * mb};
}

std::optional<Overshoot> worst_overshoot(const Spline& spline) {
  constexpr double noticed = 0.01;
  constexpr int looks = 16;
  const std::vector<double>&t = spline.samples().t, &y = spline.samples().value;
  const auto [least, most] = std::ranges::minmax(y);
  const auto rise = [&](std::size_t i) { return y[i + 1] - y[i]; };
  Overshoot worst{0, 0, noticed * (most - least)};
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    if (i > 0 && rise(i - 1) * rise(i) < 0) continue;  // at an extremum of the samples the spline may have its own between them
    if (i + 2 < t.size() && rise(i) * rise(i + 1) < 0) continue;
    const auto [low, high] = std::minmax(y[i], y[i + 1]);
    for (int k = 1; k < looks; ++k) {
      const double x = t[i] + (t[i + 1] - t[i]) * k / looks, now = spline(x).value, by = std::max(low - now, now - high);
      if (by > worst.by) worst = {t[i], t[i + 1], by};
    }
  }
  return worst.end > worst.begin ? std::optional(worst) : std::nullopt;
}

Jet Polyline::operator()(double t) const {
  if (const auto held = held_end(samples_, t)) return *held;
  const std::size_t i = interval(samples_.t, t);
  const double slope = (samples_.value[i + 1] - samples_.value[i]) / (samples_.t[i + 1] - samples_.t[i]);
  return {samples_.value[i] + slope * (t - samples_.t[i]), slope, 0};
}

}  // namespace pintle
