// Distances of cores in closed form: segments beside a search, boxes by the bounds from both sides, how far points are
// outside bodies by steps off their surface.
#include <gtest/gtest.h>

#include <algorithm>

#include "narrowphase/analytic/box_distance.hpp"
#include "narrowphase/analytic/box_separating_axes.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_segments.hpp"

namespace test_closed_form_distance {
namespace {

using namespace cmb::convex;
using cmb::test::least_distance;
using random_bodies::Random;

TEST(Segments, NoPointsAreNearer) {
  Random random(3);
  for (int k = 0; k < 20000; ++k) {
    const Vec3 half_a = random.log_uniform(1e-2, 10.0) * random.direction();
    Vec3 half_b = random.log_uniform(1e-2, 10.0) * random.direction();
    if (k % 4 == 1) half_b = random.uniform(-2.0, 2.0) * half_a;                            // parallel
    if (k % 4 == 2) half_b = half_a + random.log_uniform(1e-9, 1e-2) * random.direction();  // nearly so
    const Vec3 t = random.log_uniform(1e-1, 10.0) * random.direction();
    const CoreDistance found = distance_of_segments(normalized(half_a), norm(half_a), normalized(half_b), norm(half_b), t);
    const double s = dot(found.a, half_a) / norm2(half_a), r = dot(found.b - t, half_b) / norm2(half_b);
    const double size = norm(half_a) + norm(half_b) + norm(t);
    EXPECT_LE(norm(found.a - s * half_a), 1e-14 * size);
    EXPECT_LE(norm(found.b - t - r * half_b), 1e-14 * size);
    EXPECT_LE(std::fabs(s), 1.0 + 1e-14 * size / norm(half_a));
    EXPECT_LE(std::fabs(r), 1.0 + 1e-14 * size / norm(half_b));
    EXPECT_NEAR(norm(found.direction), 1.0, 1e-14);
    EXPECT_LE(norm(found.b - found.a - found.distance * found.direction), 1e-14 * size);
    // Those that count as parallel are off by their angle times their common stretch at most.
    const double sine = norm(cross(half_a, half_b)) / (norm(half_a) * norm(half_b));
    const double cut_off = k % 4 == 2 && sine < 2e-12 ? sine * 2.0 * std::fmin(norm(half_a), norm(half_b)) : 0.0;
    const double least = least_distance(half_a, half_b, t);
    EXPECT_LE(found.distance, least + cut_off + 1e-13 * size);
    if (testing::Test::HasFailure()) FAIL() << "sample " << k;
  }
}

// Angles of 1e-12 to 1e-4, gaps of 1e-10 to 1, in the plane of the tilt, across it and anyhow; lines that meet within both.
TEST(Segments, NearlyParallelAreAsNearAsInLongDouble) {
  Random random(19);
  double worst = 0.0;
  for (int k = 0; k < 4000; ++k) {
    const Vec3 along = random.direction(), aside = normalized(cross(along, random.direction()));
    const Vec3 third = cross(along, aside);
    const double half_a = random.log_uniform(1e-1, 2.0), half_b = random.log_uniform(1e-1, 2.0);
    const double angle = random.log_uniform(1e-12, 1e-4), gap = random.log_uniform(1e-10, 1.0);
    const Vec3 other = normalized(along + angle * aside);
    const Vec3 away[] = {gap * aside, gap * third, gap * random.direction(), {}};
    // From where the lines are nearest, or from anywhere on both.
    const Vec3 t = random.uniform(-half_a, half_a) * along + away[k % 4] - random.uniform(-half_b, half_b) * other;
    const double found = distance_of_segments(along, half_a, other, half_b, t).distance;
    const double error = std::fabs(found - least_distance(half_a * along, half_b * other, t));
    worst = std::fmax(worst, error);
    EXPECT_LE(error, 1e-14) << "sample " << k << ", angle " << angle << ", gap " << gap;
  }
  RecordProperty("worst", testing::PrintToString(worst));
}

TEST(Segments, APointIsASegmentWithoutLength) {
  const Vec3 z{0, 0, 1};
  const CoreDistance found = distance_of_segments(z, 2.0, z, 0.0, {3, 0, 1});
  EXPECT_EQ(found.distance, 3.0);
  EXPECT_EQ(norm(found.a - Vec3{0, 0, 1}), 0.0);
  EXPECT_EQ(norm(found.b - Vec3{3, 0, 1}), 0.0);
  EXPECT_EQ(distance_of_segments(z, 0.0, z, 2.0, {3, 0, 1}).distance, 3.0);
  EXPECT_EQ(distance_of_segments(z, 0.0, z, 0.0, {3, 0, 4}).distance, 5.0);
}

// Boxes in all attitudes, also with parallel and nearly parallel edges and faces, segments and points among them.
TEST(BoxesApart, PointsInBothAreAsFarFromEachOtherAsTheirExtents) {
  Random random(11);
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 60000; ++k) {
    Vec3 half[2];
    for (Vec3 &h : half) {
      for (int i = 0; i < 3; ++i) h.set(i, random.integer(0, 9) == 0 ? 0.0 : random.log_uniform(1e-2, 1.0));
    }
    Pose pose{random_bodies::random_rotation(random), {}};
    if (k % 3 == 1) pose.rotation = random_bodies::rotation_about(random.direction(), random.log_uniform(1e-15, 1e-2));
    if (k % 3 == 2) {
      Vec3 axis;
      axis.set(random.integer(0, 2), 1.0);
      pose.rotation = random_bodies::rotation_about(axis, 0.785398163397448309616 * random.integer(0, 8));
    }
    pose.translation = random.log_uniform(1e-1, 20.0) * random.direction();
    if (k % 2 == 1) {
      for (int i = 0; i < 3; ++i) pose.translation.set(i, 0.25 * random.integer(-8, 8));  // flush sides
    }
    const double scale = norm(half[0]) + norm(half[1]) + norm(pose.translation), tolerance = 1e-14 * scale;
    CoreDistance found;
    if (!distance_of_disjoint_boxes(half[0], half[1], pose, tolerance, found)) {
      // Then no direction parts them: of boxes with an inside, by their fifteen axes.
      const bool solid = std::min({half[0].x, half[0].y, half[0].z, half[1].x, half[1].y, half[1].z}) > 0.0;
      if (solid) {
        BoxAxes axes;
        find_box_axes({half[0], half[1], pose}, axes);
        EXPECT_LE(axes.separation, 1e-13 * scale) << "sample " << k;
      }
      ++overlapping;
      continue;
    }
    ++apart;
    EXPECT_GT(found.distance, 0.0);
    EXPECT_NEAR(norm(found.direction), 1.0, 1e-14);
    EXPECT_LE(norm(found.b - found.a - found.distance * found.direction), 2e-14 * scale);
    const Vec3 b_local = transposed_times(pose.rotation, found.b - pose.translation);
    const Vec3 in_b = transposed_times(pose.rotation, found.direction);
    double between = dot(found.direction, pose.translation);  // the boxes, by their extents along the direction
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(std::fabs(found.a[i]), half[0][i]);
      EXPECT_LE(std::fabs(b_local[i]), half[1][i] + 1e-15 * scale);
      between -= half[0][i] * std::fabs(found.direction[i]) + half[1][i] * std::fabs(in_b[i]);
    }
    EXPECT_NEAR(between, found.distance, 2e-14 * scale);
    if (testing::Test::HasFailure()) FAIL() << "sample " << k;
  }
  EXPECT_GT(apart, 30000);
  EXPECT_GT(overlapping, 1000);
}

