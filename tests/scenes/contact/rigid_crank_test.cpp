// The slider-crank of Flores, Leine and Glocker (2010), whose block has 1 mm of play in its guide: impacts of both corners of a side at
// once, their accumulation, sliding along the guide and lift-off. Numbers by two coordinates and 45 digits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "framework/scene/yaml/reader.h"
#include "tests/scenes/contact/rigid_scenes.h"

namespace pintle::rigid_crank_test {
namespace {

using pintle_scenes::at, pintle_scenes::expect_sound, pintle_scenes::run, pintle_scenes::Whole;

struct Meeting {
  double t, approach, separation;  ///< [s], [m/s]
};
const std::vector<Meeting> meetings{{0.00269250275202121214, 0.841612322032868641, 0.336644928813147456},
                                    {0.00561236319021041752, 0.247825646300342952, 0.0991302585201371807},
                                    {0.00747505621239662993, 0.0842042824304190648, 0.0336817129721676259},
                                    {0.00842176793424929846, 0.0311431338923009656, 0.0124572535569203862},
                                    {0.00884570525012959472, 0.0120285684657767383, 0.0048114273863106953},
                                    {0.00902388009711049208, 0.0047407535108173192, 0.00189630140432692768},
                                    {0.00909663775630188808, 0.0018848374467620157, 0.000753934978704806281},
                                    {0.00912598685995084022, 0.000752090080709941649, 0.00030083603228397666},
                                    {0.00913776640508692, 0.00030054014778889034, 0.000120216059115556136},
                                    {0.00914248464279196459, 0.000120168672264785774, 0.0000480674689059143098}};
struct Speeds {
  double ms, crank, rod;  ///< [rad/s]
};
const std::vector<Speeds> speeds{{1, 139.115875789904557, -68.2762941942024626},  {2, 120.463881713558296, -56.4733941424503119},
                                 {3, 104.478888025084106, -50.0347476706527506},  {4, 93.4579279079959249, -42.4804517147360962},
                                 {5, 85.6381700822023956, -36.7292104980424743},  {6, 79.4224451929059035, -33.1373552931843401},
                                 {7, 75.1835253182536013, -29.3913502531837442},  {8, 71.8033833310960827, -26.5279940578503387},
                                 {9, 69.3162691484959131, -23.8930587648219786},  {10, 67.4719285188995891, -21.5014050975078177},
                                 {11, 66.1667551712928875, -19.2560059905202853}, {12, 65.3158879954221127, -17.1064107192821166},
                                 {13, 64.8680077622706472, -15.0033424340261648}, {14, 64.791316820378895, -12.9042646874135527},
                                 {15, 65.0690728022417755, -10.7703080178292692}, {16, 65.6878939743193162, -8.57578634478887583},
                                 {17, 66.6419151852185758, -6.29870118416427543}, {18, 67.9434288968938789, -3.90450348146517597},
                                 {19, 69.6134616846613521, -1.35701617738382364}, {20, 71.6817658125635746, 1.38252671778195247}};

Scene scene(const std::string& method) {
  Scene s = read_scene(std::string(PINTLE_SOURCE_DIR) + "/examples/guide_with_play.yaml");
  ScenePlay& play = *s.joints.back().play;
  play.impact = SceneImpact{.restitution = 0.4};
  play.friction = SceneFriction{};
  play.friction->law = "coulomb", play.friction->coefficient = 0.01;
  s.run.method = method, s.run.tolerance = 1e-11, s.run.until = 20.5e-3;
  s.output.every = 1e-3, s.output.frames = 0;
  return s;
}

class RigidCrank : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, RigidCrank, testing::Values("dopri5", "rkf45", "verner87"),
                         [](const auto& i) { return std::string(i.param); });

// The tolerance is of a step, in parts of the motion; some thousand steps and the crank's 150 rad/s make bounds of it.
constexpr double fine = 1e-8;

TEST_P(RigidCrank, MeetsItsGuideWithBothCorners) {
  const Whole w = run(scene(GetParam()));
  expect_sound(w);
  ASSERT_GE(w.run.impacts.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const Meeting& m = meetings[i / 2];
    const Impact& impact = w.run.impacts[i];
    EXPECT_NEAR(impact.begin, m.t, 10 * fine * m.t / m.approach * 1e-3) << i;  // what the gap is off, over the speed
    EXPECT_NEAR(impact.approach, m.approach, fine) << i;
    EXPECT_NEAR(impact.separation, m.separation, fine) << i;
  }
}

TEST_P(RigidCrank, SlidesAlongItsGuideAndLifts) {
  const Whole w = run(scene(GetParam()));
  std::vector<Impact> stays;
  for (const Impact& i : w.run.impacts)
    if (!(i.end == i.begin) && i.begin < 0.015) stays.push_back(i);
  ASSERT_EQ(stays.size(), 2u);
  for (const Impact& i : stays) {
    EXPECT_NEAR(i.begin, 9.14563217737486e-3, 1e-9 * 9e-3);
    EXPECT_NEAR(i.end, 15.0286517484596e-3, fine * 15e-3);
    EXPECT_EQ(i.separation, 0);
  }
  for (const Speeds& s : speeds) {
    EXPECT_NEAR(at(w, "crank.speed [rad/s]", s.ms * 1e-3), s.crank, 150 * fine) << s.ms;
    EXPECT_NEAR(at(w, "rod.speed [rad/s]", s.ms * 1e-3), s.rod, 150 * fine) << s.ms;
  }
}

}  // namespace
}  // namespace pintle::rigid_crank_test
