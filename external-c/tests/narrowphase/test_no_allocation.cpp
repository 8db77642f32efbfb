// Queries do not allocate once the scratch objects are warm.
#include <gtest/gtest.h>

#include "support/counted_allocations.hpp"
#include "support/random_bodies.hpp"
#include "volume/convex_overlap.hpp"

namespace {

using namespace cmb::convex;
using namespace random_bodies;

TEST(Allocation, NoneInDistanceAndOverlapQueries) {
  Random random(1);
  Polytope hull, other;
  ASSERT_TRUE(build_convex_hull(random_points(random, 200, {1, 1, 1}, false), hull, nullptr, nullptr));
  ASSERT_TRUE(build_convex_hull(random_points(random, 50, {1, 0.2, 1}, true), other, nullptr, nullptr));
  const ConvexBody bodies[] = {make_sphere(1),      make_capsule(0.1, 1), make_box({1, 1, 1}), make_polytope(hull),
                               make_polytope(other), make_ellipsoid({1, 2, 3}), make_cylinder(1, 1), make_cone(1, 1)};
  DistanceScratch scratch;
  OverlapScratch overlap_scratch;
  const auto ask = [&](std::uint64_t seed) {
    Random poses(seed);
    double sum = 0;
    for (int k = 0; k < 50; ++k) {
      const Pose pose{random_rotation(poses), poses.uniform(0, 2) * poses.direction()};
      for (const ConvexBody &a : bodies) {
        for (const ConvexBody &b : bodies) sum += signed_distance(a, b, pose, scratch).distance;
      }
      sum += convex_overlap(hull, other, pose, {0, 0, 1}, overlap_scratch).volume;
    }
    return sum;
  };
  const double first = ask(1);
  const unsigned long before = cmb::test::allocations;
  const double again = ask(1), fresh = ask(2);
  EXPECT_EQ(cmb::test::allocations - before, 0u);
  EXPECT_EQ(again, first);
  EXPECT_NE(fresh, first);
}

}  // namespace
