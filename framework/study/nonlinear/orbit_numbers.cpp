// Converts an orbit to a row of numbers of a journal, and back.
#include <stdexcept>

#include "framework/study/nonlinear/orbit.h"

namespace pintle {

namespace {

constexpr double most_numbers = 1e9;

class NumberWriter {
 public:
  void add(double x) { out.push_back(x); }
  void add(const std::vector<double>& x) {
    add(static_cast<double>(x.size()));
    out.insert(out.end(), x.begin(), x.end());
  }
  void add(const std::vector<std::vector<double>>& x) {
    add(static_cast<double>(x.size()));
    for (const auto& one : x) add(one);
  }
  void add(const std::vector<Exponent>& x) {
    add(static_cast<double>(x.size()));
    for (const Exponent& one : x) add(one.value), add(one.error);
  }
  std::vector<double> out;
};

class NumberReader {
 public:
  explicit NumberReader(const std::vector<double>& from) : from_(from) {}
  void add(double& x) {
    if (at_ == from_.size()) throw std::invalid_argument("too few numbers for an orbit");
    x = from_[at_++];
  }
  void add(std::vector<double>& x) {
    x.resize(size());
    for (double& one : x) add(one);
  }
  void add(std::vector<std::vector<double>>& x) {
    x.resize(size());
    for (auto& one : x) add(one);
  }
  void add(std::vector<Exponent>& x) {
    x.resize(size());
    for (Exponent& one : x) add(one.value), add(one.error);
  }
  void end() const {
    if (at_ != from_.size()) throw std::invalid_argument("too many numbers for an orbit");
  }

 private:
  std::size_t size() {
    double n = 0;
    add(n);
    if (!(n >= 0 && n <= most_numbers && n <= static_cast<double>(from_.size() - at_)))
      throw std::invalid_argument("an invalid size of a list");
    return static_cast<std::size_t>(n);
  }
  const std::vector<double>& from_;
  std::size_t at_ = 0;
};

template <class Archive, class O>
void pass(Archive& a, O& o) {
  a.add(o.t), a.add(o.signals), a.add(o.largest);
  a.add(o.impacts.count), a.add(o.impacts.interval), a.add(o.impacts.least_approach), a.add(o.impacts.median);
  a.add(o.impacts.most_approach), a.add(o.impacts.grazing), a.add(o.impacts.contact_share), a.add(o.zero_one), a.add(o.dimension);
  a.add(o.cycle.point), a.add(o.cycle.x), a.add(o.cycle.signals), a.add(o.cycle.period), a.add(o.cycle.least);
  a.add(o.cycle.re), a.add(o.cycle.im), a.add(o.cycle.error), a.add(o.cycle.continued), a.add(o.cycle.point_before),
      a.add(o.cycle.x_before);
  a.add(o.exponents), a.add(o.running_t), a.add(o.running);
  a.add(o.interval), a.add(o.end_t), a.add(o.end);
}

}  // namespace

std::vector<double> Orbit::numbers() const {
  NumberWriter writer;
  pass(writer, *this);
  return std::move(writer.out);
}

Orbit Orbit::of(const std::vector<double>& numbers) {
  Orbit out;
  NumberReader reader(numbers);
  pass(reader, out);
  reader.end();
  return out;
}

}  // namespace pintle
