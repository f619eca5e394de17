// Every case of the atlas ends as its table says, with its figure within its bound. `extremes_tests` has the cases of seconds,
// `extremes_nightly` those of minutes.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "tests/extremes/atlas.h"

#ifndef PINTLE_NIGHTLY
#define PINTLE_NIGHTLY 0
#endif

namespace extremes {
namespace {

struct Place {
  const Axis* axis;
  const Case* what;
};
void PrintTo(const Place& p, std::ostream* out) { *out << p.axis->name << " " << p.what->label << " " << p.what->what; }

std::vector<Place> places() {
  std::vector<Place> out;
  for (const Axis& axis : atlas())
    for (const Case& c : axis.cases)
      if (c.nightly == (PINTLE_NIGHTLY != 0)) out.push_back({&axis, &c});
  return out;
}

/// Words joined by low lines; signs that a test's name may not hold, in words.
std::string name_of(const Place& p) {
  std::string out;
  const std::string all = p.axis->name + "_at_" + p.what->label + (p.what->what.empty() ? "" : "_" + p.what->what);
  for (const char c : all) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += c;
    else if (c == '-')
      out += "minus";
    else if (c == '+')
      out += "plus";
    else if (c == '.')
      out += "p";
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  return out;
}

class Extreme : public testing::TestWithParam<Place> {};

TEST_P(Extreme, HoldsOrSaysWhyNot) {
  const Row r = row(*GetParam().axis, *GetParam().what);
  EXPECT_EQ(r.wrong(), "") << r.axis->asserted << "\n" << r.found.said;
  RecordProperty("measured", printed("%.3g of %.3g", r.found.measured, r.found.bound));
}

INSTANTIATE_TEST_SUITE_P(Atlas, Extreme, testing::ValuesIn(places()), [](const auto& i) { return name_of(i.param); });

}  // namespace
}  // namespace extremes
