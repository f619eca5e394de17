// Every method of the fit sits the same exam: closed minima, in a box with a hole in it, within limits where it takes them.
#include "framework/study/fit/optimiser.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace pintle::optimiser_test {
namespace {

/// A search that remembers its best.
struct Searched {
  Worth best;
  BoxPoint at;
  std::string end;
  int asked = 0;
};
using WorthOf = std::function<Worth(const BoxPoint&)>;

Searched searched(SearchSettings s, const WorthOf& f, int most) {
  Searched out;
  Worth last;
  out.end = search(s, [&](const BoxPoint& u) -> const Worth* {
    if (out.asked++ == most) return nullptr;
    last = f(u);
    if (better(last, out.best)) out.best = last, out.at = u;
    return &last;
  });
  return out;
}

Worth bowl(const BoxPoint& u) { return {true, std::pow(u[0] - 0.3, 2) + 4 * std::pow(u[1] - 0.6, 2) + std::pow(u[0] - 0.3, 2) * u[1], {}}; }

struct EveryOptimiser : testing::TestWithParam<Optimiser> {
  SearchSettings settings(std::size_t constraints = 0) const {
    SearchSettings s{GetParam(), {0.7, 0.2}, constraints};
    s.precision = 1e-7;
    return s;
  }
  int most() const { return looks_everywhere(GetParam()) ? 20000 : 2000; }
};

TEST_P(EveryOptimiser, FindsTheBottomOfABowl) {
  const Searched s = searched(settings(), bowl, most());
  EXPECT_NEAR(s.at[0], 0.3, 1e-3) << s.end;
  EXPECT_NEAR(s.at[1], 0.6, 1e-3) << s.end;
}

TEST_P(EveryOptimiser, FindsACornerOfTheBox) {
  const Searched s = searched(
      settings(),
      [](const BoxPoint& u) {
        return Worth{true, u[0] - 2 * u[1], {}};
      },
      most());
  EXPECT_NEAR(s.at[0], 0, 1e-3) << s.end;
  EXPECT_NEAR(s.at[1], 1, 1e-3) << s.end;
}

TEST_P(EveryOptimiser, GoesOnWherePointsCannotBeMeasured) {
  // Nothing is known where u₀ + u₁ < 0.65; the least value lies beside that.
  const auto f = [](const BoxPoint& u) { return u[0] + u[1] < 0.65 ? Worth{} : bowl(u); };
  const Searched s = searched(settings(), f, most());
  EXPECT_TRUE(s.best.known);
  EXPECT_LT(s.best.value, 0.02) << s.end;  // at the start it is 0.83
}

TEST_P(EveryOptimiser, KeepsWithinLimitsOrSaysThatItCannot) {
  if (!takes_constraints(GetParam())) return;
  // The bowl with u₀ ≥ 0.5: least at u₀ = 0.5.
  const auto f = [](const BoxPoint& u) {
    Worth w = bowl(u);
    w.excess = {0.5 - u[0]};
    return w;
  };
  const Searched s = searched(settings(1), f, most());
  EXPECT_LE(s.best.worst(), met_within);
  EXPECT_NEAR(s.at[0], 0.5, 2e-3) << s.end;
  EXPECT_NEAR(s.at[1], 0.6, 0.02) << s.end;
}

TEST_P(EveryOptimiser, EndsWhenThereIsNothingMoreToAsk) {
  const Searched s = searched(settings(), bowl, 7);
  EXPECT_LE(s.asked, 9);  // it may ask for slopes once more
  EXPECT_EQ(s.end, "out of evaluations");
}

TEST_P(EveryOptimiser, HandsOnWhatIsThrown) {
  EXPECT_THROW(search(settings(), [](const BoxPoint&) -> const Worth* { throw std::runtime_error("disk"); }), std::runtime_error);
}

TEST_P(EveryOptimiser, DoesTheSameEachTime) {
  const auto track = [&] {
    std::vector<BoxPoint> out;
    searched(
        settings(), [&](const BoxPoint& u) { return out.push_back(u), bowl(u); }, 300);
    return out;
  };
  EXPECT_EQ(track(), track());
}

INSTANTIATE_TEST_SUITE_P(All, EveryOptimiser,
                         testing::Values(Optimiser::bobyqa, Optimiser::cobyla, Optimiser::nelder_mead, Optimiser::sbplx, Optimiser::slsqp,
                                         Optimiser::mma, Optimiser::direct, Optimiser::crs, Optimiser::isres),
                         [](const auto& one) {
                           std::string name = name_of(one.param);
                           std::erase(name, '-');
                           return name;
                         });

TEST(Worth, IsBetterWhereLimitsAreMetFirst) {
  const Worth none, low{true, 1, {0.5}}, high{true, 2, {-1}}, higher{true, 3, {0.2}};
  EXPECT_TRUE(better(high, low));
  EXPECT_TRUE(better(higher, low)) << "nearer to the limit";
  EXPECT_TRUE(better(low, none));
  EXPECT_FALSE(better(none, none));
}

}  // namespace
}  // namespace pintle::optimiser_test
