// Capsules on boxes, hulls, cylinders and cones: the energy along the axis, and the gradient of it that the points carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "backend/distance_backend.hpp"
#include "manifold/axis/capsule_on_polytope.hpp"
#include "manifold/axis/capsule_on_revolved.hpp"
#include "math/pi.hpp"
#include "math/pose_algebra.hpp"
#include "support/contact_sums.hpp"
#include "support/poses.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_capsule_on_convex {
namespace {

using namespace cmb;
using random_bodies::Random;
using test::Sums;

Shape capsule(double radius, double length) {
  Shape shape;
  shape.kind = ShapeKind::capsule;
  shape.body = convex::make_capsule(radius, length);
  return shape;
}

Shape polytope(convex::Polytope geometry, ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  shape.polytope = std::make_shared<ContactPolytope>(std::move(geometry));
  shape.body = convex::make_polytope(shape.polytope->geometry());
  return shape;
}

Shape random_polytope(Random &random, int sample) {
  const auto length = [&random] { return random.uniform(0.5, 2); };
  if (sample % 2 == 0) return polytope(convex::Polytope::box({length(), length(), length()}), ShapeKind::box);
  convex::Polytope hull;
  EXPECT_TRUE(convex::build_convex_hull(random_bodies::random_points(random, 20, {1, 0.9, 0.8}, false), hull, nullptr, nullptr));
  return polytope(std::move(hull), ShapeKind::hull);
}

Shape revolved(convex::ConvexBody body, ShapeKind kind) {
  Shape shape;
  shape.kind = kind;
  shape.body = body;
  return shape;
}

Shape random_cylinder(Random &random, int) {
  return revolved(convex::make_cylinder(random.uniform(0.2, 1), random.uniform(0.3, 2)), ShapeKind::cylinder);
}

// Slender and blunt ones as well.
Shape random_cone(Random &random, int) {
  return revolved(convex::make_cone(random.log_uniform(0.05, 1), random.log_uniform(0.2, 2)), ShapeKind::cone);
}

// How deep it is, and what the points carry that stand for all of the contact.
struct Contact {
  double depth = 0.0, part = 0.0;
  std::vector<ContactPoint> points;
};

Contact contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  static BackendScratch backend;
  static CapsuleScratch scratch;
  SignedDistance answer;
  find_exact_distance(a, pose_a, b, pose_b, backend, answer);
  Contact result;
  result.depth = -answer.distance;
  if (!(result.depth > 0.0)) return result;
  result.part = b.polytope ? capsule_on_polytope(a, pose_a, b, pose_b, result.depth, answer.point_a, answer.normal, 1.0, scratch,
                                                 result.points)
                           : capsule_on_revolved(a, pose_a, b, pose_b, result.depth, answer.point_a, 1.0, result.points);
  return result;
}

// Half the integral of depth^3 by that of depth, by the distances of many places.
double integrated_energy(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  static convex::DistanceScratch scratch;
  constexpr int count = 20000;
  double cubes = 0.0, depths = 0.0;
  for (int k = 0; k < count; ++k) {
    const Vec3 place = pose_a.translation + (a.body.half.z * ((2.0 * k + 1.0) / count - 1.0)) * pose_a.rotation.column(2);
    const Pose point{{}, transposed_times(pose_b.rotation, place - pose_b.translation)};
    const double depth = std::max(0.0, a.body.radius - signed_distance(b.body, convex::make_sphere(0.0), point, scratch).distance);
    cubes += depth * depth * depth, depths += depth;
  }
  return depths > 0.0 ? 0.5 * cubes / depths : 0.0;
}

struct Obstacle {
  const char *name;
  Shape (*make)(Random &random, int number);
};

// A capsule and an obstacle in each other, from hardly to deeper than the radius.
struct Sample {
  Shape a, b;
  Pose pose_a, pose_b;
  Contact touching;

  Sample(const Obstacle &obstacle, Random &random, int number, double least, double most)
      : a(capsule(random.uniform(0.05, 0.3), random.uniform(0.1, 1.5))), b(obstacle.make(random, number)) {
    pose_a = {random_bodies::random_rotation(random), 3.0 * random.direction()};
    pose_b = {random_bodies::random_rotation(random), random.direction()};
    if (number % 4 == 0) {  // nearly along a box's edges, a cylinder's mantle
      pose_a.rotation = test::product(random_bodies::rotation_about(random.direction(), random.log_uniform(1e-9, 0.1)), pose_b.rotation);
    }
    const double depth = random.log_uniform(least, most) * a.body.radius;
    for (int step = 0; step < 60; ++step) {
      static BackendScratch backend;
      SignedDistance answer;
      find_exact_distance(a, pose_a, b, pose_b, backend, answer);
      if (std::fabs(answer.distance + depth) < 1e-9) break;
      pose_a.translation = pose_a.translation - (answer.distance + depth) * answer.normal;
    }
    touching = contact(a, pose_a, b, pose_b);
  }
};

