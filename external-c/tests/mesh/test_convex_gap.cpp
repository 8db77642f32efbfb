// Distance of a triangle and a round body.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../convex/random_bodies.hpp"
#include "mesh/convex_gap.hpp"

namespace {

using namespace cmb::mesh;
using namespace cmb::convex;

const ConvexBody bodies[] = {make_ellipsoid({0.5, 0.3, 0.2}), make_cylinder(0.3, 0.8), make_cone(0.4, 0.7)};

// How far p is from the triangle.
double off_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  return norm(p - nearest_on_triangle(p, a, b, c).point);
}

// How far p reaches beyond the body along the directions of a grid: 0 for points of the body.
double off_body(const Vec3 &p, const ConvexBody &body, const Pose &pose) {
  random_bodies::Random random(5);
  const Vec3 local = transposed_times(pose.rotation, p - pose.translation);
  double most = 0.0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 d = random.direction();
    most = std::fmax(most, dot(d, local) - dot(d, core_support(body, d).point));
  }
  return most;
}

TEST(ConvexGap, PointsLieOnBothAndAreAsFarApartAsItSays) {
  random_bodies::Random random(2);
  int touching = 0, apart = 0;
  for (int k = 0; k < 6000; ++k) {
    const ConvexBody &body = bodies[k % 3];
    Pose pose{random_bodies::random_rotation(random), random.uniform(0.0, 1.2) * random.direction()};
    if (k % 5 == 0) pose.rotation = Mat3{};
    const double scale = random.log_uniform(0.01, 3.0);
    const Vec3 a = scale * random.direction(), b = scale * random.direction(), c = scale * random.direction();
    const double infinity = std::numeric_limits<double>::infinity();
    const TriangleGap gap = triangle_convex_gap(a, b, c, body, pose, infinity);
    ASSERT_LT(off_triangle(gap.on_triangle, a, b, c), 1e-9) << k;
    if (k < 600) {
      ASSERT_LT(off_body(gap.on_body, body, pose), 1e-9) << k;
    }
    if (gap.distance > 0.0) {
      ++apart;
      ASSERT_NEAR(norm(gap.on_triangle - gap.on_body), gap.distance, 1e-9) << k;
      // The plane across the gap parts the two.
      const Vec3 d = (1.0 / gap.distance) * (gap.on_triangle - gap.on_body);
      const Vec3 local = transposed_times(pose.rotation, d);
      const double reach = dot(d, pose.translation) + dot(local, core_support(body, local).point);
      ASSERT_NEAR(std::fmin(dot(d, a), std::fmin(dot(d, b), dot(d, c))) - reach, gap.distance, 1e-6) << k;
      // Moved together until they touch: the points stay where the bodies meet.
      pose.translation = pose.translation + gap.distance * d;
      const TriangleGap meeting = triangle_convex_gap(a, b, c, body, pose, infinity);
      ASSERT_LT(meeting.distance, 1e-6) << k;
      ASSERT_LT(off_triangle(meeting.on_triangle, a, b, c), 1e-9) << k;
      if (k < 600) {
        ASSERT_LT(off_body(meeting.on_triangle, body, pose), 1e-6) << k;
      }
    } else {
      ++touching;
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(apart, 1000);
}

}  // namespace
