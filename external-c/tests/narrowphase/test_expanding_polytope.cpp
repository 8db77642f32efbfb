// The expanding polytope: a search that goes on from a rough one.
#include "narrowphase/polytope/expanding_polytope.hpp"

#include <gtest/gtest.h>

#include "narrowphase/gjk.hpp"
#include "support/random_bodies.hpp"

namespace test_expanding_polytope {
namespace {

using namespace cmb::convex;
using random_bodies::Random;

TEST(ExpandingPolytope, GoesOnFromARoughSearch) {
  Random random(11);
  ExpandingPolytope polytope;
  const ConvexBody bodies[] = {make_box({0.6, 0.8, 1.0}), make_cylinder(0.4, 0.7), make_cone(0.4, 0.8), make_ellipsoid({0.3, 0.4, 0.5})};
  int went_on = 0;
  for (int sample = 0; sample < 200; ++sample) {
    const ConvexBody &a = bodies[sample % 4], &b = bodies[1 + sample / 4 % 3];
    const Pose pose{random_bodies::random_rotation(random), random.uniform(0.05, 0.4) * random.direction()};
    const MinkowskiDifference difference(a, b, pose);
    const GjkResult gjk = gjk_distance(difference, pose.translation, 1e-11 * difference.scale, 0.1);
    if (gjk.status == GjkResult::Status::apart) continue;
    const double tolerance = 1e-6 * difference.scale;
    const PenetrationResult expected = polytope.depth(difference, gjk.simplex, gjk.count, tolerance, 300);
    const PenetrationResult rough = polytope.depth(difference, gjk.simplex, gjk.count, 1e-2 * difference.scale, 40);
    if (!expected.proven || rough.steps == 0) continue;
    const PenetrationResult found = polytope.go_on(difference, rough, tolerance, 300);
    ++went_on;
    EXPECT_TRUE(found.proven) << sample;
    EXPECT_GE(found.steps, rough.steps) << sample;
    EXPECT_LE(found.depth, rough.depth) << sample;
    EXPECT_NEAR(found.depth, expected.depth, tolerance) << sample;
    EXPECT_NEAR(dot(difference.support(found.direction).w, found.direction), found.depth, 1e-12) << sample;
  }
  EXPECT_GT(went_on, 100);
}

}  // namespace
}  // namespace test_expanding_polytope
