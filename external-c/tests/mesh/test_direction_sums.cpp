// Few points in place of many loads: the same force and, but for what turns about it, the same moment, however small.
#include <cmath>

#include <gtest/gtest.h>

#include "mesh/contact/direction_sums.hpp"
#include "support/random_bodies.hpp"

namespace test_direction_sums {
namespace {

using cmb::ContactPoint;
using cmb::mesh::DirectionSums;
using cmb::convex::Vec3;
using random_bodies::Random;

TEST(DirectionSums, KeepForceAndMomentHoweverSmall) {
  Random random(1);
  for (const double size : {1.0, 1e-60, 1e-120, 1e-150}) {
    for (int sample = 0; sample < 50; ++sample) {
      DirectionSums sums;
      const Vec3 center = random.direction();
      Vec3 force;
      for (int k = 0; k < 3; ++k) {
        const Vec3 normal = random.direction(), place = random.direction();
        const double depth = random.uniform(1e-30, 2e-30), load = size * random.uniform(1.0, 2.0);
        sums.add(load, load * depth, load * (place - center), normal);
        force = force + load * normal;
      }
      Vec3 found;
      for (std::size_t direction = 0; direction < DirectionSums::directions; ++direction) {
        ContactPoint point;
        if (!sums.point(direction, center, 3.0, point)) continue;
        ASSERT_NEAR(norm(point.normal), 1.0, 1e-14) << size;
        ASSERT_LT(norm(point.position - center), 10.0) << size;
        found = found + (point.weight * point.depth) * point.normal;
      }
      EXPECT_LT(norm((1.0 / size) * (found - 3.0 * force)), 1e-14) << size;
    }
  }
}

// One load: the point lies on its line, half the depth in front of where the surface is pushed.
TEST(DirectionSums, OneLoadIsOnItsLine) {
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    DirectionSums sums;
    const Vec3 center = random.direction(), normal = random.direction(), place = random.direction();
    const double load = 1e-155, depth = 1e-3;
    sums.add(load, load * depth, load * (place - center), normal);
    for (std::size_t direction = 0; direction < DirectionSums::directions; ++direction) {
      ContactPoint point;
      if (!sums.point(direction, center, 1.0, point)) continue;
      EXPECT_LT(norm(point.normal - normal), 1e-14);
      EXPECT_NEAR(point.depth, depth, 1e-17);
      EXPECT_LT(norm(cross(point.position - place, normal)), 1e-13);
    }
  }
}

}  // namespace
}  // namespace test_direction_sums
