// Sections of quadrics by planes, and integrals along them, against antiderivatives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "volume/slices/conic_section.hpp"

namespace test_conic_section {
namespace {

using cmb::convex::cross;
using cmb::convex::dot;
using cmb::convex::norm;
using cmb::convex::normalized;
using cmb::convex::Vec3;
using cmb::overlap::Conic;
using cmb::overlap::Quadric;
using cmb::overlap::Stretch;

constexpr double sphere = 1.0, cylinder = 0.0, cone = -1.0;  // Quadric::third

// Negative or 0 where there are none.
double length(const Stretch &stretch) { return stretch.end - stretch.begin; }

// About `center`, its third axis along `axis`, scaled by 1/stretch.
Quadric quadric(double third, const Vec3 &center, const Vec3 &axis, const Vec3 &stretch) {
  const Vec3 w = normalized(axis), u = cmb::convex::any_perpendicular(w), v = cross(w, u);
  const double along = third == cylinder ? 0.0 : 1.0 / stretch.z;
  const Vec3 rows[3] = {(1.0 / stretch.x) * u, (1.0 / stretch.y) * v, along * w};
  Quadric result;
  result.x = {rows[0].x, rows[1].x, rows[2].x};
  result.y = {rows[0].y, rows[1].y, rows[2].y};
  result.z = {rows[0].z, rows[1].z, rows[2].z};
  result.origin = {-dot(rows[0], center), -dot(rows[1], center), -dot(rows[2], center)};
  result.third = third, result.level = third == cone ? 0.0 : 1.0;
  return result;
}

// The section's equation a z^2 + 2 (b0 + b1 x) z + c0 + 2 c1 x + c2 x^2 = 0 from its definition, and what follows from it.
class Equation {
 public:
  // `vanishing`: how many of D's coefficients are zero but for rounding, 1 for a parabola, 2 for parallel lines.
  Equation(const Quadric &q, double y, int vanishing) {
    const auto product = [&](const Vec3 &f, const Vec3 &g) -> long double {
      return static_cast<long double>(f.x) * g.x + static_cast<long double>(f.y) * g.y +
             static_cast<long double>(q.third) * f.z * g.z;
    };
    const Vec3 f = q.origin + y * q.y;
    a = product(q.z, q.z), b0 = product(q.z, f), b1 = product(q.z, q.x);
    const long double c0 = product(f, f) - static_cast<long double>(q.level), c1 = product(f, q.x), c2 = product(q.x, q.x);
    d0 = b0 * b0 - a * c0, d1 = b0 * b1 - a * c1, d2 = b1 * b1 - a * c2;
    if (vanishing > 0) d2 = 0.0;
    if (vanishing > 1) d1 = 0.0;
  }
  long double root(long double x) const { return std::sqrt(std::max(0.0L, d0 + x * (2 * d1 + x * d2))); }
  long double z(bool upper, long double x) const { return (-b0 - b1 * x + (upper ? root(x) : -root(x))) / a; }
  // Over x: integrals of the root and of x times the root.
  long double of_root(long double low, long double high) const { return roots(high) - roots(low); }
  long double of_x_root(long double low, long double high) const { return x_roots(high) - x_roots(low); }
  static long double power(int n, long double low, long double high) {
    return (std::pow(high, n + 1) - std::pow(low, n + 1)) / (n + 1);
  }

  long double a, b0, b1, d0, d1, d2;

 private:
  long double roots(long double x) const {
    const long double r = root(x);
    if (d2 == 0.0L) return d1 == 0.0L ? r * x : r * r * r / (3 * d1);
    const long double slope = d2 * x + d1, rest = d0 * d2 - d1 * d1;
    const long double inverse = d2 > 0 ? std::log(std::fabs(slope + std::sqrt(d2) * r)) / std::sqrt(d2)
                                       : -std::atan2(slope, std::sqrt(-d2) * r) / std::sqrt(-d2);
    return (slope * r + (rest == 0 ? 0 : rest * inverse)) / (2 * d2);
  }
  long double x_roots(long double x) const {
    const long double r = root(x);
    if (d2 == 0.0L) return d1 == 0.0L ? r * x * x / 2 : (2 * r * r / 5 - 2 * d0 / 3) * r * r * r / (4 * d1 * d1);
    return (r * r * r / 3 - d1 * roots(x)) / d2;
  }
};

struct Integrals {
  double area = 0.0, x = 0.0, xx = 0.0, z = 0.0, zz = 0.0, xz = 0.0;

