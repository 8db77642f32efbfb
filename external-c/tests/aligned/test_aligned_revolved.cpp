// Cylinders and cones across edges and in the plane of sides.
#include <gtest/gtest.h>

#include <cmath>

#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_aligned_revolved {
namespace {

using namespace cmb::test;

// An edge across a mantle, askew: its overlap is long, thin and narrow, and neither along the axis nor around it.
TEST(AlignedRevolved, EdgeAskewOnAMantleCarriesTheSameInAllFrames) {
  const PairScene scene("cmb/1 box size=0.2,0.4,0.25", "cmb/1 cylinder radius=0.5 length=0.2");
  const double root = std::sqrt(0.5);
  const Mat3 rotation{{Vec3{-0.5, 0.5, root}, Vec3{-root, -root, 0.0}, Vec3{0.5, -0.5, root}}};
  const auto load = [&](double deep, const BodyPose &frame) {
    const BodyPose pose{{-0.05, 0.5 + 0.3 * root - deep, 0.1}, rotation};
    return norm(scene.query({frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)}, frame).load());
  };
  random_bodies::Random random(1);
  for (const double deep : {1e-8, 1e-6, 1e-4}) {
    const double at_rest = load(deep, {});
    EXPECT_GT(at_rest, 0.5 * deep);
    for (int k = 0; k < 100; ++k) {
      EXPECT_NEAR(load(deep, {0.5 * random.direction(), random_bodies::random_rotation(random)}), at_rest, (1e-9 + 1e-13 / deep) * at_rest) << deep;
    }
  }
}

// A box's edge against a cone's rim, and a side of the box that passes through the plane of the base: what carries goes over from the one to the other.
TEST(AlignedRevolved, BaseThatPassesThroughTheSidesPlaneCarriesNothingAtOnce) {
  const PairScene scene("cmb/1 box size=0.5,0.5,0.8", "cmb/1 cone radius=0.1 length=0.2");
  constexpr double deep = 2.5e-3;
  const auto load = [&](double aside) {
    return scene.query({{0.25 * std::sqrt(2.0) + 0.1 - deep, 0.0, 0.3 + aside}, rotation_about({0, 0, 1}, std::atan(1.0))}, {}).load();
  };
  const double whole = norm(load(0.0));
  EXPECT_GT(whole, 0.1 * deep);
  EXPECT_GT(norm(load(0.1 * deep) - load(-0.1 * deep)), 0.05 * whole);
  Vec3 before = load(-0.1 * deep);
  for (int k = -99; k <= 100; ++k) {
    const Vec3 here = load(1e-3 * k * deep);
    EXPECT_LT(norm(here - before), 0.02 * whole) << k;
    before = here;
  }
  EXPECT_LT(norm(load(1e-9) - load(-1e-9)), 1e-4 * whole);
}

// So do the ends of two.
TEST(AlignedRevolved, EndsInOnePlaneCarryTheSameExchanged) {
  const std::string cylinder = "cmb/1 cylinder radius=0.125 length=0.5", cone = "cmb/1 cone radius=0.1 length=0.1";
  const PairScene scene(cylinder, cone), exchanged(cone, cylinder);
  constexpr double deep = 1e-3;
  const BodyPose pose{{0.0, 0.225 - deep, 0.2}, {}};
  const Vec3 load = scene.query(pose, {}).load(), other = exchanged.query({}, pose).load();
  EXPECT_LT(norm(load + other), 1e-6 * norm(load));
}

// The end of a capsule against an edge: what pushes along its axis does not turn the points' ways apart.
TEST(AlignedRevolved, PointsOfACapsulesEndAreWhereItTouches) {
  const PairScene scene("cmb/1 capsule radius=0.5 length=0.8", "cmb/1 box size=0.2,0.2,0.2");
  const double root = std::sqrt(0.5);
  constexpr double deep = 4e-3;
  for (const double lean : {0.2, 0.5, 1.0, 1.4}) {
    // The box's edge at the end's ball, out of whose middle it lies by `lean` off the axis.
    const Vec3 way{std::sin(lean), 0.0, std::cos(lean)};
    const Vec3 touched = Vec3{0.0, 0.0, 0.4} + 0.5 * way;
    const Contact contact = scene.query({}, {touched + (0.1 / root - deep) * way, rotation_about({0, 1, 0}, lean + std::atan(1.0))}, 16);
    ASSERT_FALSE(contact.points.empty());
    for (const Point &point : contact.points) EXPECT_LT(norm(point.position - touched), 0.1) << lean;
  }
}

}  // namespace
}  // namespace test_aligned_revolved
