// The last resort, every feature against every other, where one body is a point or a segment: against closed forms and
// separating axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "narrowphase/polytope/feature_enumeration.hpp"
#include "support/random_bodies.hpp"

namespace test_feature_enumeration {
namespace {

using namespace cmb::convex;

const Vec3 half{0.5, 0.3, 0.2};

double inside_depth(const Vec3 &p) {  // > 0 inside of the box
  return std::min({half.x - std::fabs(p.x), half.y - std::fabs(p.y), half.z - std::fabs(p.z)});
}

double distance_to_box(const Vec3 &p) {
  const double depth = inside_depth(p);
  if (depth >= 0.0) return -depth;
  return norm({std::fmax(std::fabs(p.x) - half.x, 0.0), std::fmax(std::fabs(p.y) - half.y, 0.0),
               std::fmax(std::fabs(p.z) - half.z, 0.0)});
}

// Of the segment from p to q: where they are apart, the least over the segment of a convex function, by thirds; where they
// overlap, the largest gap over the directions of faces and of edges crossed with the segment.
double distance_of_segment(const Vec3 &p, const Vec3 &q) {
  double low = 0.0, high = 1.0;
  const auto at = [&](double t) { return p + t * (q - p); };
  const auto outside = [&](double t) { return std::fmax(distance_to_box(at(t)), 0.0); };
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (outside(a) <= outside(b) ? high : low) = outside(a) <= outside(b) ? b : a;
  }
  const double apart = outside(0.5 * (low + high));
  if (apart > 1e-12) return apart;  // less is rounding: no pose here touches
  double gap = -INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along;
    along.set(axis, 1.0);
    for (const Vec3 &n : {along, cross(along, q - p)}) {
      if (norm(n) < 1e-6) continue;
      const Vec3 u = normalized(n);
      const double box = half.x * std::fabs(u.x) + half.y * std::fabs(u.y) + half.z * std::fabs(u.z);
      gap = std::max({gap, std::min(dot(p, u), dot(q, u)) - box, -std::max(dot(p, u), dot(q, u)) - box});
    }
  }
  return gap;
}

// Both orders of the bodies; `body` lies at `pose` in the box's frame.
void check(const ConvexBody &body, const Pose &pose, double expected) {
  const ConvexBody box = make_box(2.0 * half);
  const Pose back = pose.inverse();
  for (const bool box_first : {true, false}) {
    const MinkowskiDifference difference = box_first ? MinkowskiDifference(box, body, pose) : MinkowskiDifference(body, box, back);
    const EnumerationResult result = enumerate_features(difference);
    ASSERT_NEAR(result.distance, expected, 1e-12) << box_first;
    ASSERT_NEAR(norm(result.direction), 1.0, 1e-12);
    const Vec3 apart = result.b - result.a;
    ASSERT_NEAR(dot(apart, result.direction), expected, 1e-12) << box_first;
    if (expected > 0.0) {
      ASSERT_NEAR(norm(apart), expected, 1e-12) << box_first;
    }
    // The direction proves the distance: no point of A lies farther along it than expected before those of B.
    ASSERT_NEAR(dot(difference.support(result.direction).w, result.direction), -expected, 1e-12) << box_first;
  }
}

TEST(FeatureEnumeration, PointAndBox) {
  random_bodies::Random random(11);
  int inside = 0;
  for (int k = 0; k < 400; ++k) {
    const Vec3 p{random.uniform(-0.8, 0.8), random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5)};
    inside += distance_to_box(p) < 0.0;
    ASSERT_NO_FATAL_FAILURE(check(make_sphere(0.0), {random_bodies::random_rotation(random), p}, distance_to_box(p))) << k;
  }
  EXPECT_GT(inside, 30);
  EXPECT_LT(inside, 300);
}

TEST(FeatureEnumeration, PointsOverFacesEdgesAndCornersOfABox) {
  for (const Vec3 &p : {Vec3{0.7, 0.1, 0.0}, Vec3{0.7, 0.5, 0.0}, Vec3{0.7, 0.5, 0.4}, Vec3{0, 0, 0}, Vec3{0.5, 0.0, 0.0},
                        Vec3{0.5, 0.3, 0.2}, Vec3{0.5, 0.3, 0.2 + 1e-9}}) {
    ASSERT_NO_FATAL_FAILURE(check(make_sphere(0.0), {{}, p}, distance_to_box(p))) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

TEST(FeatureEnumeration, SegmentAndBox) {
  random_bodies::Random random(12);
  int overlapping = 0;
  for (int k = 0; k < 400; ++k) {
    // Every fourth one along an axis of the box: directions across both vanish there.
    Mat3 turn = random_bodies::random_rotation(random);
    if (k % 4 == 0) turn = {};
    const Pose pose{turn, random.uniform(0.0, 0.9) * random.direction()};
    const double length = random.uniform(0.1, 1.5);
    const Vec3 reach = pose.rotation * Vec3{0, 0, 0.5 * length};
    const double expected = distance_of_segment(pose.translation - reach, pose.translation + reach);
    overlapping += expected < 0.0;
    ASSERT_NO_FATAL_FAILURE(check(make_capsule(0.0, length), pose, expected)) << k;
  }
  EXPECT_GT(overlapping, 50);
  EXPECT_LT(overlapping, 350);
}

}  // namespace
}  // namespace test_feature_enumeration
