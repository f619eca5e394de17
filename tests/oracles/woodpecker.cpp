#include "woodpecker.h"

#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Dense>

namespace pintle_oracle {

namespace {

using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;
using Row = Eigen::RowVector3d;

constexpr double r0 = 2.5e-3, rM = 3.1e-3, hM = 5.8e-3, lM = 10e-3, lG = 15e-3, hS = 20e-3, lS = 20.1e-3, beak = 0.1e-3;
constexpr double m1 = 0.3e-3, J1 = 5e-9, m2 = 4.5e-3, J2 = 7e-7, k = 0.0056, g = 9.81, mu = 0.3;
constexpr int contacts = 3;
constexpr double touches_at = -1e-12;                           // a gap that rounding leaves open or closed is open [m]
constexpr std::array<double, contacts> restitution{0, 0, 0.5};  // upper edge, lower edge, beak

struct Motion {
  Vector3d q, v;  // height, angle of the sleeve, of the bird
};

Eigen::Matrix3d inertia(const Vector3d& q) {
  const double a = m2 * lM * std::cos(q[1]), b = m2 * lG * std::cos(q[2]), c = m2 * lM * lG * std::cos(q[1] - q[2]);
  Eigen::Matrix3d M;
  M << m1 + m2, a, b, a, J1 + m2 * lM * lM, c, b, c, J2 + m2 * lG * lG;
  return M;
}
Vector3d force(const Vector3d& q, const Vector3d& v) {
  const double turn = m2 * lM * lG * std::sin(q[1] - q[2]), bent = k * (q[1] - q[2]);
  return {-(m1 + m2) * g + m2 * (lM * std::sin(q[1]) * v[1] * v[1] + lG * std::sin(q[2]) * v[2] * v[2]),
          -m2 * g * lM * std::cos(q[1]) - turn * v[2] * v[2] - bent, -m2 * g * lG * std::cos(q[2]) + turn * v[1] * v[1] + bent};
}

// Gap, and the rows of opening speed and slip (upwards) in v; what v alone adds to their rates.
struct Touch {
  double gap;
  Row normal, slip;
  double normal_rate, slip_rate;
};
// A point (x, y) of the sleeve, seen from its middle.
Touch edge(const Vector3d& q, const Vector3d& v, double y) {
  const double c = std::cos(q[1]), s = std::sin(q[1]), right = rM * c - y * s, up = rM * s + y * c;
  return {right - r0, Row(0, -up, 0), Row(1, right, 0), -right * v[1] * v[1], -up * v[1] * v[1]};
}
Touch touch(int i, const Vector3d& q, const Vector3d& v) {
  if (i < 2) return edge(q, v, i == 0 ? hM : -hM);
  const double out = lG + beak - lS, c = std::cos(q[2]), s = std::sin(q[2]);
  const double right = out * c - hS * s, up = out * s + hS * c, far = lM * std::cos(q[1]), rise = lM * std::sin(q[1]);
  const double w1 = v[1] * v[1], w2 = v[2] * v[2];
  return {far + right - beak - r0, Row(0, -rise, -up), Row(1, far, right - beak), -far * w1 - right * w2, -rise * w1 - up * w2};
}

enum class Mode { away, open, stick, up, down };  // away: it does not touch; up, down: the slip
using Modes = std::array<Mode, contacts>;

using Slips = std::array<bool, contacts>;  // it slips already: then the rate of its slip may have either sign

// Rates A x + c ≥ 0 of opening and of slips under forces x, one mode each; nothing where a mode contradicts itself.
struct Found {
  Modes modes;
  VectorXd x;  // normal force and friction of each contact
};
VectorXd forces_in(const Modes& modes, const MatrixXd& A, const VectorXd& c) {
  MatrixXd own = MatrixXd::Identity(2 * contacts, 2 * contacts);
  VectorXd right = VectorXd::Zero(2 * contacts);
  for (int i = 0; i < contacts; ++i) {
    if (modes[i] == Mode::away || modes[i] == Mode::open) continue;
    own.row(2 * i) = A.row(2 * i), right[2 * i] = -c[2 * i];
    if (modes[i] == Mode::stick)
      own.row(2 * i + 1) = A.row(2 * i + 1), right[2 * i + 1] = -c[2 * i + 1];
    else
      own(2 * i + 1, 2 * i) = modes[i] == Mode::up ? mu : -mu;
  }
  return own.fullPivLu().solve(right);
}
std::optional<VectorXd> in_modes(const Modes& modes, const Slips& slides, const MatrixXd& A, const VectorXd& c) {
  const VectorXd x = forces_in(modes, A, c), rate = A * x + c;
  const double little = 1e-10 * (1 + c.cwiseAbs().maxCoeff());
  for (int i = 0; i < contacts; ++i) {
    if (modes[i] == Mode::away) continue;
    if (modes[i] == Mode::open && rate[2 * i] < -little) return std::nullopt;
    if (x[2 * i] < 0) return std::nullopt;
    if (modes[i] == Mode::stick && std::abs(x[2 * i + 1]) > mu * x[2 * i]) return std::nullopt;
    if (modes[i] == Mode::up && !slides[i] && rate[2 * i + 1] < -little) return std::nullopt;
    if (modes[i] == Mode::down && !slides[i] && rate[2 * i + 1] > little) return std::nullopt;
  }
  return x;
}
// @param allowed  of each contact the modes to try, in order
Found choose(const std::array<std::vector<Mode>, contacts>& allowed, const Slips& slides, const MatrixXd& A, const VectorXd& c) {
  for (const Mode a : allowed[0])
    for (const Mode b : allowed[1])
      for (const Mode d : allowed[2])
        if (const auto x = in_modes({a, b, d}, slides, A, c)) return {{a, b, d}, *x};
  return {{Mode::away, Mode::away, Mode::away}, VectorXd::Constant(2 * contacts, NAN)};
}

struct Rows {
  MatrixXd J, A;
};
Rows rows(const std::array<Touch, contacts>& at, const Vector3d& q) {
  MatrixXd J(2 * contacts, 3);
  for (int i = 0; i < contacts; ++i) J.row(2 * i) = at[i].normal, J.row(2 * i + 1) = at[i].slip;
  return {J, J * inertia(q).inverse() * J.transpose()};
}
std::array<Touch, contacts> touches(const Motion& now) { return {touch(0, now.q, now.v), touch(1, now.q, now.v), touch(2, now.q, now.v)}; }

class Toy {
 public:
  explicit Toy(double dt) : dt_(dt) {
    const double jam = std::atan2(hM, rM) - std::acos(r0 / std::hypot(rM, hM));
    now_ = {{0, jam, -0.2788}, {-0.3411, 0, -7.4583}};
    closed_[1] = true;
    decide();
  }
  // A step, cut where a gap closes, a normal force ends, friction cannot hold, or a slip ends.
  void step() {
    double h = dt_;
    Motion next = moved(h);
    if (happens(next)) {
      double low = 0;
      for (int i = 0; i < 60; ++i) (happens(moved((low + h) / 2)) ? h : low) = (low + h) / 2;
      next = moved(h);
    }
    const bool event = happens(next);
    t_ += h, now_ = next;
    if (event) act();
  }
  double t() const { return t_; }
  std::vector<Knock> knocks;

