// Balls that prove a depth lie in the difference: no supporting plane of it cuts one.
#include <gtest/gtest.h>

#include "narrowphase/interior_ball.hpp"
#include "narrowphase/minkowski_difference.hpp"
#include "shape/convex_hull.hpp"
#include "support/random_bodies.hpp"

namespace test_interior_ball {
namespace {

using namespace cmb::convex;
using namespace random_bodies;

struct Bodies {
  Polytope hull;
  std::vector<ConvexBody> all;

  explicit Bodies(Random &random) {
    build_convex_hull(random_points(random, 14, {0.5, 0.4, 0.3}, false), hull, nullptr, nullptr);
    const auto length = [&random] { return random.uniform(0.3, 1.0); };
    all = {make_box({length(), length(), length()}), make_polytope(hull),
           make_ellipsoid({0.5 * length(), 0.5 * length(), 0.5 * length()}), make_cylinder(0.5 * length(), length()),
           make_cone(0.5 * length(), length()), make_capsule(0.1, length())};
  }
};

// Some of B's axes along some of A's: flat ends, edges and sides on each other.
Mat3 special_rotation(Random &random) {
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Mat3 quarter = rotation_about(axes[random.integer(0, 2)], 0.5 * 3.14159265358979323846 * random.integer(0, 3));
  const Mat3 turn = rotation_about(axes[random.integer(0, 2)], random.uniform(-3, 3));
  Mat3 product;
  for (int i = 0; i < 3; ++i) product.row[i] = transposed_times(turn, quarter.row[i]);
  return product;
}

// How far the difference reaches beyond the ball, in the direction m.
double excess(const MinkowskiDifference &difference, const Vec3 &surface, const Vec3 &outward, double ball, const Vec3 &m) {
  return dot(difference.support(m).w - surface, m) - ball * (1.0 - dot(outward, m));
}

TEST(InnerBall, LiesInTheDifference) {
  Random random(7);
  DistanceScratch scratch;
  int found = 0, edges = 0;
  for (int round = 0; round < 60; ++round) {
    const Bodies of_a(random), of_b(random);
    for (const ConvexBody &a : of_a.all) {
      for (const ConvexBody &b : of_b.all) {
        Pose pose{round % 3 == 0 ? special_rotation(random) : random_rotation(random), random.direction()};
        for (int step = 0; step < 2; ++step) {  // to a depth of 1 to 100 mm
          const SignedDistance d = signed_distance(a, b, pose, scratch);
          const double depth = std::pow(10.0, random.uniform(-3, -1));
          pose.translation = pose.translation + (d.distance + depth) * d.normal;
        }
        const SignedDistance d = signed_distance(a, b, pose, scratch);
        if (!(d.distance < 0.0)) continue;
        const Vec3 outward = -d.normal, on_a = d.point_a - a.radius * outward, on_b = d.point_b + b.radius * outward;
        const double ball = interior_ball_radius(a, b, pose, outward, on_a, on_b, INFINITY, 1e-12);
        if (!(ball > 0.0)) continue;
        ++found;
        const MinkowskiDifference difference(a, b, pose);
        const Vec3 surface = on_a - on_b;
        if (interior_ball_radius(a, b, pose, outward, on_a, on_b, 0.0, 1e-12) < ball) ++edges;
        for (int k = 0; k < 300; ++k) {
          // All around, and near to the normal, where it is closest.
          const Vec3 aside = random.direction();
          const Vec3 m = k % 2 == 0 ? aside : normalized(outward + std::pow(10.0, random.uniform(-4, 0.5)) * aside);
          ASSERT_GT(excess(difference, surface, outward, ball, m), -1e-10)
              << static_cast<int>(a.core) << " " << static_cast<int>(b.core) << " depth " << -d.distance << " ball " << ball;
        }
      }
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(edges, 100);  // where neither body holds the ball alone
}

// A direction along which a body's face, end or side is farthest, in its frame.
Vec3 facing(Random &random, const ConvexBody &body) {
  const double turn = random.uniform(-3, 3), end = random.integer(0, 1) == 0 ? -1.0 : 1.0;
  const Vec3 aside{std::cos(turn), std::sin(turn), 0}, along{0, 0, end};
  switch (body.core) {
    case CoreShape::box: return random.integer(0, 1) == 0 ? along : Vec3{end, 0, 0};
    case CoreShape::cylinder: return random.integer(0, 1) == 0 ? along : aside;
    case CoreShape::segment: return aside;
    case CoreShape::cone: {
      const double slant = cone_slant(body.half);
      const Vec3 side = 2.0 * body.half.z / slant * aside + Vec3{0, 0, body.half.x / slant};
      return random.integer(0, 1) == 0 ? Vec3{0, 0, -1} : side;
    }
    default: return aside;
  }
}

// Some farthest point of a core: of those along nearly the same direction any mean is one.
Vec3 some_farthest(Random &random, const ConvexBody &body, const Vec3 &d) {
  Vec3 mean;
  double rest = 1.0;
  for (int k = 0; k < 4; ++k) {
    const double weight = k == 3 ? rest : rest * random.uniform(0, 1);
    mean = mean + weight * core_support(body, d + 1e-14 * random.direction()).point;
    rest -= weight;
  }
  return mean;
}

// Plates and needles to 1:1000, where farthest points along a direction touch a common plane: balls in the difference do not
// depend on how deep the bodies are in each other.
TEST(InnerBall, LiesInTheDifferenceOfSlenderBodies) {
  Random random(8);
  int found = 0;
  for (int sample = 0; sample < 6000; ++sample) {
    const auto length = [&random] { return random.log_uniform(1e-3, 1.0); };
    const auto body = [&](int kind) {
      return kind == 0   ? make_box({length(), length(), length()})
             : kind == 1 ? make_ellipsoid({length(), length(), length()})
             : kind == 2 ? make_cylinder(length(), length())
             : kind == 3 ? make_cone(length(), length())
                         : make_capsule(length(), length());
    };
    const ConvexBody a = body(sample % 5), b = body(sample / 5 % 5);
    const Pose pose{sample % 3 == 0 ? special_rotation(random) : random_rotation(random), {}};
    const MinkowskiDifference difference(a, b, pose);
    // Of slender bodies most of the surface looks along few directions: others are asked as well.
    const auto direction = [&] {
      const Vec3 d = random.direction();
      return normalized(Vec3{d.x * length(), d.y * length(), d.z * length()});
    };
    const Vec3 outward = sample % 2 == 0 ? direction() : facing(random, a);
    const Vec3 on_a = some_farthest(random, a, outward);
    const Vec3 on_b = pose(some_farthest(random, b, -transposed_times(pose.rotation, outward)));
    const double ball = interior_ball_radius(a, b, pose, outward, on_a, on_b, INFINITY, 1e-12);
    if (!(ball > 0.0)) continue;
    ++found;
    for (int k = 0; k < 1000; ++k) {
      const Vec3 m = k % 2 == 0 ? direction() : normalized(outward + length() * direction());
      ASSERT_GT(excess(difference, on_a - on_b, outward, ball, m), -1e-12)
          << sample << ": " << static_cast<int>(a.core) << " " << static_cast<int>(b.core) << " ball " << ball;
    }
  }
  EXPECT_GT(found, 3000);
}

TEST(InnerBall, OnABoxesFaceReachesToItsBorder) {
  const ConvexBody box = make_box({2, 2, 2}), ball = make_ellipsoid({0.5, 0.5, 0.5});
  const Pose pose{Mat3{}, {0.7, 0, 1.4}};
  const Vec3 top{0.7, 0, 1}, low{0.7, 0, 0.9};
  // 0.3 to the face's border, and the ellipsoid's own.
  EXPECT_NEAR(interior_ball_radius(box, ball, pose, {0, 0, 1}, top, low, 0.0, 1e-12), 0.8, 1e-12);
}

TEST(InnerBall, IsNotAtACorner) {
  const ConvexBody box = make_box({2, 2, 2});
  const Pose pose{Mat3{}, {1.9, 1.9, 1.9}};
  const Vec3 m = normalized({1, 1, 1});
  EXPECT_NEAR(interior_ball_radius(box, box, pose, m, {1, 1, 1}, {0.9, 0.9, 0.9}, INFINITY, 1e-12), 0.0, 1e-12);
}

TEST(InnerBall, IsNotWherePointsAreOutside) {
  const ConvexBody box = make_box({2, 2, 2}), ball = make_ellipsoid({0.5, 0.5, 0.5});
  const Pose pose{Mat3{}, {0.7, 0, 1.4}};
  EXPECT_EQ(interior_ball_radius(box, ball, pose, {0, 0, 1}, {1.7, 0, 1}, {0.7, 0, 0.9}, INFINITY, 1e-12), 0.0);
}

}  // namespace
}  // namespace test_interior_ball
