// Capsules in each other: closed forms from the deepest place on give what the stations along both axes do.
#include <gtest/gtest.h>

#include "manifold/capsule_manifold.hpp"
#include "manifold/line_manifold.hpp"
#include "support/poses.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace {

using namespace cmb;
using random_bodies::Random;

struct Sums {
  double load = 0.0;
  Vec3 force, moment;
};

Sums sum(const std::vector<ContactPoint> &points) {
  Sums sums;
  for (const ContactPoint &p : points) {
    const Vec3 force = p.weight * p.depth * p.normal;
    sums.load += p.weight * p.depth;
    sums.force = sums.force + force;
    sums.moment = sums.moment + cross(p.position, force);
  }
  return sums;
}

Shape capsule(Random &random) {
  Shape shape;
  shape.kind = ShapeKind::capsule;
  shape.body = convex::make_capsule(random.uniform(0.1, 0.4), random.uniform(0.1, 1.5));
  return shape;
}

TEST(CapsuleOnCapsule, CarriesAsTheStationsAlongBothAxesDo) {
  Random random(3);
  BackendScratch backend;
  LineManifoldScratch scratch;
  int alone = 0, several = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    const Shape a = capsule(random), b = capsule(random);
    Pose pose_a{random_bodies::random_rotation(random), random.direction()}, pose_b{random_bodies::random_rotation(random), {}};
    if (sample % 4 == 0) {  // nearly parallel
      pose_b.rotation =
          test::product(random_bodies::rotation_about(random.direction(), random.log_uniform(1e-6, 0.3)), pose_a.rotation);
    }
    SignedDistance answer;
    find_exact_distance(a, pose_a, b, pose_b, backend, answer);
    pose_a.translation = pose_a.translation - (answer.distance + random.log_uniform(1e-4, 0.1)) * answer.normal;
    find_exact_distance(a, pose_a, b, pose_b, backend, answer);
    if (!(answer.distance < 0.0)) continue;
    std::vector<ContactPoint> closed, stations;
    ASSERT_TRUE(capsule_on_capsule(a, pose_a, b, pose_b, answer, closed));
    ++(closed.size() == 1 ? alone : several);
    const ContactLine line_a(a, pose_a, -answer.normal), line_b(b, pose_b, answer.normal);
    line_on_line(line_a, line_b, answer.point_a, answer.normal, 1.0, scratch, stations);
    line_on_line(line_b, line_a, answer.point_b, -answer.normal, -1.0, scratch, stations);
    for (ContactPoint &p : stations) p.weight *= 0.5;
    const Sums found = sum(closed), expected = sum(stations);
    EXPECT_NEAR(found.load, expected.load, 1e-13);
    EXPECT_LT(norm(found.force - expected.force), 1e-13);
    EXPECT_LT(norm(found.moment - expected.moment), 1e-13);
    // The same from the poses at once.
    ContactSet whole;
    ASSERT_TRUE(capsule_contact(a, pose_a, b, pose_b, whole));
    EXPECT_NEAR(whole.distance, answer.distance, 1e-14);
    EXPECT_LT(norm(whole.normal - answer.normal), 1e-13);
    EXPECT_LT(norm(whole.witness - 0.5 * (answer.point_a + answer.point_b)), 1e-13);
    const Sums at_once = sum(whole.points);
    EXPECT_NEAR(at_once.load, expected.load, 1e-13);
    EXPECT_LT(norm(at_once.force - expected.force), 1e-13);
    EXPECT_LT(norm(at_once.moment - expected.moment), 1e-13);
  }
  EXPECT_GT(alone, 5000);
  EXPECT_GT(several, 5000);
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

// There is no direction from axis to axis then: the caller takes the stations along both.
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
