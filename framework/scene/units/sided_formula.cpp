#include "framework/scene/units/sided_formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/scene/units/jet.h"
#include "framework/scene/units/law_scale.h"
#include "framework/scene/units/program_parts.h"
#include "framework/scene/units/signal_law.h"

namespace pintle {

SidedProgram::SidedProgram(Program program) : program_(std::move(program)), first_(program_.code.size(), -1) {
  for (std::size_t i = 0; i < program_.code.size(); ++i) {
    const Op op = program_.code[i].op;
    if (!pintle::switches(op) || !names(part(program_, begin_of(program_, i), i), Op::input)) continue;
    first_[i] = switches_;
    switches_ += op == Op::smooth ? 2 : 1;
  }
}

namespace {

/// The side of d, with the operation's convention at zero.
int natural_side(Op op, double d) {
  const bool above_at_zero = op == Op::abs || op == Op::max || op == Op::less || op == Op::at_least;
  return d > 0 || (d == 0 && above_at_zero) ? 1 : -1;
}

}  // namespace

// One operand, or two whose difference decides.
Jet SidedProgram::held(std::size_t i, const Jet* x, const Sides& sides) const {
  const Op op = program_.code[i].op;
  const auto look = [&](int k, double d) {
    const int side = sides.held ? sides.held[k] : natural_side(op, d);
    if (sides.found) sides.found[k] = side;
    if (sides.left) sides.left[k] = side * d;
    return side;
  };
  const auto truth = [](bool yes) { return Jet{yes ? 1.0 : 0.0, 0, 0}; };
  if (op == Op::smooth) {
    const int begun = look(first_[i], x[0].value), over = look(first_[i] + 1, x[0].value - 1);
    if (begun < 0 || over > 0) return truth(over > 0);
    const double v = x[0].value, u = 1 - v;
    return {v * v * v * (10 + v * (6 * v - 15)), 30 * v * v * u * u * x[0].rate, 0};
  }
  const int side = look(first_[i], op == Op::abs ? x[0].value : x[0].value - x[1].value);
  switch (op) {
    case Op::abs: return side < 0 ? apply(Op::negate, x[0]) : x[0];
    case Op::min: return side < 0 ? x[0] : x[1];
    case Op::max: return side < 0 ? x[1] : x[0];
    case Op::less:
    case Op::at_most: return truth(side < 0);
    default: return truth(side > 0);
  }
}

Jet SidedProgram::run(const Jet& t, const Jet* in, const Sides& sides) const {
  std::array<Jet, Program::most_stacked> stack;
  std::size_t top = 0;  // one past the last operand
  for (std::size_t i = 0; i < program_.code.size(); ++i) {
    const auto& [op, value] = program_.code[i];
    const int operands = operand_count(op);
    top -= static_cast<std::size_t>(operands);
    Jet* const x = stack.data() + top++;
    if (operands == 0)
      *x = op == Op::time ? t : op == Op::input ? in[static_cast<std::size_t>(value)] : Jet{value, 0, 0};
    else if (first_[i] >= 0)
      *x = held(i, x, sides);
    else if (operands == 1)
      *x = apply(op, x[0]);
    else if (operands == 2)
      *x = apply(op, x[0], x[1]);
    else
      *x = x[0].value != 0 ? x[1] : x[2];
  }
  return stack[0];
}

double SidedProgram::value(double t, const double* in, std::size_t inputs, double* slope, const Sides& sides) const {
  std::array<Jet, most_signals> jets;
  for (std::size_t i = 0; i < inputs; ++i) jets[i] = {in[i], 0, 0};
  for (std::size_t i = 0; slope && i < inputs; ++i) {
    jets[i].rate = 1;
    slope[i] = run({t, 0, 0}, jets.data(), sides).rate;
    jets[i].rate = 0;
  }
  return run({t, 0, 0}, jets.data(), sides).value;
}

namespace {

class SidedFormula final : public SidedLaw {
 public:
  explicit SidedFormula(const SignalFormula& of) : program_(of.program), inputs_(of.inputs) {}
  int switches() const override { return program_.switches(); }
  bool exact(int) const override { return true; }
  double value(double t, const double* in, double* slope, const int* side) const override {
    return program_.value(t, in, inputs_, slope, {side});
  }
  void left(double t, const double* in, const int* side, double* left) const override {
    program_.value(t, in, inputs_, nullptr, {side, nullptr, left});
  }
  void find(double t, const double* in, int* side) const override { program_.value(t, in, inputs_, nullptr, {nullptr, side}); }
  int beyond(int k, double, const double*, const int* side) const override { return -side[k]; }

