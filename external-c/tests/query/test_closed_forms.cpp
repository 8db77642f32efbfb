// Contacts whose answer is known in closed form.
#include <random>

#include "support/scene_query.hpp"

namespace test_closed_forms {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;
const BodyPose origin;

TEST(Halfspace, SphereTouchesAtItsLowestPoint) {
  const PairScene scene("cmb/1 sphere radius=0.5", "cmb/1 halfspace");
  const Contact apart = scene.query({{1, 2, 0.75}, {}}, origin);
  EXPECT_NEAR(apart.distance, 0.25, 1e-15);
  EXPECT_TRUE(apart.points.empty());
  const Contact touching = scene.query({{1, 2, 0.4}, {}}, origin);
  EXPECT_NEAR(touching.distance, -0.1, 1e-15);
  ASSERT_EQ(touching.points.size(), 1u);
  EXPECT_NEAR(touching.points[0].depth, 0.1, 1e-15);
  EXPECT_EQ(touching.points[0].weight, 1.0);
  EXPECT_NEAR(norm(touching.points[0].normal - Vec3{0, 0, 1}), 0.0, 1e-15);
  EXPECT_NEAR(norm(touching.points[0].position - Vec3{1, 2, -0.05}), 0.0, 1e-15);
}

// Far from the origin, just touching: rounding decides, but points carry where, and only where, the distance says they do.
TEST(Halfspace, RoundBodiesCarryOnlyWhereTheyTouch) {
  std::mt19937 engine(11);
  const auto random = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(engine() >> 5) / 134217728.0);
  };
  int touching = 0, apart = 0;
  for (const char *shape : {"cmb/1 cone radius=0.8 length=0.5", "cmb/1 cylinder radius=0.3 length=0.5",
                            "cmb/1 capsule radius=0.3 length=0.5"}) {
    const PairScene scene(shape, "cmb/1 halfspace");
    for (int k = 0; k < 20000; ++k) {
      const Vec3 axis = cmb::convex::normalized(Vec3{random(-1, 1), random(-1, 1), random(-1, 1)});
      const double far = k % 2 == 0 ? 200 : 0;
      BodyPose ground{{random(-far, far), random(-far, far), random(-far, far)}, rotation_about(axis, random(-3, 3))};
      BodyPose body{{0, 0, 0}, rotation_about(cmb::convex::normalized(Vec3{random(-1, 1), random(-1, 1), random(-1, 1)}), random(-3, 3))};
      const Vec3 up = ground.rotation * Vec3{0, 0, 1};
      body.position = ground.position + up;
      body.position = body.position - scene.query(body, ground, 8).distance * up;
      const Contact contact = scene.query(body, ground, 8);
      ASSERT_EQ(!contact.points.empty(), contact.distance < 0.0) << shape << " " << k << " " << contact.distance;
      ++(contact.points.empty() ? apart : touching);
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(apart, 1000);
}

TEST(Halfspace, ReversedPairHasReversedNormals) {
  const PairScene scene("cmb/1 halfspace", "cmb/1 sphere radius=0.5");
  const Contact touching = scene.query(origin, {{0, 0, 0.4}, {}});
  ASSERT_EQ(touching.points.size(), 1u);
  EXPECT_NEAR(norm(touching.points[0].normal - Vec3{0, 0, -1}), 0.0, 1e-15);
  EXPECT_NEAR(touching.points[0].depth, 0.1, 1e-15);
}

TEST(Halfspace, BoxRestsOnFourPointsOfWeightOneQuarter) {
  const PairScene scene("cmb/1 box size=0.4,0.6,0.2", "cmb/1 halfspace");
  const double mass = 3.0, gravity = 9.81, stiffness = 1e5;
  const double resting = mass * gravity / stiffness;
  const Contact contact = scene.query({{0, 0, 0.1 - resting}, {}}, origin);
  ASSERT_EQ(contact.points.size(), 4u);
  for (const Point &point : contact.points) {
    EXPECT_NEAR(point.weight, 0.25, 1e-15);
    EXPECT_NEAR(point.depth, resting, 1e-15);
    EXPECT_NEAR(std::fabs(point.position.x), 0.2, 1e-15);
    EXPECT_NEAR(std::fabs(point.position.y), 0.3, 1e-15);
  }
  EXPECT_NEAR(stiffness * contact.load().z, mass * gravity, 1e-9);
  EXPECT_NEAR(contact.distance, -resting, 1e-15);
}

TEST(Halfspace, BoxOnCornerHasTheCornersDepth) {
  const PairScene scene("cmb/1 box size=1,1,1", "cmb/1 halfspace");
  // The space diagonal upright: the lowest corner lies sqrt(3)/2 below the centre.
  const Vec3 axis = normalized(cross(Vec3{1, 1, 1}, Vec3{0, 0, 1}));
  const Mat3 upright = rotation_about(axis, std::acos(1.0 / std::sqrt(3.0)));
  const Contact contact = scene.query({{0, 0, std::sqrt(0.75) - 0.01}, upright}, origin);
  EXPECT_NEAR(contact.distance, -0.01, 1e-14);
  ASSERT_EQ(contact.points.size(), 1u);
  EXPECT_NEAR(contact.points[0].depth, 0.01, 1e-14);
}

TEST(Halfspace, HullOfPrismRestsOnEveryFaceWithWeightsThatSumToOne) {
  // A hexagonal prism: its faces have six and four corners.
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < 6; ++k) {
    for (const char *z : {"0.4", "-0.4"}) {
      text += digits(std::cos(k * pi / 3)) + "," + digits(std::sin(k * pi / 3)) + "," + z + ",";
    }
  }
  text.pop_back();
  const PairScene scene(text, "cmb/1 halfspace");
  const Contact base = scene.query({{0, 0, 0.39}, {}}, origin);
  ASSERT_EQ(base.points.size(), 6u);
  EXPECT_NEAR(base.total_weight(), 1.0, 1e-9);
  const Mat3 onto_side = rotation_about({1, 0, 0}, pi / 2);
  for (int side = 0; side < 6; ++side) {
    const Mat3 turned = product(onto_side, rotation_about({0, 0, 1}, side * pi / 3));
    const Contact contact = scene.query({{0, 0, std::sqrt(0.75) - 0.01}, turned}, origin);
    ASSERT_EQ(contact.points.size(), 4u) << side;
    EXPECT_NEAR(contact.total_weight(), 1.0, 1e-9);
    EXPECT_NEAR(contact.load().z, 0.01, 1e-12);
  }
}