class CapsuleOn : public testing::TestWithParam<Obstacle> {};

TEST_P(CapsuleOn, StoresTheIntegrals) {
  Random random(8);
  int shallow = 0, deep = 0;
  for (int number = 0; number < 200; ++number) {
    const Sample sample(GetParam(), random, number, 0.05, 2.0);
    if (sample.touching.part != 1.0) continue;
    const double depth = sample.touching.depth, radius = sample.a.body.radius;
    const double stored = test::stored_energy(sample.touching.points);
    const double expected = integrated_energy(sample.a, sample.pose_a, sample.b, sample.pose_b);
    ++(depth < radius ? shallow : deep);
    // Sides that oppose each other push as little as no depth that the points may have stores.
    if (sample.touching.points[0].depth < (1.0 - 1e-9) * std::max(depth, radius)) {
      EXPECT_NEAR(stored, expected, 2e-4 * depth * depth) << number;
    } else {
      EXPECT_LT(stored, expected + 2e-4 * depth * depth) << number;
    }
  }
  EXPECT_GT(shallow, 100);
  EXPECT_GT(deep, 10);
}

TEST_P(CapsuleOn, PushesByTheGradient) {
  Random random(9);
  int touching = 0;
  for (int number = 0; number < 2000; ++number) {
    // Not where the axis comes near the surface: the distance bends there.
    const Sample sample(GetParam(), random, number, 1e-3, 0.5);
    if (sample.touching.part != 1.0) continue;
    ++touching;
    const Sums found = test::sum_of(sample.touching.points);
    const Vec3 shift = random.direction(), turn = random.direction();
    const double depth = sample.touching.depth, step = 1e-4 * depth;
    const auto energy_at = [&](double by) {
      const Contact there = contact(sample.a, test::moved(sample.pose_a, by * shift, by * turn), sample.b, sample.pose_b);
      return test::stored_energy(there.points);
    };
    const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
    const double power = dot(found.force, shift) + dot(found.moment - cross(sample.pose_a.translation, found.force), turn);
    EXPECT_NEAR(power, -slope, 1e-5 * depth) << number;
  }
  EXPECT_GT(touching, 1900);
}

INSTANTIATE_TEST_SUITE_P(Obstacles, CapsuleOn,
                         testing::Values(Obstacle{"polytope", random_polytope}, Obstacle{"cylinder", random_cylinder},
                                         Obstacle{"cone", random_cone}),
                         [](const auto &info) { return std::string(info.param.name); });

TEST(CapsuleOnBox, IsAsHardAsItIsDeepOnAFaceAndSofterAtAnEndAndAcrossAnEdge) {
  const Shape box = polytope(convex::Polytope::box({1, 1, 1}), ShapeKind::box), rod = capsule(0.1, 0.5);
  const double depth = 0.001;
  const Pose below{};
  const auto load = [&](const Mat3 &rotation, const Vec3 &place) {
    return norm(test::sum_of(contact(rod, {rotation, place}, box, below).points).force);
  };
  EXPECT_NEAR(load(test::rotation_about({0, 1, 0}, 0.5 * pi), {0, 0, 0.6 - depth}), depth, 1e-15);
  EXPECT_NEAR(load({}, {0, 0, 0.85 - depth}), 0.5 * depth, 1e-15);
  // At right angles to the edge, and as far from one side as from the other.
  const double beside = std::sqrt(0.5) * (std::sqrt(0.5) + 0.1 - depth);
  EXPECT_NEAR(load(test::rotation_about({0, 1, 0}, -0.25 * pi), {beside, 0, beside}), 24.0 / 35.0 * depth, 0.01 * depth);
}

TEST(CapsuleOnCylinder, IsAsHardAsItIsDeepAlongItAndSofterAtAnEndAndAcross) {
  const Shape drum = revolved(convex::make_cylinder(0.5, 1), ShapeKind::cylinder), rod = capsule(0.1, 0.5);
  const double depth = 0.001;
  const Mat3 along_x = test::rotation_about({0, 1, 0}, 0.5 * pi), along_y = test::rotation_about({1, 0, 0}, 0.5 * pi);
  const auto load = [&](const Mat3 &rotation, const Vec3 &place) {
    return norm(test::sum_of(contact(rod, {rotation, place}, drum, {}).points).force);
  };
  EXPECT_NEAR(load(along_x, {0, 0, 0.6 - depth}), depth, 1e-15);  // on the top
  EXPECT_NEAR(load({}, {0.6 - depth, 0, 0}), depth, 1e-15);       // along the mantle
  EXPECT_NEAR(load({}, {0, 0, 0.85 - depth}), 0.5 * depth, 1e-15);
  EXPECT_NEAR(load(along_y, {0.6 - depth, 0, 0}), 24.0 / 35.0 * depth, 0.01 * depth);
}

}  // namespace
}  // namespace test_capsule_on_convex
