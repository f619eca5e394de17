#include "framework/study/measures/signal.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <numbers>

#include <Eigen/Dense>
#include <unsupported/Eigen/FFT>

namespace pintle {

namespace {

constexpr double no_frequency = std::numeric_limits<double>::quiet_NaN();

/// The cubic with values a, b and rates da, db at the ends of an interval of length h, at s in [0, 1].
struct Cubic {
  double a, b, da, db, h;
  double operator()(double s) const {
    const double r = 1 - s;
    return r * r * ((1 + 2 * s) * a + s * h * da) + s * s * ((3 - 2 * s) * b - r * h * db);
  }
  /// Positions inside at which its rate vanishes, at most two.
  std::vector<double> turns() const {
    const double c0 = h * da, c1 = -6 * (a - b) - 2 * h * (2 * da + db), c2 = 6 * (a - b) + 3 * h * (da + db);
    std::vector<double> out;
    const double D = c1 * c1 - 4 * c2 * c0;
    if (D < 0) return out;
    const double w = -0.5 * (c1 + std::copysign(std::sqrt(D), c1));
    for (const double s : {w / c2, c0 / w})
      if (s > 0 && s < 1) out.push_back(s);
    return out;
  }
};

Cubic piece(const Signal& x, std::size_t i) { return {x.y[i], x.y[i + 1], x.rate[i], x.rate[i + 1], x.t[i + 1] - x.t[i]}; }

/// What the rows beside a jump of the rate in this interval say of the value there; nothing without such a jump.
std::optional<Extreme> at_jump(const Signal& x, std::size_t i) {
  const auto jump = std::ranges::upper_bound(x.jumps, x.t[i]);
  if (jump == x.jumps.end() || *jump >= x.t[i + 1]) return std::nullopt;
  return Extreme{std::max(x.y[i] + x.rate[i] * (*jump - x.t[i]), x.y[i + 1] - x.rate[i + 1] * (x.t[i + 1] - *jump)), *jump};
}

/// The row at or before t, never the last.
std::size_t row_before(const Signal& x, double t) {
  const auto after = std::upper_bound(x.t.begin(), x.t.end(), t);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - x.t.begin() - 1));
  return x.t.size() < 2 ? 0 : std::min(i, x.t.size() - 2);
}

double by_four_rows(const Signal& x, std::size_t i, double t) {
  const std::size_t n = x.t.size(), begin = n < 4 ? 0 : std::min(i > 0 ? i - 1 : 0, n - 4), end = std::min(n, begin + 4);
  double sum = 0;
  for (std::size_t j = begin; j < end; ++j) {
    double term = x.y[j];
    for (std::size_t k = begin; k < end; ++k)
      if (k != j) term *= (t - x.t[k]) / (x.t[j] - x.t[k]);
    sum += term;
  }
  return sum;
}

double rate_at(const Signal& x, std::size_t i, double t) {
  const Cubic c = piece(x, i);
  const double s = (t - x.t[i]) / c.h;
  return 6 * s * (1 - s) * (c.b - c.a) / c.h + (1 - s) * (1 - 3 * s) * c.da + s * (3 * s - 2) * c.db;
}

/// The greatest value on a parabola through three rows. It also has to predict the rows beside them: where the signal jumps or is cut off it
/// does not, and would exceed all values.
std::optional<Extreme> top_of_parabola(const Signal& x, std::size_t i) {
  if (i == 0 || i + 1 >= x.y.size()) return std::nullopt;
  const double h0 = x.t[i] - x.t[i - 1], h1 = x.t[i + 1] - x.t[i];
  const double d0 = (x.y[i] - x.y[i - 1]) / h0, d1 = (x.y[i + 1] - x.y[i]) / h1, bend = (d1 - d0) / (h0 + h1);
  const double slope = (d0 * h1 + d1 * h0) / (h0 + h1), to_top = -slope / (2 * bend);
  const auto predicts = [&](std::size_t row) {
    if (row >= x.y.size()) return true;  // there is none
    const double s = x.t[row] - x.t[i];
    return std::abs(x.y[i] + slope * s + bend * s * s - x.y[row]) <= -bend * s * s / 4;
  };
  if (!(bend < 0 && to_top > -h0 && to_top < h1) || !(predicts(i + 2) && predicts(i - 2))) return std::nullopt;
  return Extreme{x.y[i] + slope * to_top / 2, x.t[i] + to_top};
}

