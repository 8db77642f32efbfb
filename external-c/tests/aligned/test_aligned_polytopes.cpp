// Edges and faces that rest on others hardly deep, and sides in one plane but for rounding.
#include <gtest/gtest.h>

#include <cmath>

#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_aligned_polytopes {
namespace {

using namespace cmb::test;

// In frames at random: the load by depth.
void expect_load(const PairScene &scene, const BodyPose &pose, double expected, double tolerance) {
  random_bodies::Random random(1);
  for (int k = 0; k < 200; ++k) {
    const BodyPose frame{0.5 * random.direction(), random_bodies::random_rotation(random)};
    const BodyPose moved{frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)};
    EXPECT_NEAR(norm(scene.query(moved, frame).load()), expected, tolerance * expected) << "frame " << k;
  }
}

// The square of its depth is next to rounding of that of its length.
TEST(AlignedPolytopes, EdgeOnAFaceCarriesItsDepthInAllFrames) {
  const PairScene scene("cmb/1 box size=0.4,0.8,0.4", "cmb/1 box size=1,0.8,0.25");
  for (const double deep : {1e-9, 3e-8, 1e-6}) {
    const BodyPose pose{{0.1, 0.1, 0.125 + 0.4 * std::sqrt(0.5) - deep}, rotation_about({0, 1, 0}, std::atan(1.0))};
    expect_load(scene, pose, 0.75 * deep, 1e-13 / deep);
  }
}

// An edge between faces that are not perpendicular, and none of whose normals are axes.
TEST(AlignedPolytopes, EdgeOfATetrahedronOnAFaceCarriesTheSameInAllFrames) {
  const PairScene scene("cmb/1 box size=1,1,0.4", "cmb/1 hull vertices=0.1,0.1,0.1,0.1,-0.1,-0.1,-0.1,0.1,-0.1,-0.1,-0.1,0.1");
  const auto pose = [](double deep) { return BodyPose{{0, 0, 0.3 - deep}, {}}; };
  for (const double deep : {1e-9, 3e-8, 1e-6}) expect_load(scene, pose(deep), 7.0 / 12.0 * deep, 1e-13 / deep + 1e-5);
}

// A side in the plane of the other body's, turned against it by what their planes are crossed by within the depth at rounding.
TEST(AlignedPolytopes, FlushSidesTurnedByNextToNothingCarryTheDepth) {
  const PairScene scene("cmb/1 box size=1,1,0.4", "cmb/1 box size=0.8,0.8,0.5");
  constexpr double deep = 1.15e-6;
  for (const double turn : {1e-12, 3e-11, 7e-10, 8e-10, 1.5e-9, 2e-8}) {
    for (const double sense : {-1.0, 1.0}) {
      const Mat3 turned = rotation_about({0, 0, 1}, sense * turn), quarter{{Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}};
      const Vec3 from_face = turned * Vec3{-0.1, 0.5 - deep, 0.0};
      const Contact contact = scene.query({from_face + Vec3{0, 0.4, 0}, product(turned, quarter)}, {});
      EXPECT_NEAR(contact.load().y, deep, 1e-4 * deep) << turn;
    }
  }
}

// Sides farther off than a twentieth of the depth, and nearer than what counts as one plane otherwise.
TEST(AlignedPolytopes, NearlyFlushSidesOfHardlyDeepBodiesAreOneSurface) {
  const PairScene scene("cmb/1 box size=0.5,0.4,0.41666322040511361", "cmb/1 box size=0.5,0.2,0.5");
  const Mat3 rotation{{Vec3{-1, -3.1315665438626711e-10, 2.4577308825603726e-10}, Vec3{3.1315665438626711e-10, -1, -6.4499776054875766e-11},
                       Vec3{2.4577308825603726e-10, -6.4499776054875766e-11, 1}}};
  const auto load = [&](double x) { return norm(scene.query({}, {{x, 0.29999999816517076, 0.0}, rotation}).load()); };
  const double beside = load(1e-6);
  for (const double x : {-3e-10, -1e-10, 1e-10, 2.8e-10, 3e-10}) EXPECT_NEAR(load(x), beside, 1e-5 * beside) << x;
}

// Two faces of the tetrahedron are as deep below the corner: the distance's direction is that of either.
TEST(AlignedPolytopes, CornerUnderTwoFacesCarriesTheSameInAllFrames) {
  const PairScene scene("cmb/1 hull vertices=-0.4,-0.4,-0.1,0.4,-0.4,-0.1,0.4,0.4,-0.1,-0.4,0.4,-0.1,-0.4,-0.4,0.1,-0.4,0.4,0.1",
                        "cmb/1 hull vertices=0.4,0.4,0.4,0.4,-0.4,-0.4,-0.4,0.4,-0.4,-0.4,-0.4,0.4");
  const BodyPose pose{{-0.43110245464772384, 0.0026962640368011215, -0.86226422079542631},
                      {{Vec3{-0.55734541018930384, -0.70710678118654757, -0.4351621464935993}, Vec3{0.61541220940263563, 0, -0.78820543801610909},
                        Vec3{0.55734541018930372, -0.70710678118654757, 0.4351621464935993}}}};
  expect_load(scene, pose, 4.918307e-8, 1e-5);
}

}  // namespace
}  // namespace test_aligned_polytopes