TEST(Halfspace, CapsuleLyingSharesBetweenItsEndsAndStandingTouchesWithOne) {
  const PairScene scene("cmb/1 capsule radius=0.1 length=0.6", "cmb/1 halfspace");
  const Contact lying = scene.query({{0, 0, 0.098}, rotation_about({0, 1, 0}, pi / 2)}, origin);
  ASSERT_EQ(lying.points.size(), 2u);
  for (const Point &point : lying.points) {
    EXPECT_NEAR(point.weight, 0.5, 1e-15);
    EXPECT_NEAR(point.depth, 0.002, 1e-15);
    EXPECT_NEAR(std::fabs(point.position.x), 0.3, 1e-15);
  }
  const Contact standing = scene.query({{0, 0, 0.398}, {}}, origin);
  ASSERT_EQ(standing.points.size(), 1u);
  EXPECT_NEAR(standing.points[0].weight, 1.0, 1e-15);
  EXPECT_NEAR(standing.points[0].depth, 0.002, 1e-15);
}

TEST(Halfspace, CylinderStandsOnFourPointsAndLiesOnTwo) {
  const PairScene scene("cmb/1 cylinder radius=0.2 length=0.6", "cmb/1 halfspace");
  for (const double turned : {0.0, pi}) {
    const Contact standing = scene.query({{0, 0, 0.298}, rotation_about({1, 0, 0}, turned)}, origin);
    ASSERT_EQ(standing.points.size(), 4u);
    EXPECT_NEAR(standing.total_weight(), 1.0, 1e-14);
    EXPECT_NEAR(standing.load().z, 0.002, 1e-15);
    for (const Point &point : standing.points) {
      EXPECT_NEAR(std::hypot(point.position.x, point.position.y), 0.2, 1e-14);
    }
  }
  const Contact lying = scene.query({{0, 0, 0.198}, rotation_about({0, 1, 0}, pi / 2)}, origin);
  ASSERT_EQ(lying.points.size(), 2u);
  EXPECT_NEAR(lying.load().z, 0.002, 1e-15);
  for (const Point &point : lying.points) {
    EXPECT_NEAR(point.weight, 0.5, 1e-14);
    EXPECT_NEAR(std::fabs(point.position.x), 0.3, 1e-14);
  }
}