/// Whether the rate can be that of a smooth signal between its ends. If it jumps from one end's rate to that of the other, it jumps near
/// the middle, and the cubic does not exceed all values.
bool holds(const Cubic& c) { return std::abs((c.da + c.db) / 2 - (c.b - c.a) / c.h) <= std::abs(c.db - c.da) / 8; }

Signal negative(Signal x) {
  for (double& v : x.y) v = -v;
  for (double& v : x.rate) v = -v;
  x.magnitude = false;
  return x;
}

/// The part of the rows' variance, weighted by w, that the best fit a + b t + c cos ωt + d sin ωt explains beyond a + b t.
double explained(const std::vector<double>& y, const std::vector<double>& w, double turn) {
  const double n = static_cast<double>(y.size()), middle = (n - 1) / 2;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double s = static_cast<double>(k) - middle;
    const Eigen::Vector4d basis(1, s / n, std::cos(turn * s), std::sin(turn * s));
    normal += w[k] * basis * basis.transpose();
    right += w[k] * y[k] * basis;
  }
  const auto energy = [&](int m) {
    const Eigen::VectorXd r = right.head(m);
    return r.dot(normal.topLeftCorner(m, m).ldlt().solve(r));
  };
  return energy(4) - energy(2);
}

std::vector<double> hann(std::size_t n) {
  std::vector<double> w(n);
  for (std::size_t k = 0; k < n; ++k)
    w[k] = 0.5 * (1 - std::cos(2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n)));
  return w;
}

/// The rows minus mean and trend.
std::vector<double> levelled(const std::vector<double>& y) {
  const double n = static_cast<double>(y.size());
  double mean = 0, slope = 0, spread = 0;
  for (const double v : y) mean += v / n;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double s = static_cast<double>(k) - (n - 1) / 2;
    slope += s * (y[k] - mean), spread += s * s;
  }
  slope /= spread;
  std::vector<double> out(y.size());
  for (std::size_t k = 0; k < y.size(); ++k) out[k] = y[k] - mean - slope * (static_cast<double>(k) - (n - 1) / 2);
  return out;
}

}  // namespace

double value_at(const Signal& x, double t) {
  const std::size_t i = row_before(x, t);
  if (x.t.size() < 2) return x.y.front();
  const double h = x.t[i + 1] - x.t[i], near = 1e-7 * h;
  if (std::abs(t - x.t[i]) <= near) return x.y[i];
  if (std::abs(t - x.t[i + 1]) <= near) return x.y[i + 1];
  if (x.rate.empty()) return x.smooth ? by_four_rows(x, i, t) : x.y[i] + (t - x.t[i]) / h * (x.y[i + 1] - x.y[i]);
  return piece(x, i)((t - x.t[i]) / h);
}

Signal between(const Signal& x, double from, double to) {
  Signal out{{}, {}, {}, x.smooth, x.magnitude, x.jumps};
  const auto add = [&](double t, double y, double rate) {
    out.t.push_back(t), out.y.push_back(y);
    if (!x.rate.empty()) out.rate.push_back(rate);
  };
  const double near = x.t.size() < 2 ? 0 : 1e-7 * (x.t[1] - x.t[0]);
  const auto add_end = [&](double t) { add(t, value_at(x, t), x.rate.empty() ? 0 : rate_at(x, row_before(x, t), t)); };
  add_end(from);
  for (std::size_t i = 0; i < x.t.size(); ++i)
    if (x.t[i] > from + near && x.t[i] < to - near) add(x.t[i], x.y[i], x.rate.empty() ? 0 : x.rate[i]);
  if (to > from + near) add_end(to);
  return out;
}

