// Solid angles of cones of directions against closed forms and against sums of triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/solid_angle.hpp"

namespace {

using namespace cmb;

constexpr double pi = 3.14159265358979323846;

Vec3 sum_of_slopes(const Vec3 &p, const Vec3 &q) {
  return {p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
}

// The same cone by its rays, those of no length left out.
double by_rays(const DirectionArc &p, const DirectionArc &q) {
  DirectionCone cone;
  for (const Vec3 &ray : {sum_of_slopes(p.first, q.first), sum_of_slopes(p.second, q.first),
                          sum_of_slopes(p.second, q.second), sum_of_slopes(p.first, q.second)}) {
    if (norm2(ray) > 0.0) cone.add(ray);
  }
  return cone.solid_angle();
}

TEST(ParallelogramSolidAngle, OfACubesFaceIsASixthOfTheSphere) {
  const DirectionArc p({-1, 0, 1}, {1, 0, 1}), q({0, -1, 1}, {0, 1, 1});
  EXPECT_NEAR(parallelogram_solid_angle(p, q), 4.0 * pi / 6.0, 1e-14);
}

TEST(ParallelogramSolidAngle, OfEdgesOfFlushBoxesIsAWedgeOfTheHemisphere) {
  // Level faces and walls, at all angles of the edges: slopes from none to infinite ones.
  for (const double angle : {1e-6, 0.3, 1.0, 0.5 * pi, 2.0, 3.1}) {
    const DirectionArc p({0, 0, 1}, {1, 0, 0}), q({0, 0, 1}, {std::cos(angle), std::sin(angle), 0});
    EXPECT_NEAR(parallelogram_solid_angle(p, q), angle, 1e-14) << angle;
    // In any order of the ends.
    EXPECT_NEAR(parallelogram_solid_angle({p.second, p.first}, q), angle, 1e-14) << angle;
    EXPECT_NEAR(parallelogram_solid_angle(p, {q.second, q.first}), angle, 1e-14) << angle;
    EXPECT_NEAR(parallelogram_solid_angle({p.second, p.first}, {q.second, q.first}), angle, 1e-14) << angle;
  }
}

TEST(ParallelogramSolidAngle, IsContinuousWhereWallsTilt) {
  for (const double tilt : {1e-3, 1e-9, 1e-17, 1e-60, 1e-200, 1e-310}) {
    const DirectionArc p({0, 0, 1}, {1, 0, tilt}), q({0, 0, 1}, {0.6, 0.8, tilt});
    EXPECT_NEAR(parallelogram_solid_angle(p, q), std::acos(0.6), 4.0 * tilt + 1e-14) << tilt;
  }
}

TEST(ParallelogramSolidAngle, IsThatOfItsRays) {
  std::mt19937 engine(1);
  const auto random = [&engine](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 5) / 134217728.0);
  };
  for (int sample = 0; sample < 10000; ++sample) {
    const double scale = std::pow(10.0, random(-3.0, 0.0));
    const auto direction = [&] { return Vec3{random(-1.0, 1.0), random(-1.0, 1.0), scale * random(0.01, 1.0)}; };
    const DirectionArc p(direction(), direction()), q(direction(), direction());
    EXPECT_NEAR(parallelogram_solid_angle(p, q), by_rays(p, q), 1e-11) << sample;
  }
}

}  // namespace