TEST(Outside, IsNoLessThanTheStepOffTheSurface) {
  Random random(7);
  const ConvexBody bodies[] = {
      make_sphere(0.0),    make_capsule(0.0, 0.7),          make_box({0.6, 0.8, 1.0}), make_cylinder(0.4, 0.7),
      make_cone(0.4, 0.8), make_ellipsoid({0.3, 0.4, 0.5}), make_cone(0.05, 1.0),
      make_ellipsoid({1.0, 0.1, 0.02})};
  for (const ConvexBody &body : bodies) {
    for (int k = 0; k < 2000; ++k) {
      const Vec3 d = random.direction(), p = core_support(body, d).point;
      EXPECT_LE(outside(body, p), 1e-15);
      const double step = random.log_uniform(1e-9, 1.0);  // the nearest point of p + step d is p
      EXPECT_GE(outside(body, p + step * d), step * (1.0 - 1e-6));
      EXPECT_EQ(outside(body, core_center(body) + 0.9 * (p - core_center(body))), 0.0);
    }
  }
}

TEST(Outside, IsNotKnownOfPolytopes) {
  const Polytope box = Polytope::box({1, 1, 1});
  EXPECT_EQ(outside(make_polytope(box), {}), INFINITY);
}

}  // namespace
}  // namespace test_closed_form_distance
