// Capsules in each other: the energy along both axes, and the gradient of it that the points carry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "manifold/axis/capsule_manifold.hpp"
#include "math/pi.hpp"
#include "support/contact_sums.hpp"
#include "support/poses.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_capsule_contacts {
namespace {

using namespace cmb;
using random_bodies::Random;
using test::moved;
using test::stored_energy;
using test::Sums;
using test::sum_of;

Shape capsule(Random &random) {
  Shape shape;
  shape.kind = ShapeKind::capsule;
  shape.body = convex::make_capsule(random.uniform(0.1, 0.4), random.uniform(0.1, 1.5));
  return shape;
}

// Half the mean of both axes' integrals of depth^3 by those of depth, by many places and the nearest points of segments.
double integrated_energy(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  const double reach = a.body.radius + b.body.radius;
  const auto of_axis = [reach](const Shape &own, const Pose &pose, const Shape &other, const Pose &pose_other) {
    constexpr int count = 100000;
    double cubes = 0.0, depths = 0.0;
    const Vec3 axis = pose_other.rotation.column(2);
    for (int k = 0; k < count; ++k) {
      const double place = own.body.half.z * ((2.0 * k + 1.0) / count - 1.0);
      const Vec3 arm = pose.translation + place * pose.rotation.column(2) - pose_other.translation;
      const double foot = std::clamp(dot(arm, axis), -other.body.half.z, other.body.half.z);
      const double depth = std::max(0.0, reach - norm(arm - foot * axis));
      cubes += depth * depth * depth, depths += depth;
    }
    return depths > 0.0 ? 0.5 * cubes / depths : 0.0;
  };
  return 0.5 * (of_axis(a, pose_a, b, pose_b) + of_axis(b, pose_b, a, pose_a));
}

TEST(CapsuleOnCapsule, StoresTheIntegralsAndPushesByTheirGradient) {
  Random random(3);
  BackendScratch backend;
  int touching = 0;
  for (int sample = 0; sample < 2000; ++sample) {
    const Shape a = capsule(random), b = capsule(random);
    Pose pose_a{random_bodies::random_rotation(random), random.direction()}, pose_b{random_bodies::random_rotation(random), {}};
    if (sample % 4 == 0) {  // nearly parallel
      pose_b.rotation =
          test::product(random_bodies::rotation_about(random.direction(), random.log_uniform(1e-6, 0.3)), pose_a.rotation);
    }
    SignedDistance answer;
    find_exact_distance(a, pose_a, b, pose_b, backend, answer);
    pose_a.translation = pose_a.translation - (answer.distance + random.log_uniform(1e-3, 0.1)) * answer.normal;
    find_exact_distance(a, pose_a, b, pose_b, backend, answer);
    // Not where the axes come near each other: the distance bends there.
    if (!(answer.distance < 0.0) || -answer.distance > 0.5 * (a.body.radius + b.body.radius)) continue;
    ++touching;
    std::vector<ContactPoint> points;
    ASSERT_TRUE(capsule_on_capsule(a, pose_a, b, pose_b, answer, points));
    const Sums found = sum_of(points);
    const double energy = stored_energy(points), depth = -answer.distance;
    if (sample % 10 == 0) {
      EXPECT_NEAR(energy, integrated_energy(a, pose_a, b, pose_b), 1e-5 * depth * depth) << sample;
    }
    // In a random motion of six degrees of freedom.
    const Vec3 shift = random.direction(), turn = random.direction();
    const double step = 1e-4 * depth;
    const auto energy_at = [&](double by) {
      const Pose at = moved(pose_a, by * shift, by * turn);
      ContactSet contact;
      EXPECT_TRUE(capsule_contact(a, at, b, pose_b, contact));
      return stored_energy(contact.points);
    };
    const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
    const double power = dot(found.force, shift) + dot(found.moment - cross(pose_a.translation, found.force), turn);
    EXPECT_NEAR(power, -slope, 1e-5 * depth) << sample;
    // The same from the poses at once.
    ContactSet whole;
    ASSERT_TRUE(capsule_contact(a, pose_a, b, pose_b, whole));
    EXPECT_NEAR(whole.distance, answer.distance, 1e-14);
    EXPECT_LT(norm(whole.normal - answer.normal), 1e-13);
    EXPECT_LT(norm(whole.witness - 0.5 * (answer.point_a + answer.point_b)), 1e-13);
    const Sums at_once = sum_of(whole.points);
    EXPECT_LT(norm(at_once.force - found.force), 1e-10);
    EXPECT_LT(norm(at_once.moment - found.moment), 1e-10);
  }
  EXPECT_GT(touching, 1000);
}

TEST(CapsuleOnCapsule, IsAsHardAsItIsDeepAlongAnotherOneAndSofterAcross) {
  Shape shape;
  shape.kind = ShapeKind::capsule;
  shape.body = convex::make_capsule(0.1, 0.5);
  const double depth = 0.001;
  const Pose below{};
  ContactSet along, across, upright;
  ASSERT_TRUE(capsule_contact(shape, {{}, {0.2 - depth, 0, 0}}, shape, below, along));
  EXPECT_NEAR(norm(sum_of(along.points).force), depth, 1e-12);
  ASSERT_TRUE(capsule_contact(shape, {test::rotation_about({1, 0, 0}, 0.5 * pi), {0.2 - depth, 0, 0}}, shape, below, across));
  EXPECT_NEAR(norm(sum_of(across.points).force), 24.0 / 35.0 * depth, 0.01 * depth);
  ASSERT_TRUE(capsule_contact(shape, {{}, {0, 0, 0.7 - depth}}, shape, below, upright));
  EXPECT_NEAR(norm(sum_of(upright.points).force), 0.5 * depth, 1e-12);
}

// Apart, there is a nearest place and nothing carries.
TEST(CapsuleOnCapsule, HasNoPointsApart) {
  Random random(5);
  const Shape a = capsule(random), b = capsule(random);
  const Pose pose_a{random_bodies::random_rotation(random), {0, 0, 3}}, pose_b{random_bodies::random_rotation(random), {}};
  BackendScratch backend;
  SignedDistance answer;
  find_exact_distance(a, pose_a, b, pose_b, backend, answer);
  ContactSet found;
  ASSERT_TRUE(capsule_contact(a, pose_a, b, pose_b, found));
  EXPECT_GT(found.distance, 0.0);
  EXPECT_NEAR(found.distance, answer.distance, 1e-14);
  EXPECT_TRUE(found.points.empty());
}

// The gap between the axes is small beside the way to their ends.
TEST(CapsuleOnCapsule, NormalsAreUnitVectorsWhereAxesNearlyMeet) {
  Random random(9);
  BackendScratch backend;
  for (int sample = 0; sample < 5000; ++sample) {
    const Shape a = capsule(random), b = capsule(random);
    const Pose pose_b{random_bodies::random_rotation(random), {}};
    const Pose pose_a{
        test::product(random_bodies::rotation_about(random.direction(), random.log_uniform(1e-12, 1e-3)), pose_b.rotation),
        random.log_uniform(1e-7, 1e-3) * random.direction()};
    SignedDistance answer;
    find_exact_distance(a, pose_a, b, pose_b, backend, answer);
    std::vector<ContactPoint> points;
    capsule_on_capsule(a, pose_a, b, pose_b, answer, points);
    for (const ContactPoint &point : points) ASSERT_NEAR(norm(point.normal), 1.0, 1e-14) << sample;
  }
}

// There is no direction from axis to axis then: the caller takes the stations along both.
TEST(CapsuleOnCapsule, DoesNotAnswerWhereTheAxesMeet) {
  Random random(4);
  const Shape a = capsule(random), b = capsule(random);
  const Pose pose_a{}, pose_b{test::rotation_about({1, 0, 0}, 1.0), {}};
  BackendScratch backend;
  SignedDistance answer;
  find_exact_distance(a, pose_a, b, pose_b, backend, answer);
  std::vector<ContactPoint> points;
  EXPECT_FALSE(capsule_on_capsule(a, pose_a, b, pose_b, answer, points));
  EXPECT_TRUE(points.empty());
  ContactSet found;
  EXPECT_FALSE(capsule_contact(a, pose_a, b, pose_b, found));
  EXPECT_TRUE(found.points.empty());
}

}  // namespace
}  // namespace test_capsule_contacts