TEST(Halfspace, ConeStandsOnItsBaseAndOnItsApexAndLiesOnItsMantle) {
  const PairScene scene("cmb/1 cone radius=0.3 length=0.4", "cmb/1 halfspace");
  const Contact standing = scene.query({{0, 0, 0.198}, {}}, origin);
  ASSERT_EQ(standing.points.size(), 4u);
  EXPECT_NEAR(standing.total_weight(), 1.0, 1e-14);
  EXPECT_NEAR(standing.load().z, 0.002, 1e-15);
  const Contact upside_down = scene.query({{0, 0, 0.198}, rotation_about({1, 0, 0}, pi)}, origin);
  ASSERT_EQ(upside_down.points.size(), 1u);
  EXPECT_NEAR(upside_down.points[0].weight, 1.0, 1e-14);
  // Turned until the mantle's line, 0.5 long, lies level: its middle lies 0.12 off the frame's origin.
  const Contact lying = scene.query({{0, 0, 0.118}, rotation_about({0, 1, 0}, pi - std::atan2(0.4, 0.3))}, origin);
  ASSERT_EQ(lying.points.size(), 2u);
  for (const Point &point : lying.points) EXPECT_NEAR(point.depth, 0.002, 1e-14);
  EXPECT_NEAR(norm(lying.points[0].position - lying.points[1].position), 0.5, 1e-12);
  EXPECT_NEAR(lying.load().z, 0.002, 1e-14);
}

TEST(Halfspace, EllipsoidTouchesWhereItsNormalPointsDown) {
  const PairScene scene("cmb/1 ellipsoid size=1,0.6,0.4", "cmb/1 halfspace");
  const Mat3 rotation = rotation_about(cmb::convex::normalized(Vec3{1, 2, 3}), 0.7);
  const Vec3 down = transposed_times(rotation, Vec3{0, 0, -1});
  const double reach = std::sqrt(0.25 * down.x * down.x + 0.09 * down.y * down.y + 0.04 * down.z * down.z);
  const Contact contact = scene.query({{0, 0, reach - 0.01}, rotation}, origin);
  ASSERT_EQ(contact.points.size(), 1u);
  EXPECT_NEAR(contact.points[0].depth, 0.01, 1e-15);
}

TEST(Spheres, TouchAlongTheLineOfCentres) {
  const PairScene scene("cmb/1 sphere radius=0.3", "cmb/1 sphere radius=0.2");
  const Vec3 direction = normalized(Vec3{1, -2, 3});
  for (const double distance : {0.4, 0.0, -0.05, -0.2}) {
    const Contact contact = scene.query({Vec3{5, 6, 7} + (0.5 + distance) * direction, {}}, {{5, 6, 7}, {}});
    EXPECT_NEAR(contact.distance, distance, 1e-14);
    if (distance >= -1e-14) continue;
    ASSERT_EQ(contact.points.size(), 1u);
    EXPECT_NEAR(norm(contact.points[0].normal - direction), 0.0, 1e-13);
    EXPECT_NEAR(norm(contact.points[0].position - (Vec3{5, 6, 7} + (0.2 + 0.5 * distance) * direction)), 0.0, 1e-14);
  }
}

TEST(Compounds, TakeEveryShapeInItsPlace) {
  const PairScene scene(
      "cmb/1 sphere radius=0.1 position=0.5,0,0; cmb/1 sphere radius=0.1 position=-0.5,0,0", "cmb/1 halfspace");
  const Contact contact = scene.query({{0, 0, 0.09}, {}}, origin);
  ASSERT_EQ(contact.points.size(), 2u);
  EXPECT_NEAR(contact.points[0].position.x, 0.5, 1e-15);
  EXPECT_NEAR(contact.points[1].position.x, -0.5, 1e-15);
}

