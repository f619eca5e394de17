// Surfaces of lines, arcs and curves: their pieces, and the gap between any two, against points sampled on both.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "contact/gap.h"
#include "contact/profile.h"

namespace pintle::profile_test {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

const std::vector<PathPoint> square{{{0, 0}}, {{2, 0}}, {{2, 1}}, {{0, 1}}};

int corners(const Profile& p) { return static_cast<int>(std::count_if(p.pieces.begin(), p.pieces.end(), is_corner)); }

TEST(Profile, OfARectangleHasItsSidesAndCorners) {
  const Profile p = profile_along(square, true);
  ASSERT_EQ(p.pieces.size(), 8u);
  EXPECT_EQ(corners(p), 4);
  EXPECT_TRUE(std::all_of(p.goes_on.begin(), p.goes_on.end(), [](bool b) { return b; }));
  EXPECT_NEAR(p.pieces[0].normal, -pi / 2, 1e-15);  // the lower side faces down
  EXPECT_NEAR(p.pieces[0].half, 1, 1e-15);
  EXPECT_NEAR(p.pieces[1].half, pi / 4, 1e-15);
  EXPECT_NEAR(p.deepest[0], 0.5, 1e-12);  // half way to the upper side
  EXPECT_NEAR(p.deepest[2], 1, 1e-12);
}

TEST(Profile, GoesRoundTheOtherWayReversed) {
  EXPECT_DOUBLE_EQ(area(square), 2);
  EXPECT_DOUBLE_EQ(area(reversed(square, true)), -2);
  const std::vector<PathPoint> bow{{{0, 0}, 0}, {{1, 0}, 1}, {{0, 1}, 0}};  // a quarter of a disc
  EXPECT_NEAR(area(bow), pi / 4, 1e-15);
  EXPECT_NEAR(area(reversed(bow, true)), -pi / 4, 1e-15);
  const std::vector<PathPoint> open = reversed({{{0, 0}, 2}, {{1, 0}, 0}, {{2, 1}, 0}}, false);
  EXPECT_EQ(open[0].at, Vector2d(2, 1));
  EXPECT_EQ(open[0].arc, 0);
  EXPECT_EQ(open[1].arc, -2);
}

TEST(Profile, RoundsCornersWithArcsThatTouchBothSides) {
  const Profile p = profile_along(square, true, 0.1);
  ASSERT_EQ(p.pieces.size(), 8u);
  EXPECT_EQ(corners(p), 0);
  for (std::size_t i = 0; i < 8; ++i) {
    const Vector2d end = drawn(p.pieces[i]).back(), begin = drawn(p.pieces[(i + 1) % 8]).front();
    EXPECT_LT((end - begin).norm(), 1e-14) << i;
    EXPECT_NEAR(p.pieces[i].straight ? 0.1 : p.pieces[i].radius, 0.1, 1e-15);
  }
  // So far that two sides are arcs alone: a stadium.
  const Profile stadium = profile_along(square, true, 0.5);
  EXPECT_EQ(stadium.pieces.size(), 6u);
}

// A hollow arc has the material outside it: it turns right along a path with the material at the left.
TEST(Profile, TurnsHollowToTheRight) {
  const Profile p = profile_along({{{-1, 0}, -1}, {{1, 0}, 0}}, false);
  ASSERT_EQ(p.pieces.size(), 3u);
  EXPECT_EQ(p.pieces[1].radius, -1);
  EXPECT_LT(p.pieces[1].centre.norm(), 1e-15);
  EXPECT_LT((drawn(p.pieces[1])[45] - Vector2d(0, 1)).norm(), 0.1);
  EXPECT_LT((drawn(p.pieces[1]).front() - Vector2d(-1, 0)).norm(), 1e-14);
}

TEST(Profile, ReentrantCornersAreNoPieces) {
  const Profile step = profile_along({{{0, 0}}, {{1, 0}}, {{1, -1}}, {{2, -1}}}, false);  // down and on
  ASSERT_EQ(step.pieces.size(), 6u);  // two ends, three sides, the corner that points outwards
}

// Where a path closes, rounding does not make its first and last side cross.
TEST(Profile, AnyConvexPolygonIsSimple) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int n = 3; n <= 8; ++n)
    for (int draw = 0; draw < 200; ++draw) {
      std::vector<PathPoint> path;
      const double first = pi * unit(generator);
      for (int i = 0; i < n; ++i) {
        const double angle = first + 2 * pi * (i + 0.2 * unit(generator)) / n;
        path.push_back({{0.07 * std::cos(angle), 0.07 * std::sin(angle)}});
      }
      EXPECT_NO_THROW(profile_along(path, true));
      EXPECT_NO_THROW(profile_along(path, true, 1e-3));
    }
}