Extreme greatest(const Signal& x) {
  const auto i = static_cast<std::size_t>(std::max_element(x.y.begin(), x.y.end()) - x.y.begin());
  Extreme best{x.y[i], x.t[i]};
  if (!x.rate.empty()) {
    for (std::size_t k = i > 0 ? i - 1 : 0; k <= i && k + 1 < x.y.size(); ++k) {
      const std::optional<Extreme> jump = at_jump(x, k);
      if (jump && jump->value > best.value) best = *jump;
      const Cubic c = piece(x, k);
      for (const double s : jump || !holds(c) ? std::vector<double>{} : c.turns())
        if (c(s) > best.value) best = {c(s), x.t[k] + s * c.h};
    }
  } else if (x.smooth) {
    best = top_of_parabola(x, i).value_or(best);
  }
  return best;
}

Extreme least(const Signal& x) {
  Extreme e = greatest(negative(x));
  e.value = -e.value;
  if (x.magnitude) e.value = std::max(0.0, e.value);
  return e;
}

double mean(const Signal& x) {
  if (x.t.size() < 2) return x.y.front();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.t.size(); ++i) sum += (x.t[i + 1] - x.t[i]) * (x.y[i] + x.y[i + 1]) / 2;
  return sum / (x.t.back() - x.t.front());
}

double rms(const Signal& x) {
  Signal squares{x.t, x.y};
  for (double& v : squares.y) v *= v;
  return std::sqrt(mean(squares));
}

double dominant_frequency(const Signal& x) {
  constexpr std::size_t fewest = 16;
  if (x.t.size() < fewest) return no_frequency;
  const double h = x.t[1] - x.t[0];
  std::vector<double> y(x.y);
  while (y.size() > fewest && x.t[y.size() - 1] - x.t[y.size() - 2] < (1 - 1e-6) * h) y.pop_back();
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  if (!(*high - *low > 1e-12 * std::max(std::abs(*high), std::abs(*low)))) return no_frequency;
  y = levelled(y);
  const std::vector<double> w = hann(y.size());

  std::size_t size = 1;
  while (size < 2 * y.size()) size *= 2;
  std::vector<double> padded(size, 0.0);
  for (std::size_t k = 0; k < y.size(); ++k) padded[k] = w[k] * y[k];
  std::vector<std::complex<double>> spectrum;
  Eigen::FFT<double>().fwd(spectrum, padded);
  const double length = h * static_cast<double>(y.size()), spacing = 1 / (h * static_cast<double>(size));
  const auto first = static_cast<std::size_t>(std::ceil(1.5 / length / spacing));
  if (first >= size / 2) return no_frequency;
  std::size_t top = first;
  for (std::size_t k = first; k <= size / 2; ++k)
    if (std::abs(spectrum[k]) > std::abs(spectrum[top])) top = k;
  if (top == first && std::abs(spectrum[first - 1]) > std::abs(spectrum[first])) return no_frequency;  // slower than the window can resolve

  // The best-fitting tone near that line: leakage from its own negative frequency, mean and trend is included in the fit.
  const double line = static_cast<double>(top) * spacing;
  double a = line - 0.5 / length, b = line + 0.5 / length;
  constexpr double golden = 0.6180339887498949;
  const auto fit = [&](double f) { return explained(y, w, 2 * std::numbers::pi * f * h); };
  double c = b - golden * (b - a), d = a + golden * (b - a), at_c = fit(c), at_d = fit(d);
  while (b - a > 1e-7 * b) {
    if (at_c > at_d) {
      b = d, d = c, at_d = at_c, c = b - golden * (b - a), at_c = fit(c);
    } else {
      a = c, c = d, at_c = at_d, d = a + golden * (b - a), at_d = fit(d);
    }
  }
  return (a + b) / 2;
}

}  // namespace pintle