 private:
  VectorXd rates(const std::array<Touch, contacts>& at, const MatrixXd& J, const Motion& m) const {
    VectorXd c = J * inertia(m.q).inverse() * force(m.q, m.v);
    for (int i = 0; i < contacts; ++i) c[2 * i] += at[i].normal_rate, c[2 * i + 1] += at[i].slip_rate;
    return c;
  }
  // The forces of the modes as they are.
  VectorXd forces(const Motion& m) const {
    const auto at = touches(m);
    const auto [J, A] = rows(at, m.q);
    return forces_in(modes_, A, rates(at, J, m));
  }
  Vector3d acceleration(const Motion& m) const {
    const auto at = touches(m);
    return inertia(m.q).inverse() * (force(m.q, m.v) + rows(at, m.q).J.transpose() * forces(m));
  }
  Motion moved(double h) const {
    const auto rate = [&](const Motion& m) { return Motion{m.v, acceleration(m)}; };
    const auto along = [&](const Motion& r, double by) { return Motion{now_.q + by * r.q, now_.v + by * r.v}; };
    const Motion a = rate(now_), b = rate(along(a, h / 2)), c = rate(along(b, h / 2)), d = rate(along(c, h));
    return {now_.q + h / 6 * (a.q + 2 * b.q + 2 * c.q + d.q), now_.v + h / 6 * (a.v + 2 * b.v + 2 * c.v + d.v)};
  }
  bool happens(const Motion& next) const {
    const auto at = touches(next);
    const VectorXd x = forces(next), slip = rows(at, next.q).J * next.v;
    for (int i = 0; i < contacts; ++i) {
      if (!closed_[i]) {
        if (at[i].gap < touches_at && at[i].normal.dot(next.v) < 0) return true;
      } else if (x[2 * i] < 0 || (modes_[i] == Mode::stick && std::abs(x[2 * i + 1]) > mu * x[2 * i]) ||
                 (modes_[i] == Mode::up && slip[2 * i + 1] < 0) || (modes_[i] == Mode::down && slip[2 * i + 1] > 0)) {
        return true;
      }
    }
    return false;
  }
  void act() {
    const auto at = touches(now_);
    bool hit = false;
    for (int i = 0; i < contacts; ++i)
      if (!closed_[i] && at[i].gap < touches_at && at[i].normal.dot(now_.v) < 0) {
        closed_[i] = hit = true;
        if (i == 2) knocks.push_back({t_, now_.q[0]});
      }
    if (hit) strike(at);
    decide();
  }
  void strike(const std::array<Touch, contacts>& at) {
    const auto [J, A] = rows(at, now_.q);
    const VectorXd before = J * now_.v;
    VectorXd c = before;
    std::array<std::vector<Mode>, contacts> all;
    for (int i = 0; i < contacts; ++i) {
      if (before[2 * i] < 0) c[2 * i] += restitution[i] * before[2 * i];
      all[i] = closed_[i] ? std::vector{Mode::stick, Mode::up, Mode::down, Mode::open} : std::vector{Mode::away};
    }
    now_.v += inertia(now_.q).inverse() * (J.transpose() * choose(all, Slips{}, A, c).x);
    const VectorXd after = J * now_.v;
    for (int i = 0; i < contacts; ++i) closed_[i] = closed_[i] && after[2 * i] < 1e-9;
  }
  void decide() {
    constexpr double still = 1e-7;  // [m/s]
    const auto at = touches(now_);
    const auto [J, A] = rows(at, now_.q);
    const VectorXd slip = J * now_.v;
    Slips slides{};
    std::array<std::vector<Mode>, contacts> allowed;
    for (int i = 0; i < contacts; ++i) {
      slides[i] = std::abs(slip[2 * i + 1]) > still;
      if (!closed_[i])
        allowed[i] = {Mode::away};
      else if (slides[i])
        allowed[i] = {slip[2 * i + 1] > 0 ? Mode::up : Mode::down, Mode::open};
      else
        allowed[i] = {Mode::stick, Mode::open, Mode::up, Mode::down};
    }
    modes_ = choose(allowed, slides, A, rates(at, J, now_)).modes;
    for (int i = 0; i < contacts; ++i)
      if (modes_[i] == Mode::away || modes_[i] == Mode::open) closed_[i] = false, modes_[i] = Mode::away;
  }

  double dt_, t_ = 0;
  Motion now_;
  std::array<bool, contacts> closed_{};
  Modes modes_{Mode::away, Mode::away, Mode::away};
};

}  // namespace

std::vector<Knock> woodpecker_knocks(double until, double dt) {
  Toy toy(dt);
  while (toy.t() < until) toy.step();
  return toy.knocks;
}

}  // namespace pintle_oracle