// ---- splines ------------------------------------------------------------------------------------

std::vector<Vector2d> ellipse(int n, double a, double b) {
  std::vector<Vector2d> out;
  for (int i = 0; i < n; ++i) out.emplace_back(a * std::cos(2 * pi * i / n), b * std::sin(2 * pi * i / n));
  return out;
}

// Through n points of a circle a spline is O(h⁴) from it, and its curvature O(h²): twice the points, a sixteenth and a quarter.
TEST(Spline, TendsToTheCircleThatItsPointsAreOf) {
  const auto errors = [](int n) {
    const SmoothCurve curve(ellipse(n, 1, 1), true);
    std::array<double, 3> out{0, 0, 0};
    for (int i = 0; i < 40 * n; ++i) {
      const CurvePoint p = curve.at(curve.length() * i / (40 * n));
      out[0] = std::max(out[0], std::abs(p.at.norm() - 1));
      out[1] = std::max(out[1], std::abs(p.along.dot(p.at.normalized())));
      out[2] = std::max(out[2], std::abs(p.curvature - 1));
    }
    return out;
  };
  const std::array<double, 3> order{4, 3, 2};
  for (const int n : {16, 32, 64}) {
    const auto coarse = errors(n), fine = errors(2 * n);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(std::log2(coarse[k] / fine[k]), order[k], 0.5) << n << " " << k;
  }
}

// An ellipse of half-axes 2 and 1: spans cut it by its turning, the curvature is ab/(a² sin² + b² cos²)^1.5.
TEST(Spline, OfAnEllipseHasItsCurvatureAndItsMaterialInside) {
  const Profile p = profile_through(ellipse(200, 2, 1), true);
  ASSERT_EQ(p.pieces.size(), 8u);
  EXPECT_TRUE(solid(p));
  EXPECT_EQ(corners(p), 0);
  EXPECT_TRUE(std::all_of(p.goes_on.begin(), p.goes_on.end(), [](bool b) { return b; }));
  const double h = 2 * pi / 200;
  for (std::size_t i = 0; i < 8; ++i) {
    const CurveSpan& span = *p.pieces[i].curve;
    EXPECT_NEAR(span.turn(), pi / 4, 1e-6);
    for (const double part : {0.0, 0.3, 0.7, 1.0}) {
      const CurvePoint at = span.at(span.begin() + part * (span.end() - span.begin()));
      const double angle = std::atan2(at.at.y(), at.at.x() / 2), s = std::sin(angle), c = std::cos(angle);
      const double exact = 2 / std::pow(4 * s * s + c * c, 1.5);
      EXPECT_NEAR(at.curvature, exact, 50 * h * h) << i;  // its second derivative along the curve is 36 at most, and chords grow
    }
    EXPECT_LE(p.deepest[i], 2);
    EXPECT_GT(p.deepest[i], 0.5 - 1e-6);
  }
}

// A cubic is met exactly by an open spline: y = x³ − x bends right up to its inflection at 0, left beyond.
TEST(Spline, OpenIsCutAtItsInflectionAndEndsInCorners) {
  std::vector<Vector2d> points;
  for (int i = 0; i <= 40; ++i) points.emplace_back(-1 + 0.05 * i, std::pow(-1 + 0.05 * i, 3) / 3);
  const Profile p = profile_through(points, false);
  EXPECT_EQ(corners(p), 2);
  bool found = false;
  for (std::size_t i = 1; i + 1 < p.pieces.size(); ++i) {
    EXPECT_EQ(is_hollow(p.pieces[i]), drawn(p.pieces[i])[1].x() < 0);
    const Vector2d end = drawn(p.pieces[i]).back();
    if (end.norm() < 1e-3) found = true;
    if (i + 2 < p.pieces.size()) {
      EXPECT_LT((end - drawn(p.pieces[i + 1]).front()).norm(), 1e-14);
    }
  }
  EXPECT_TRUE(found);
}

