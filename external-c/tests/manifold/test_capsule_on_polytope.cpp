// Capsules on boxes and hulls: the energy along the axis, and the gradient of it that the points carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "backend/distance_backend.hpp"
#include "manifold/capsule_on_polytope.hpp"
#include "math/pi.hpp"
#include "math/pose_algebra.hpp"
#include "support/contact_sums.hpp"
#include "support/poses.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

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
  result.part = capsule_on_polytope(a, pose_a, b, pose_b, result.depth, answer.point_a, answer.normal, 1.0, scratch, result.points);
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

// A capsule and a polytope in each other, from hardly to deeper than the radius.
struct Sample {
  Shape a, b;
  Pose pose_a, pose_b;
  Contact touching;

  Sample(Random &random, int number, double least, double most)
      : a(capsule(random.uniform(0.05, 0.3), random.uniform(0.1, 1.5))), b(random_polytope(random, number)) {
    pose_a = {random_bodies::random_rotation(random), 3.0 * random.direction()};
    pose_b = {random_bodies::random_rotation(random), random.direction()};
    if (number % 4 == 0) {  // nearly along a box's edges
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

TEST(CapsuleOnPolytope, StoresTheIntegrals) {
  Random random(8);
  int shallow = 0, deep = 0;
  for (int number = 0; number < 200; ++number) {
    const Sample sample(random, number, 0.05, 2.0);
    if (sample.touching.part != 1.0) continue;
    const double depth = sample.touching.depth, radius = sample.a.body.radius;
    const double stored = test::stored_energy(sample.touching.points);
    const double expected = integrated_energy(sample.a, sample.pose_a, sample.b, sample.pose_b);
    ++(depth < radius ? shallow : deep);
    // Sides that oppose each other push as little as no depth that the points may have stores.
    if (depth < radius || sample.touching.points[0].depth < depth) {
      EXPECT_NEAR(stored, expected, 2e-4 * depth * depth) << number;
    } else {
      EXPECT_LT(stored, expected + 2e-4 * depth * depth) << number;
    }
  }
  EXPECT_GT(shallow, 100);
  EXPECT_GT(deep, 10);
}

TEST(CapsuleOnPolytope, PushesByTheGradient) {
  Random random(9);
  int touching = 0;
  for (int number = 0; number < 2000; ++number) {
    // Not where the axis comes near the surface: the distance bends there.
    const Sample sample(random, number, 1e-3, 0.5);
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

TEST(CapsuleOnPolytope, IsAsHardAsItIsDeepOnAFaceAndSofterAtAnEndAndAcrossAnEdge) {
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

}  // namespace