 private:
  SidedProgram program_;
  std::size_t inputs_;
};

/// Marks along an axis, possibly repeated with a period: interval i begins at mark i.
class Marks {
 public:
  Marks(std::vector<double> at, double period) : at_(std::move(at)), period_(period) {}
  bool none() const { return at_.empty(); }
  int interval(double x) const {
    if (at_.empty()) return 0;
    const double rounds = period_ > 0 ? std::floor((x - at_.front()) / period_) : 0;
    const auto above = std::upper_bound(at_.begin(), at_.end(), x - rounds * period_);
    return static_cast<int>(rounds) * static_cast<int>(at_.size()) + static_cast<int>(above - at_.begin()) - 1;
  }
  /// Distance of x from the nearer end of the interval, relative to its length.
  double left(double x, int i) const {
    if (at_.empty()) return 1;
    const double a = mark(i), b = mark(i + 1);
    return std::min(x - a, b - x) / (std::isfinite(b - a) ? b - a : span());
  }
  struct Interval {
    double begin, end, shift;  ///< minus `shift` they are in the first period
  };
  Interval bounds(int i) const {
    const int n = static_cast<int>(at_.size());
    return {mark(i), mark(i + 1), period_ > 0 ? period_ * (i >= 0 ? i / n : -((n - 1 - i) / n)) : 0};
  }
  int beyond(double x, int i) const { return x - mark(i) < mark(i + 1) - x ? i - 1 : i + 1; }

 private:
  double mark(int i) const {
    const int n = static_cast<int>(at_.size());
    if (period_ > 0) {
      const int round = i >= 0 ? i / n : -((n - 1 - i) / n);
      return at_[static_cast<std::size_t>(i - round * n)] + round * period_;
    }
    if (i < 0) return -std::numeric_limits<double>::infinity();
    return i < n ? at_[static_cast<std::size_t>(i)] : std::numeric_limits<double>::infinity();
  }
  double span() const { return at_.size() > 1 ? at_.back() - at_.front() : 1; }
  std::vector<double> at_;
  double period_;
};

/// Of a table: kinks and ends, which are located exactly, and ends of smooth pieces between them.
struct TableMarks {
  std::vector<double> exact, pieces;
};

template <class Table>
TableMarks marks_of(const Table& table, double begin, double period) {
  Samples samples = table.samples();
  const double span = period > 0 ? period : samples.t.back() - samples.t.front();
  if (!(period > 0)) begin = samples.t.front();
  for (double& t : samples.t) t -= begin;
  const std::vector<double> at = samples.t;
  const LawScale scale = scale_of(Table(std::move(samples)), span);
  TableMarks out{{begin}, {}};
  for (const LawBreak& b : scale.breaks) out.exact.push_back(begin + (b.before + b.after) / 2);
  if (!(period > 0)) out.exact.push_back(begin + span);
  const auto add = [&](double x) {
    constexpr double apart = 1e-9;
    const bool there = std::ranges::any_of(out.exact, [&](double e) { return std::abs(e - begin - x) <= apart * span; });
    if (x > apart * span && x < (1 - apart) * span && !there) out.pieces.push_back(begin + x);
  };
  std::ranges::for_each(scale.known ? scale.pieces : at, add);
  return out;
}

class SidedTable final : public SidedLaw {
 public:
  explicit SidedTable(const SignalTable& of)
      : SidedTable(of, std::visit([&](const auto& table) { return marks_of(table, of.begin, of.period); }, of.table)) {}
  int switches() const override { return over_.switches() + 2; }
  bool exact(int k) const override { return k <= over_.switches(); }
  double value(double t, const double* in, double* slope, const int* side) const override {
    constexpr double inside = 1e-12;
    const double x = over_.value(t, in, table_.over.inputs, slope, {side});
    const auto [begin, end, shift] = exact_.bounds(side[over_.switches()]);
    const double edge = inside * (std::isfinite(end - begin) ? end - begin : 1), within = std::clamp(x, begin + edge, end - edge);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const bool outside = !std::isfinite(end - begin) && table_.rejects(x);
    const Jet f =
        outside ? Jet{none, none, 0} : std::visit([at = within - shift](const auto& samples) { return samples(at); }, table_.table);
    for (std::size_t i = 0; slope && i < table_.over.inputs; ++i) slope[i] *= f.rate;
    return f.value + f.rate * (x - within);
  }
  void left(double t, const double* in, const int* side, double* left) const override {
    const double x = over_.value(t, in, table_.over.inputs, nullptr, {side, nullptr, left});
    const int n = over_.switches();
    left[n] = exact_.left(x, side[n]), left[n + 1] = pieces_.left(x, side[n + 1]);
  }
  void find(double t, const double* in, int* side) const override {
    const double x = over_.value(t, in, table_.over.inputs, nullptr, {nullptr, side});
    const int n = over_.switches();
    side[n] = exact_.interval(x), side[n + 1] = pieces_.interval(x);
  }
  int beyond(int k, double t, const double* in, const int* side) const override {
    if (k < over_.switches()) return -side[k];
    const double x = over_.value(t, in, table_.over.inputs, nullptr, {side});
    return (k == over_.switches() ? exact_ : pieces_).beyond(x, side[k]);
  }

