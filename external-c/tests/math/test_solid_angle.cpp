// Solid angles of cones of directions against closed forms and against sums of triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "math/solid_angle.hpp"

namespace {

using namespace cmb;

constexpr double pi = 3.14159265358979323846;

Vec3 sum_of_slopes(const Vec3 &p, const Vec3 &q) {
  return {p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
}

// Rays of no length left out.
DirectionCone cone_of(const std::vector<Vec3> &rays) {
  DirectionCone cone;
  for (const Vec3 &ray : rays) {
    if (norm2(ray) > 0.0) cone.add(ray);
  }
  return cone;
}

// The same cone by its rays.
double by_rays(const DirectionArc &p, const DirectionArc &q) {
  return cone_of({sum_of_slopes(p.first, q.first), sum_of_slopes(p.second, q.first), sum_of_slopes(p.second, q.second),
                  sum_of_slopes(p.first, q.second)}).solid_angle();
}

// `count` rays at the angle `open` about the z axis.
std::vector<Vec3> ring(int count, double open) {
  std::vector<Vec3> rays;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * pi * k / count;
    rays.push_back({std::sin(open) * std::cos(angle), std::sin(open) * std::sin(angle), std::cos(open)});
  }
  return rays;
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

// Rays on a circle about an axis: a pyramid, by its angle defect.
TEST(DirectionCone, OfARegularPyramid) {
  for (const int count : {3, 4, 7, 60, 128}) {
    for (const double open : {0.01, 0.7, 1.5}) {
      // Half the angle at each corner of the spherical polygon: cot(x) = cos(open) tan(pi/n).
      const double corner = 2.0 * std::atan2(1.0, std::cos(open) * std::tan(pi / count));
      const DirectionCone cone = cone_of(ring(count, open));
      EXPECT_FALSE(cone.empty());
      EXPECT_NEAR(cone.solid_angle(), count * corner - (count - 2) * pi, 1e-12 * count) << count << " " << open;
    }
  }
}

TEST(DirectionCone, DoesNotDependOnTheRaysLengths) {
  const std::vector<Vec3> rays = {{1, 0.1, 0.5}, {0.3, 1, 0.4}, {-0.6, 0.8, 0.7}, {-1, -0.5, 0.6}, {0.2, -1, 0.3}};
  const double expected = cone_of(rays).solid_angle();
  for (const double length : {1e-60, 1e-35, 1e35, 1e60}) {
    std::vector<Vec3> scaled, mixed;
    for (std::size_t k = 0; k < rays.size(); ++k) {
      scaled.push_back(length * rays[k]);
      mixed.push_back((k % 2 == 0 ? length : 1.0 / length) * rays[k]);
    }
    EXPECT_NEAR(cone_of(scaled).solid_angle(), expected, 1e-14) << length;
    EXPECT_NEAR(cone_of(mixed).solid_angle(), expected, 1e-14) << length;
  }
}

TEST(DirectionCone, OfFlatOnesIsNothing) {
  const std::vector<Vec3> half_plane = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  for (std::size_t count = 0; count < 3; ++count) {
    const DirectionCone cone = cone_of({half_plane.begin(), half_plane.begin() + static_cast<std::ptrdiff_t>(count)});
    EXPECT_TRUE(cone.empty());
    EXPECT_EQ(cone.solid_angle(), 0.0);
  }
  EXPECT_EQ(cone_of(half_plane).solid_angle(), 0.0);
  EXPECT_EQ(triangle_solid_angle({1, 0, 0}, {0, 1, 0}, {1, 1, 0}), 0.0);
  EXPECT_NEAR(triangle_solid_angle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 0.5 * pi, 1e-15);
  EXPECT_NEAR(triangle_solid_angle({0, 1, 0}, {1, 0, 0}, {0, 0, 1}), -0.5 * pi, 1e-15);
}

// Of more rays than there is room for the first count.
TEST(DirectionCone, LeavesOutRaysBeyondItsCapacity) {
  const std::vector<Vec3> rays = ring(200, 1.0), first(rays.begin(), rays.begin() + DirectionCone::capacity);
  const DirectionCone cone = cone_of(rays);
  ASSERT_EQ(cone.size(), DirectionCone::capacity);
  EXPECT_EQ(cone[5].x, rays[5].x);
  EXPECT_EQ(cone.solid_angle(), cone_of(first).solid_angle());
}

}  // namespace