TEST(Compounds, ShapeRotationIsFromBodyToShape) {
  // T turns the body's z axis into the shape's x axis: the capsule lies along the body's x axis.
  const PairScene scene("cmb/1 capsule radius=0.1 length=1 rotation=0,0,-1,0,1,0,1,0,0", "cmb/1 halfspace");
  const Contact contact = scene.query({{0, 0, 0.095}, {}}, origin);
  ASSERT_EQ(contact.points.size(), 2u);
  EXPECT_NEAR(std::fabs(contact.points[0].position.x), 0.5, 1e-14);
}

TEST(BodiesWithoutShape, NeverTouch) {
  const PairScene scene("", "cmb/1 halfspace");
  EXPECT_EQ(scene.query({{0, 0, -5}, {}}, origin).distance, CMB_DISTANCE_NONE);
  const PairScene planes("cmb/1 halfspace", "cmb/1 halfspace");
  EXPECT_EQ(planes.query(origin, origin).distance, CMB_DISTANCE_NONE);
}

// Of ellipsoids with one middle and the same axes, h(m) = |A m| + |B m|: both terms are concave functions of the squares of
// m's components, which sum to 1, so that the least of them is at an axis, and the depth the least sum of semi-axes.
TEST(Ellipsoids, ConcentricOnesAreAsDeepAsTheLeastSumOfSemiAxes) {
  const struct {
    double a[3], b[3];
  } pairs[] = {{{0.3, 0.3, 0.5}, {0.4, 0.4, 0.2}}, {{0.3, 0.4, 0.5}, {0.5, 0.35, 0.2}}, {{0.5, 0.5, 0.2}, {0.3, 0.3, 0.4}}};
  for (const auto &pair : pairs) {
    std::string text[2];
    double least = 1e9;
    for (int k = 0; k < 3; ++k) least = std::fmin(least, pair.a[k] + pair.b[k]);
    for (int body = 0; body < 2; ++body) {
      const double *half = body == 0 ? pair.a : pair.b;
      text[body] = "cmb/1 ellipsoid size=" + digits(2 * half[0]) + "," + digits(2 * half[1]) + "," + digits(2 * half[2]);
    }
    const Mat3 turned = rotation_about(cmb::convex::normalized(Vec3{1, 2, 3}), 0.8);
    for (const Mat3 &rotation : {Mat3{}, turned}) {
      // A whole circle of directions is as deep where two sums are equal: the search may end beside it, by 7e-8 in 0.7.
      EXPECT_NEAR(PairScene(text[0], text[1]).query({{}, rotation}, {{}, rotation}).distance, -least, 1e-6);
    }
  }
}

// Of revolution about one axis, and apart along it: all directions of a cone about it are equally deep, and one angle tells.
TEST(Ellipsoids, CoaxialOnesAreAsDeepAsTheBestInclination) {
  const double a[2] = {0.3, 0.5}, b[2] = {0.45, 0.2};  // radius, half length
  const PairScene scene("cmb/1 ellipsoid size=0.6,0.6,1", "cmb/1 ellipsoid size=0.9,0.9,0.4");
  const Mat3 turned = rotation_about(cmb::convex::normalized(Vec3{1, 2, 3}), 0.8);
  for (const double apart : {0.01, 0.05, 0.1, 0.3, 0.5, 0.69}) {
    double least = 1e9;
    for (int k = 0; k <= 400000; ++k) {
      const double angle = pi * k / 400000, c = std::cos(angle), s = std::sin(angle);
      least = std::fmin(least, std::hypot(a[0] * s, a[1] * c) + std::hypot(b[0] * s, b[1] * c) + apart * c);
    }
    for (const Mat3 &rotation : {Mat3{}, turned}) {
      EXPECT_NEAR(scene.query({rotation * Vec3{0, 0, apart}, rotation}, {{}, rotation}).distance, -least, 1e-9) << apart;
    }
  }
}

}  // namespace
}  // namespace test_closed_forms