TEST(Spline, RefusesWhatIsNoSurface) {
  const auto says = [](const std::vector<Vector2d>& points, bool closed) -> std::string {
    try {
      profile_through(points, closed);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing";
  };
  const auto expect = [](const std::string& said, const char* words) {
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("; "), std::string::npos) << "no remedy: " << said;
  };
  expect(says({{0, 0}, {1, 0}}, true), "has 2 points; a spline takes 3");
  expect(says({{0, 0}, {1, 0}, {2, 1}}, false), "has 3 points; a spline takes 4");
  expect(says({{0, 0}, {1, 0}, {1, 0}, {0, 1}}, true), "no length between point 2 and point 3");
  expect(says({{0, 0}, {1, 0}, {0, 1}, {0, 0}}, true), "no length between point 4 and point 1");
  expect(says({{0, 0}, {1, 1}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}, true), "crosses itself");
}

struct Bad {
  std::vector<PathPoint> path;
  bool closed;
  double round;
  const char* says;
};

TEST(Profile, RefusesWhatIsNoSurface) {
  const std::vector<Bad> all{
      {{{{0, 0}}}, false, 0, "fewer than two points"},
      {{{{0, 0}}, {{1, 0}}}, true, 0, "fewer than three points"},
      {{{{0, 0}}, {{1, 0}}, {{1, 0}}, {{0, 1}}}, true, 0, "no length between point 2 and point 3"},
      {{{{0, 0}}, {{1, 0}}, {{0, 1}}, {{0, 0}}}, true, 0, "no length between point 4 and point 1"},
      {{{{0, 0}, 0.4}, {{1, 0}}}, false, 0, "is too small for"},
      {{{{0, 0}}, {{1, 0}}, {{0.5, 0}}}, false, 0, "turns back on itself at point 2"},
      {{{{0, 0}}, {{1, 1}}, {{1, 0}}, {{0, 1}}}, true, 0, "crosses itself at (0.5"},
      {square, true, 0.6, "no room to round"},
  };
  for (const Bad& bad : all) {
    try {
      profile_along(bad.path, bad.closed, bad.round);
      ADD_FAILURE() << bad.says;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(bad.says), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("; "), std::string::npos) << "no remedy: " << error.what();
    }
  }
}

// ---- the gap between two pieces ---------------------------------------------------------------

const Piece disc{.radius = 0.3, .centre = {0.1, -0.2}}, small{.radius = 0.05, .centre = {0.02, 0.03}},
    hollow{.radius = -0.8, .centre = {0.3, 0.1}}, corner{.radius = 0, .centre = {-0.1, 0.2}, .normal = 1, .half = 1},
    flat{.centre = {0.2, 0.1}, .normal = 2, .half = 40, .straight = true};

// Of a rim of three lobes and three hollows, the span that faces a direction.
Piece span_towards(double direction) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < 36; ++i) {
    const double angle = 2 * pi * i / 36, r = 0.5 + 0.15 * std::cos(3 * angle);
    rim.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  for (const Piece& p : profile_through(rim, true).pieces) {
    const Vector2d begin = drawn(p).front(), end = drawn(p).back(), out(std::cos(direction), std::sin(direction));
    if (begin.x() * out.y() - begin.y() * out.x() >= 0 && end.x() * out.y() - end.y() * out.x() < 0 && begin.dot(out) > 0) return p;
  }
  throw std::logic_error("no span");
}
const Piece lobe = span_towards(0.1), hollow_curve = span_towards(pi / 3 + 0.1);

struct Between {
  const char* name;
  Piece a, b;
};
void PrintTo(const Between& b, std::ostream* out) { *out << b.name; }

class GapBetween : public testing::TestWithParam<Between> {
 protected:
  MovingPoint any() {
    const double x = unit(), y = unit(), vx = unit(), vy = unit(), w = unit();
    return {{x, y}, {vx, vy}, 3 * w, 3 * unit()};
  }
  double unit() { return std::uniform_real_distribution<double>(-1, 1)(generator); }
  static MovingPoint later(const MovingPoint& p, double t) { return {p.r + t * p.v, p.v, p.w, p.angle + t * p.w}; }
  // Places a so that the overlap is what is wished for, whatever the direction.
  MovingPoint pressed(MovingPoint a, const MovingPoint& b, double depth) const {
    const auto& [name, A, B] = GetParam();
    const Gap gap = evaluate({A, B}, a, b);
    a.r += (depth - gap.depth) * gap.n;
    return a;
  }
  // A curve is touched within its ends or so: elsewhere it is straight, or a corner.
  static bool is_off(const Gap& gap) { return std::abs(gap.on_a.at) > 1.1 || std::abs(gap.on_b.at) > 1.1; }
  int draws() const { return GetParam().a.curve || GetParam().b.curve ? 1000 : 20; }
  std::mt19937 generator{7};
};