  Integrals() = default;
  Integrals(const Conic &conic, bool upper, double from, double to) {
    conic.integrate(upper, from, to, [&](double at_x, double at_z, double weight) {
      area += weight, x += weight * at_x, xx += weight * at_x * at_x;
      z += weight * at_z, zz += weight * at_z * at_z, xz += weight * at_x * at_z;
    });
  }
  // The same by antiderivatives: z = (-b + r)/a or (-b - r)/a.
  Integrals(const Equation &e, bool upper, double from, double to) {
    const auto power = [&](int n) { return Equation::power(n, from, to); };
    const long double sign = upper ? 1.0L : -1.0L, r = sign * e.of_root(from, to), xr = sign * e.of_x_root(from, to);
    area = static_cast<double>(power(0)), x = static_cast<double>(power(1)), xx = static_cast<double>(power(2));
    z = static_cast<double>((r - e.b0 * power(0) - e.b1 * power(1)) / e.a);
    xz = static_cast<double>((xr - e.b0 * power(1) - e.b1 * power(2)) / e.a);
    const long double squares = e.b0 * e.b0 * power(0) + 2 * e.b0 * e.b1 * power(1) + e.b1 * e.b1 * power(2) +
                                e.d0 * power(0) + 2 * e.d1 * power(1) + e.d2 * power(2);
    zz = static_cast<double>((squares - 2 * (e.b0 * r + e.b1 * xr)) / (e.a * e.a));
  }
};

void expect_near(const Integrals &found, const Integrals &expected, double slack, const char *what) {
  EXPECT_NEAR(found.area, expected.area, slack) << what;
  EXPECT_NEAR(found.x, expected.x, slack) << what;
  EXPECT_NEAR(found.xx, expected.xx, slack) << what;
  EXPECT_NEAR(found.z, expected.z, slack) << what;
  EXPECT_NEAR(found.zz, expected.zz, slack) << what;
  EXPECT_NEAR(found.xz, expected.xz, slack) << what;
}

// Stretches that begin or end where the conic does, at all, next to it and far from it, and all over.
std::vector<Stretch> stretches(const Stretch &reach) {
  const double length = reach.end - reach.begin;
  const auto at = [&](double s) { return reach.begin + s * length; };
  return {{reach.begin, reach.end}, {reach.begin, at(0.5)},  {at(0.5), reach.end},  {reach.begin, at(0.02)},
          {at(0.98), reach.end},    {at(0.01), at(0.011)},   {at(0.9), at(0.901)},  {at(0.1), at(0.15)},
          {at(0.9), at(0.95)},      {at(0.2), at(0.9)},      {at(0.05), at(0.3)},   {at(1e-9), at(1e-8)}};
}

// What holds of a section that has points: they are on the surface, integrals are those of the antiderivatives.
void check(const Quadric &q, double y, double low, double high, const char *what, int vanishing = 0) {
  const Conic conic(q, y, low, high);
  const Equation equation(q, y, vanishing);
  ASSERT_GT(length(conic.reach()), 0.0) << what;
  EXPECT_GE(conic.reach().begin, low) << what;
  EXPECT_LE(conic.reach().end, high) << what;
  for (const Stretch &part : stretches(conic.reach())) {
    const double middle = 0.5 * (part.begin + part.end);
    const Stretch z = conic.at(middle);
    ASSERT_GT(length(z), 0.0) << what;
    for (const bool upper : {false, true}) {
      const double side = upper ? z.end : z.begin;
      if (!std::isfinite(side)) continue;  // a cone that holds the lines along z
      const Vec3 f = q.at({middle, y, side});
      EXPECT_NEAR(q.product(f, f), q.level, 1e-10 * (1.0 + norm(f) * norm(f))) << what;
      if (q.third == cone) {
        EXPECT_LE(f.z, 1e-10) << what << ": the other nappe";
      }
      EXPECT_NEAR(side, static_cast<double>(equation.z(upper, middle)), 1e-9 * (1.0 + std::fabs(side))) << what;
      // Ends of stretches are known to rounding.
      const double scale = (1.0 + side * side) * std::max(1.0, std::fabs(part.begin));
      const double slack = scale * (1e-10 * (part.end - part.begin) + 4e-15);
      expect_near({conic, upper, part.begin, part.end}, {equation, upper, part.begin, part.end}, slack, what);
    }
  }
  EXPECT_LE(length(conic.at(low - 1.0)), 0.0) << what;
  EXPECT_LE(length(conic.at(high + 1.0)), 0.0) << what;
}

TEST(ConicSection, Ellipses) {
  check(quadric(sphere, {0.2, 0.1, -0.3}, {0, 0, 1}, {1, 1, 1}), 0.4, -5, 5, "circle");
  check(quadric(sphere, {0.2, 0.1, -0.3}, {1, 2, -1}, {0.5, 1.5, 0.7}), 0.3, -5, 5, "ellipsoid");
  check(quadric(sphere, {}, {1, 2, -1}, {0.5, 1.5, 0.7}), 0.0, -0.3, 0.1, "an ellipsoid's middle");
  check(quadric(cylinder, {0.1, 0, 0.2}, {0.2, 1, -0.1}, {0.4, 0.4, 1}), 0.5, -5, 5, "cylinder");
  check(quadric(cylinder, {0.1, 0, 0.2}, {0, 1, 0}, {0.4, 0.4, 1}), 7.0, -5, 5, "cylinder along y");
  check(quadric(cone, {0, 1, 0}, {0.1, 1, 0.2}, {0.5, 0.5, 1}), 0.2, -5, 5, "cone");
}

TEST(ConicSection, HyperbolasOfBothBranches) {
  for (const double tilt : {-0.3, 0.0, 0.2}) {
    // Axis along x: the branch reaches to the left of the apex, or to the right of it.
    check(quadric(cone, {0, 0, 0}, {1, tilt, 0.1}, {0.5, 0.5, 1}), 0.2, -3, 3, "to the left");
    check(quadric(cone, {0, 0, 0}, {-1, tilt, 0.1}, {0.5, 0.5, 1}), 0.2, -3, 3, "to the right");
    check(quadric(cone, {0, 0, 0}, {-1, tilt, 0.1}, {0.5, 0.5, 1}), 1e-3, -3, 3, "next to the apex");
  }
}

TEST(ConicSection, HyperbolaThroughTheApexIsTwoLines) {
  // In the limit of planes ever nearer to the apex: a wedge of slopes +-1/2, without loss of digits.
  const Quadric q = quadric(cone, {0, 0, 0}, {-1, 0, 0}, {0.5, 0.5, 1});
  for (const double y : {1e-9, 1e-20, 1e-60, 1e-100}) {
    const Conic conic(q, y, -3, 3);
    const Integrals upper(conic, true, conic.reach().begin, 3.0);
    EXPECT_NEAR(upper.area, 3.0, 1e-8);
    EXPECT_NEAR(upper.z, 2.25, 1e-8) << y;
    EXPECT_NEAR(upper.xz, 4.5, 1e-8) << y;
    EXPECT_NEAR(upper.zz, 2.25, 1e-8) << y;
  }
}

TEST(ConicSection, HyperbolasOpenToAllX) {
  check(quadric(cone, {0, 0, 0}, {0, 0.1, 1}, {0.5, 0.5, 1}), 0.3, -2, 2, "axis up");
  check(quadric(cone, {0.2, 0.1, 0.5}, {0.1, 0.1, -1}, {0.5, 0.5, 1}), 0.3, -2, 2, "axis down");
  const Conic through_the_apex(quadric(cone, {0, 0, 0}, {0, 0, 1}, {0.5, 0.5, 1}), 0.0, -2, 2);
  EXPECT_NEAR(Integrals(through_the_apex, true, -2.0, 2.0).z, -8.0, 1e-9) << "z = -2 |x|";
}

TEST(ConicSection, Parabolas) {
  // Mantle lines at 45 degrees to the axis, the plane along one of them.
  for (const double way : {1.0, -1.0}) {
    const Quadric q = quadric(cone, {0, 0, 0}, {way, 1, 0}, {1, 1, 1});
    for (const double y : {-0.3, -1.0}) check(q, y, -4, 4, way > 0.0 ? "to the left" : "to the right", 1);
  }
  // z^2 = -2 x y + y^2: at its vertex, by hand.
  const Conic conic(quadric(cone, {0, 0, 0}, {-1, 1, 0}, {1, 1, 1}), -0.5, -4, 4);
  const double from = conic.reach().begin, length = 0.5;
  EXPECT_NEAR(std::fabs(from), 0.0, 1e-15);
  EXPECT_NEAR(Integrals(conic, true, from, from + length).z, 2.0 / 3.0 * std::sqrt(std::pow(length, 3)), 1e-14);
}

TEST(ConicSection, CylindersAlongTheSlice) {
  check(quadric(cylinder, {0.1, 0.2, 0.3}, {1, 0, 0.4}, {0.5, 0.5, 1}), 0.4, -2, 2, "two parallel lines", 2);
  EXPECT_LE(length(Conic(quadric(cylinder, {0.1, 0.2, 0.3}, {1, 0, 0.4}, {0.5, 0.5, 1}), 0.8, -2, 2).at(0.0)), 0.0);
  // Lines along z within a strip.
  const Conic strip(quadric(cylinder, {0.1, 0, 0}, {0, 0, 1}, {0.5, 0.5, 1}), 0.3, -2, 2);
  EXPECT_NEAR(strip.reach().begin, -0.3, 1e-15);
  EXPECT_NEAR(strip.reach().end, 0.5, 1e-15);
  EXPECT_EQ(strip.at(0.2).begin, -HUGE_VAL);
  EXPECT_EQ(strip.at(0.2).end, HUGE_VAL);
  double ends[2];
  EXPECT_EQ(strip.ends(ends), 2);
  EXPECT_EQ(Integrals(strip, true, 0.0, 0.1).area, 0.0) << "no sides";
  EXPECT_LE(length(Conic(quadric(cylinder, {0.1, 0, 0}, {0, 0, 1}, {0.5, 0.5, 1}), 0.6, -2, 2).at(0.1)), 0.0);
  // So wide that x does not matter: all inside, or all outside.
  const Quadric wide = quadric(cylinder, {0, 0, 0}, {0, 0, 1}, {1e16, 1e16, 1});
  EXPECT_EQ(Conic(wide, 0.0, -1e-3, 1e-3).at(0.0).end, HUGE_VAL);
  EXPECT_LE(length(Conic(wide, 2e16, -1e-3, 1e-3).at(0.0)), 0.0);
}

TEST(ConicSection, EmptyOnesHaveNoSides) {
  const Conic beside(quadric(sphere, {}, {0, 0, 1}, {1, 1, 1}), 1.1, -2, 2);
  const Conic behind_the_apex(quadric(cone, {}, {0, 1, 0}, {1, 1, 1}), 0.5, -2, 2);
  const Conic other_nappe(quadric(cone, {}, {0.3, 1, 0.2}, {0.5, 0.5, 1}), 0.5, -2, 2);
  const Conic left_of_the_stretch(quadric(sphere, {-4, 0, 0}, {0, 0, 1}, {1, 1, 1}), 0.0, -2, 2);
  for (const Conic &conic : {beside, behind_the_apex, other_nappe, left_of_the_stretch, Conic()}) {
    double ends[2];
    EXPECT_LE(length(conic.at(0.0)), 0.0);
    EXPECT_EQ(conic.ends(ends), 0);
    EXPECT_EQ(Integrals(conic, true, 0.0, 1.0).area, 0.0);
  }
}

TEST(ConicSection, CirclesCrossOnTheirChord) {
  // Middles 1 apart along x, radii 0.8 and 0.6: x = (1 + 0.64 - 0.36)/2.
  const Conic first(quadric(sphere, {}, {0, 0, 1}, {0.8, 0.8, 0.8}), 0.0, -2, 2);
  const Conic second(quadric(sphere, {1, 0, 0}, {0, 0, 1}, {0.6, 0.6, 0.6}), 0.0, -2, 2);
  double x[7];
  const int count = first.crossings(second, -2.0, 2.0, x);
  ASSERT_GE(count, 1);
  EXPECT_TRUE(std::any_of(x, x + count, [](double place) { return std::fabs(place - 0.64) < 1e-12; }));
  const Conic wall(quadric(cylinder, {}, {0, 0, 1}, {0.5, 0.5, 1}), 0.0, -2, 2);
  EXPECT_EQ(first.crossings(wall, -2.0, 2.0, x), 0);
  EXPECT_EQ(wall.crossings(first, -2.0, 2.0, x), 0);
  EXPECT_EQ(first.crossings(second, 1.9, 2.0, x), 0) << "beyond the first";
}

// The part of a line inside a quadric: its ends are on the surface, its middle is inside.
TEST(Quadric, StretchesOfLines) {
  std::mt19937 engine(2);
  const auto random = [&] { return 2.0 * (static_cast<double>(engine() >> 5) / 134217728.0) - 1.0; };
  const auto vector = [&] { return Vec3{random(), random(), random()}; };
  int found = 0, half_lines = 0;
  for (int sample = 0; sample < 3000; ++sample) {
    const double third = sample % 3 == 0 ? sphere : sample % 3 == 1 ? cylinder : cone;
    const Quadric q = quadric(third, vector(), vector(), {0.3 + std::fabs(random()), 0.8, 0.7});
    const Vec3 p = vector(), along = vector();
    const Stretch inside = q.stretch(q.at(p), q.along(along));
    const auto level = [&](double s) {
      const Vec3 f = q.at(p + s * along);
      return q.product(f, f) - q.level;
    };
    if (!(length(inside) > 0.0)) {
      for (const double s : {-3.0, -1.0, 0.0, 0.5, 1.0, 4.0}) {
        EXPECT_FALSE(level(s) < -1e-9 && (third != cone || q.at(p + s * along).z < -1e-9)) << sample;
      }
      continue;
    }
    ++found;
    for (const double s : {inside.begin, inside.end}) {
      if (!std::isfinite(s)) {
        ++half_lines;
        continue;
      }
      EXPECT_NEAR(level(s), 0.0, 1e-8 * (1.0 + s * s * dot(q.along(along), q.along(along)))) << sample;
    }
    const double middle = std::isfinite(inside.begin + inside.end) ? 0.5 * (inside.begin + inside.end)
                          : std::isfinite(inside.begin)            ? inside.begin + 1.0
                                                                   : inside.end - 1.0;
    EXPECT_LT(level(middle), 1e-12) << sample;
    if (third == cone) {
      EXPECT_LT(q.at(p + middle * along).z, 0.0) << sample;
    }
  }
  EXPECT_GT(found, 800);
  EXPECT_GT(half_lines, 20);
  // Along a cylinder's axis, and of a point.
  const Quadric tube = quadric(cylinder, {}, {0, 0, 1}, {1, 1, 1});
  EXPECT_EQ(tube.stretch(tube.at({0.5, 0, 0}), tube.along({0, 0, 1})).end, HUGE_VAL);
  EXPECT_LE(length(tube.stretch(tube.at({1.5, 0, 0}), tube.along({0, 0, 1}))), 0.0);
  const Quadric funnel = quadric(cone, {}, {0, 0, 1}, {1, 1, 1});
  EXPECT_LE(length(funnel.stretch(funnel.at({0.5, 0, 0}), Vec3{})), 0.0);
}

}  // namespace
}  // namespace test_conic_section
