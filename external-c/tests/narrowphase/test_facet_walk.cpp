// The walk over the facets of a difference, against the expanding polytope.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "narrowphase/gjk.hpp"
#include "narrowphase/polytope/expanding_polytope.hpp"
#include "narrowphase/polytope/facet_walk.hpp"
#include "shape/convex_hull.hpp"
#include "support/random_bodies.hpp"

namespace test_facet_walk {
namespace {

using namespace cmb::convex;
using random_bodies::Random;

Polytope hull(Random &random, int count, const Vec3 &axes) {
  Polytope result;
  std::string problem;
  EXPECT_TRUE(build_convex_hull(random_bodies::random_points(random, count, axes, false), result, nullptr, &problem)) << problem;
  return result;
}

// Round ones, needles and plates, coarse and fine; a box beside them.
TEST(FacetWalk, AgreesWithTheExpandingPolytope) {
  Random random(3);
  FacetWalk walk;
  ExpandingPolytope expanding;
  const Vec3 axes[] = {{0.5, 0.5, 0.5}, {0.05, 0.05, 1.5}, {1.0, 1.0, 0.05}};
  int overlaps = 0, left_to_others = 0;
  for (int sample = 0; sample < 300; ++sample) {
    const int corners[] = {5, 20, 150};
    const Polytope of_a = hull(random, corners[sample % 3], axes[sample / 3 % 3]);
    const Polytope of_b = hull(random, corners[sample / 5 % 3], axes[sample / 7 % 3]);
    const ConvexBody a = make_polytope(of_a), b = sample % 4 == 0 ? make_box({0.7, 0.9, 1.2}) : make_polytope(of_b);
    const Pose pose{random_bodies::random_rotation(random), random.uniform(0.05, 0.6) * random.direction()};
    const MinkowskiDifference difference(a, b, pose);
    const double size = core_radius(a) + core_radius(b);
    const Vec3 from_b = core_center(a) - pose(core_center(b));
    FacetWalk::Result found;
    const FacetWalk::Outcome outcome = walk.minimum_translation(difference, -from_b, difference.support(-from_b), found);
    const GjkResult gjk = gjk_distance(difference, from_b, 1e-14 * difference.scale);
    if (gjk.status == GjkResult::Status::apart) {
      EXPECT_NE(outcome, FacetWalk::Outcome::found) << sample;
      continue;
    }
    ++overlaps;
    const PenetrationResult expected =
        expanding.depth(difference, gjk.simplex, gjk.count, 1e-14 * difference.scale, 1024);
    ASSERT_TRUE(expected.proven) << sample;
    if (outcome != FacetWalk::Outcome::found) {
      ++left_to_others;
      continue;
    }
    EXPECT_NEAR(found.depth, expected.depth, 1e-13 * size) << sample;
    EXPECT_NEAR(dot(difference.support(found.direction).w, found.direction), found.depth, 1e-14 * size) << sample;
    EXPECT_LT(norm(found.a - found.b - found.depth * found.direction), 1e-12 * size) << sample;
  }
  EXPECT_GT(overlaps, 150);
  EXPECT_LT(10 * left_to_others, overlaps);
}

// Where the bodies are apart along the first direction, that says so.
TEST(FacetWalk, KnowsBodiesThatAreApart) {
  Random random(4);
  FacetWalk walk;
  for (int sample = 0; sample < 50; ++sample) {
    const Polytope of_a = hull(random, 30, {0.5, 0.5, 0.5}), of_b = hull(random, 30, {0.5, 0.5, 0.5});
    const ConvexBody a = make_polytope(of_a), b = make_polytope(of_b);
    const Pose pose{random_bodies::random_rotation(random), 1.2 * random.direction()};
    const MinkowskiDifference difference(a, b, pose);
    FacetWalk::Result found;
    ASSERT_EQ(walk.minimum_translation(difference, pose.translation, difference.support(pose.translation), found), FacetWalk::Outcome::apart);
    EXPECT_LE(dot(difference.support(found.direction).w, found.direction), 0.0);
  }
}

// Parallel faces and edges are left to other methods, or answered rightly.
TEST(FacetWalk, AlignedCubes) {
  FacetWalk walk;
  const ConvexBody cube = make_box({1, 1, 1});
  for (const double depth : {0.01, 0.2}) {
    const Pose pose{Mat3{}, {0.1, 0.05, 1.0 - depth}};
    const MinkowskiDifference difference(cube, cube, pose);
    FacetWalk::Result found;
    if (walk.minimum_translation(difference, pose.translation, difference.support(pose.translation), found) != FacetWalk::Outcome::found) continue;
    EXPECT_NEAR(found.depth, depth, 1e-14);
    EXPECT_NEAR(found.direction.z, 1.0, 1e-14);
  }
}

// Whatever the first direction: what is said holds.
TEST(FacetWalk, AnyFirstDirectionWillDo) {
  Random random(5);
  FacetWalk walk;
  int found_ones = 0, apart_ones = 0;
  for (int sample = 0; sample < 400; ++sample) {
    const Vec3 axes = sample % 2 == 0 ? Vec3{0.5, 0.5, 0.5} : Vec3{0.1, 0.6, 1.0};
    const Polytope of_a = hull(random, 4 + sample % 9, axes), of_b = hull(random, 4 + sample % 7, axes);
    const ConvexBody a = make_polytope(of_a), b = make_polytope(of_b);
    const Pose pose{random_bodies::random_rotation(random), random.uniform(0.0, 1.2) * random.direction()};
    const MinkowskiDifference difference(a, b, pose);
    const Vec3 from_b = core_center(a) - pose(core_center(b));
    const bool apart = gjk_distance(difference, from_b, 1e-14 * difference.scale).status == GjkResult::Status::apart;
    double depth = 0.0;
    for (int k = 0; k < 6; ++k) {
      FacetWalk::Result found;
      const Vec3 first = random.uniform(0.1, 9.0) * random.direction();
      const FacetWalk::Outcome outcome = walk.minimum_translation(difference, first, difference.support(first), found);
      if (outcome == FacetWalk::Outcome::undecided) continue;
      ASSERT_EQ(outcome == FacetWalk::Outcome::apart, apart) << sample;
      if (apart) {
        ++apart_ones;
        EXPECT_LE(dot(difference.support(found.direction).w, found.direction), 1e-14) << sample;
        continue;
      }
      ++found_ones;
      if (depth > 0.0) {
        EXPECT_NEAR(found.depth, depth, 1e-13) << sample;
      }
      depth = found.depth;
      EXPECT_NEAR(dot(difference.support(found.direction).w, found.direction), depth, 1e-14) << sample;
      EXPECT_LT(norm(found.a - found.b - depth * found.direction), 1e-12) << sample;
    }
  }
  EXPECT_GT(found_ones, 500);
  EXPECT_GT(apart_ones, 300);
}

// Discs of very many corners: more than there is room for is left to others, and what is answered is right.
TEST(FacetWalk, FacesOfVeryManyCorners) {
  Random random(6);
  FacetWalk walk;
  ExpandingPolytope expanding;
  constexpr int corners = 1500;
  std::vector<Vec3> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * 3.14159265358979323846 * k / corners;
    for (const double z : {-0.2, 0.2}) points.push_back({std::cos(angle), std::sin(angle), z});
  }
  Polytope disc;
  std::string problem;
  ASSERT_TRUE(build_convex_hull(points, disc, nullptr, &problem)) << problem;
  const ConvexBody a = make_polytope(disc), b = make_box({0.5, 0.6, 0.7});
  int undecided = 0, found_ones = 0;
  for (int sample = 0; sample < 40; ++sample) {
    const Pose pose{random_bodies::random_rotation(random), {random.uniform(-0.8, 0.8), 0.1, random.uniform(0.2, 0.6)}};
    const ConvexBody &second = sample % 2 == 0 ? b : a;
    const MinkowskiDifference difference(a, second, pose);
    const double size = core_radius(a) + core_radius(second);
    FacetWalk::Result found;
    const FacetWalk::Outcome outcome = walk.minimum_translation(difference, pose.translation, difference.support(pose.translation), found);
    undecided += outcome == FacetWalk::Outcome::undecided;
    if (outcome != FacetWalk::Outcome::found) continue;
    ++found_ones;
    const GjkResult gjk = gjk_distance(difference, -pose.translation, 1e-14 * difference.scale);
    ASSERT_NE(gjk.status, GjkResult::Status::apart) << sample;
    const PenetrationResult expected =
        expanding.depth(difference, gjk.simplex, gjk.count, 1e-14 * difference.scale, 1024);
    EXPECT_NEAR(found.depth, expected.depth, (expected.proven ? 1e-12 : 1e-4) * size) << sample;
  }
  EXPECT_GT(found_ones, 0);
  EXPECT_GT(undecided, 0);
}

}  // namespace
}  // namespace test_facet_walk