Vector2d in_body(const MovingPoint& p, const Vector2d& r) { return Eigen::Rotation2Dd(-p.angle) * (r - p.r); }
Vector2d velocity(const MovingPoint& p, const Vector2d& r) {
  const Vector2d d = r - p.r;
  return p.v + p.w * Vector2d(-d.y(), d.x());
}
// The least of a function that falls, then rises.
template <class F>
double least(const F& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double third = (high - low) / 3;
    (f(low + third) < f(high - third) ? high : low) = f(low + third) < f(high - third) ? high - third : low + third;
  }
  return f((low + high) / 2);
}
// How far outside its material a point is, by the piece alone [m].
double outside(const Piece& piece, const Vector2d& x) {
  if (piece.curve) {  // the nearest of many points, and then between its neighbours
    const auto far = [&](double s) { return (piece.curve->at(s).at - x).norm(); };
    const double begin = piece.curve->begin(), h = piece.half / 1000;
    int near = -200;
    for (int i = near; i <= 2200; ++i)
      if (far(begin + i * h) < far(begin + near * h)) near = i;
    const CurvePoint p = piece.curve->at(begin + near * h);
    return std::copysign(least(far, begin + (near - 1) * h, begin + (near + 1) * h), p.normal().dot(x - p.at));
  }
  if (piece.straight) return Vector2d(std::cos(piece.normal), std::sin(piece.normal)).dot(x - piece.centre);
  const double far = (x - piece.centre).norm();
  return piece.radius < 0 ? -piece.radius - far : far - piece.radius;
}

// Along the normal of one surface the other's point lies `depth` inside its material.
TEST_P(GapBetween, DepthIsThatOfTheSurfacePoints) {
  const auto& [name, A, B] = GetParam();
  for (int i = 0; i < draws(); ++i) {
    const MovingPoint b = any(), a = pressed(any(), b, 1e-3);
    const Gap gap = evaluate({A, B}, a, b);
    if (is_off(gap)) continue;
    EXPECT_NEAR(gap.depth, 1e-3, 1e-14);
    const Vector2d on_a = touched(A, a.r + gap.arm_a, gap.n, gap.across), on_b = touched(B, b.r + gap.arm_b, -gap.n, gap.across);
    EXPECT_LT((on_a - on_b - gap.depth * gap.n).norm(), 1e-13);
    EXPECT_NEAR(outside(A, in_body(a, on_a)), 0, 1e-13);
    EXPECT_NEAR(outside(B, in_body(b, on_b)), 0, 1e-13);
    const auto inside = [&](const Piece& p) { return !is_corner(p) ? gap.depth : -gap.depth; };  // of a corner nothing is
    EXPECT_NEAR(outside(B, in_body(b, on_a)), -inside(B), 1e-13);
    EXPECT_NEAR(outside(A, in_body(a, on_b)), -inside(A), 1e-13);
  }
}

TEST_P(GapBetween, RatesAreDifferences) {
  const auto& [name, A, B] = GetParam();
  constexpr double h = 1e-5;
  const double cut = draws() > 20 ? 1e-6 : 1e-7;  // h²/6 of the third derivative of the depth; curves bend more sharply along them
  for (int i = 0; i < draws(); ++i) {
    const MovingPoint b = any(), a = pressed(any(), b, 1e-3);
    const PiecePair pair{A, B};
    const Gap gap = evaluate(pair, a, b), after = evaluate(pair, later(a, h), later(b, h)),
              before = evaluate(pair, later(a, -h), later(b, -h));
    if (is_off(gap)) continue;
    EXPECT_NEAR(gap.rate, (after.depth - before.depth) / (2 * h), cut);
    const double turned = std::atan2(before.n.x() * after.n.y() - before.n.y() * after.n.x(), before.n.dot(after.n));
    EXPECT_NEAR(gap.turning, turned / (2 * h), 1e-4);
    const auto now = places(pair, gap, a, b), next = places(pair, after, later(a, h), later(b, h)),
               last = places(pair, before, later(a, -h), later(b, -h));
    for (std::size_t k = 0; k < 2; ++k)
      if (std::abs(next[k].at - last[k].at) < 1) {
        EXPECT_NEAR(now[k].rate, (next[k].at - last[k].at) / (2 * h), 1e-4 * (1 + std::abs(now[k].rate)));
      }
  }
}