 private:
  SidedTable(const SignalTable& of, TableMarks marks)
      : table_(of), over_(of.over.program), exact_(std::move(marks.exact), of.period), pieces_(std::move(marks.pieces), of.period) {}
  SignalTable table_;
  SidedProgram over_;
  Marks exact_, pieces_;
};

/// Its switches: those of both formulas, then the grid lines along both axes, where it has kinks.
class SidedMap final : public SidedLaw {
 public:
  explicit SidedMap(const SignalMap& of)
      : map_(of),
        over_{SidedProgram(of.over[0].program), SidedProgram(of.over[1].program)},
        lines_{Marks(of.table.grid().a, 0), Marks(of.table.grid().b, 0)},
        second_(over_[0].switches()),
        line_(second_ + over_[1].switches()) {}
  int switches() const override { return line_ + 2; }
  bool exact(int) const override { return true; }
  double value(double t, const double* in, double* slope, const int* side) const override {
    const std::size_t inputs = std::max(map_.over[0].inputs, map_.over[1].inputs);
    std::array<double, most_signals> by_b{};
    if (slope) std::fill_n(slope, inputs, 0.0);
    const double a = over_[0].value(t, in, map_.over[0].inputs, slope, {side});
    const double b = over_[1].value(t, in, map_.over[1].inputs, slope ? by_b.data() : nullptr, {side + second_});
    const int i = side[line_], j = side[line_ + 1];
    const auto inside = [](int k, const std::vector<double>& x) { return k >= 0 && k < static_cast<int>(x.size()) - 1; };
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const bool outside = (!inside(i, map_.table.grid().a) || !inside(j, map_.table.grid().b)) && map_.rejects(a, b);
    const Bilinear::Value f = outside ? Bilinear::Value{none, none, none} : map_.table.on_cell(i, j, a, b);
    for (std::size_t k = 0; slope && k < inputs; ++k) slope[k] = f.by_a * slope[k] + f.by_b * by_b[k];
    return f.value;
  }
  void left(double t, const double* in, const int* side, double* left) const override {
    for (std::size_t k = 0; k < 2; ++k) left[at_line(k)] = lines_[k].left(over(k, t, in, {side, nullptr, left}), side[at_line(k)]);
  }
  void find(double t, const double* in, int* side) const override {
    for (std::size_t k = 0; k < 2; ++k) side[at_line(k)] = lines_[k].interval(over(k, t, in, {nullptr, side, nullptr}));
  }
  int beyond(int k, double t, const double* in, const int* side) const override {
    if (k < line_) return -side[k];
    const std::size_t axis = k == line_ ? 0 : 1;
    return lines_[axis].beyond(over(axis, t, in, {side, nullptr, nullptr}), side[k]);
  }

 private:
  std::size_t at_line(std::size_t axis) const { return static_cast<std::size_t>(line_) + axis; }
  /// The argument of an axis; `of` covers all switches.
  double over(std::size_t axis, double t, const double* in, SidedProgram::Sides of) const {
    const int first = axis == 0 ? 0 : second_;
    if (of.held) of.held += first;
    if (of.found) of.found += first;
    if (of.left) of.left += first;
    return over_[axis].value(t, in, map_.over[axis].inputs, nullptr, of);
  }
  SignalMap map_;
  std::array<SidedProgram, 2> over_;
  std::array<Marks, 2> lines_;
  int second_, line_;
};

}  // namespace

std::shared_ptr<const SidedLaw> sided(const SignalFunction& of) {
  if (const auto* formula = of.target<SignalFormula>()) {
    auto out = std::make_shared<SidedFormula>(*formula);
    return out->switches() > 0 ? out : nullptr;
  }
  if (const auto* table = of.target<SignalTable>()) return std::make_shared<SidedTable>(*table);
  if (const auto* map = of.target<SignalMap>()) return std::make_shared<SidedMap>(*map);
  return nullptr;
}

}  // namespace pintle