TEST_P(GapBetween, SlipIsThatOfTheMaterial) {
  const auto& [name, A, B] = GetParam();
  for (int i = 0; i < draws(); ++i) {
    const MovingPoint b = any(), a = pressed(any(), b, 0);
    const Gap gap = evaluate({A, B}, a, b);
    if (is_off(gap)) continue;
    const Vector2d t(-gap.n.y(), gap.n.x()), at = touched(B, b.r + gap.arm_b, -gap.n, gap.across);
    EXPECT_NEAR(gap.material_slip, t.dot(velocity(a, at) - velocity(b, at)), 1e-12);
    EXPECT_NEAR(gap.rate, gap.n.dot(velocity(a, at) - velocity(b, at)), 1e-12);
  }
}

TEST_P(GapBetween, SwappedIsTheSameFromTheOtherSide) {
  const auto& [name, A, B] = GetParam();
  for (int i = 0; i < draws(); ++i) {
    const MovingPoint a = any(), b = any();
    const Gap gap = evaluate({A, B}, a, b), other = evaluate({B, A}, b, a);
    if (is_off(gap) || is_off(other)) continue;
    EXPECT_NEAR(gap.depth, other.depth, 1e-14);
    EXPECT_NEAR(gap.rate, other.rate, 1e-13);
    EXPECT_NEAR(gap.material_slip, other.material_slip, 1e-13);
    EXPECT_LT((gap.n + other.n).norm(), 1e-14);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Every, GapBetween,
    testing::Values(Between{"DiscDisc", disc, small}, Between{"DiscHollow", disc, hollow}, Between{"HollowDisc", hollow, small},
                    Between{"DiscLine", disc, flat}, Between{"LineDisc", flat, small}, Between{"CornerLine", corner, flat},
                    Between{"LineCorner", flat, corner}, Between{"CornerDisc", corner, disc}, Between{"CornerHollow", corner, hollow},
                    Between{"LobeDisc", lobe, disc}, Between{"DiscLobe", disc, lobe}, Between{"LobeCorner", lobe, corner},
                    Between{"LobeLine", lobe, flat}, Between{"LineLobe", flat, lobe}, Between{"HollowCurveDisc", hollow_curve, small},
                    Between{"CornerHollowCurve", corner, hollow_curve}, Between{"LobeLobe", lobe, lobe},
                    Between{"LobeHollow", lobe, hollow}, Between{"LobeHollowCurve", lobe, hollow_curve}),
    [](const auto& p) { return std::string(p.param.name); });

// Pieces begin and end where their drawings do: the normal there, as a place on them, is -1 and 1.
TEST(GapPlaces, AreMinusOneAndOneAtTheEndsOfAPiece) {
  const Profile p = profile_along({{{0, 0}, 1}, {{1, 0.5}, 0}, {{2, 0.4}, -0.7}, {{2.6, 1}, 0}}, false);
  for (const Piece& piece : p.pieces) {
    if (!piece.straight && piece.radius == 0) continue;
    const std::vector<Vector2d> points = drawn(piece);
    for (const auto& [end, at] : {std::pair{points.front(), -1.0}, std::pair{points.back(), 1.0}}) {
      const MovingPoint still{{0, 0}, {0, 0}, 0};
      const Vector2d inward = piece.straight ? Vector2d(-std::cos(piece.normal), -std::sin(piece.normal))
                                             : Vector2d((piece.centre - end).normalized() * (piece.radius < 0 ? -1 : 1));
      const MovingPoint probe{end - 0.01 * inward, {0, 0}, 0};  // a small disc that touches there
      const PiecePair pair{{.radius = 0.01}, piece};
      const Gap gap = evaluate(pair, probe, still);
      EXPECT_NEAR(gap.depth, 0, 1e-14);
      EXPECT_NEAR(places(pair, gap, probe, still)[1].at, at, 1e-12);
    }
  }
}

}  // namespace
}  // namespace pintle::profile_test
