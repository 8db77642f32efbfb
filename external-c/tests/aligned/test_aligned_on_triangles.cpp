// Round bodies whose axis lies in the plane of a triangle that they hardly touch.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/mesh_text.hpp"
#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_aligned_on_triangles {
namespace {

using namespace cmb::test;

// Roofs at right angles: a body on one slope, right over whose ridge its axis is, lies in the plane of the slope behind.
TEST(AlignedOnTriangles, AxisInThePlaneOfTheSlopeBehindCarriesTheSameInAllFrames) {
  const std::string roofs =
      mesh_samples::height_field_text(2, 9, [](double x, double) { return 0.25 - std::fabs(x - 0.25 - 0.5 * std::floor(2.0 * x)); });
  random_bodies::Random random(1);
  for (const std::string body : {"cylinder radius=0.4 length=0.5", "capsule radius=0.4 length=0.5", "cone radius=0.4 length=0.5"}) {
    const PairScene scene("cmb/1 " + body, roofs);
    constexpr double deep = 1.25e-3;
    const double root = std::sqrt(0.5), away = (body.rfind("cone", 0) == 0 ? 0.2 : 0.4) - deep;
    // Along the ridge; the cone's middle as deep as the others' mantle.
    const Mat3 along_ridge{{Vec3{0, -1, 0}, Vec3{0, 0, -1}, Vec3{1, 0, 0}}};
    const BodyPose pose{{0.25 - root * away, -0.17, 0.25 + root * away}, along_ridge};
    const Vec3 at_rest = scene.query(pose, {}, 128).load();
    for (int k = 0; k < 200; ++k) {
      const BodyPose frame{random.direction(), random_bodies::random_rotation(random)};
      const BodyPose moved{frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)};
      const Vec3 load = transposed_times(frame.rotation, scene.query(moved, frame, 128).load());
      EXPECT_LT(norm(load - at_rest), 1e-6 * norm(at_rest)) << body << ", frame " << k;
    }
  }
}

// A box and a standing cylinder on the sole of an L whose sides slide through the plane of its side, a tenth of their width deep.
TEST(AlignedOnTriangles, SideInThePlaneOfAMeshsSideCarriesTheSameInAllFrames) {
  using namespace mesh_samples;
  const std::string angle = mesh_text(angle_prism({-0.5, 0.5, 0.5, 0, 0, -0.5}, {-0.5, -0.5, 0, 0, 0.5, 0.5}, -0.5, 0.5));
  random_bodies::Random random(3);
  for (const std::string body : {"box size=0.4,0.4,0.4", "cylinder radius=0.2 length=0.4"}) {
    const PairScene scene("cmb/1 " + body, angle);
    // Its end or a side in the plane x = 0.5 of the L's side.
    const Mat3 along_x{{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}};
    const BodyPose pose{{0.3, 0.2 - 0.04, 0.1}, along_x};
    const Vec3 at_rest = scene.query(pose, {}, 128).load();
    for (int k = 0; k < 100; ++k) {
      const BodyPose frame{random.direction(), random_bodies::random_rotation(random)};
      const BodyPose moved{frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)};
      EXPECT_LT(norm(transposed_times(frame.rotation, scene.query(moved, frame, 128).load()) - at_rest), 1e-9 * norm(at_rest)) << body << ", frame " << k;
    }
    for (const double aside : {1e-12, 1e-9, 1e-6}) {
      for (const double sense : {1.0, -1.0}) {
        const BodyPose beside{pose.position + Vec3{sense * aside, 0, 0}, pose.rotation};
        EXPECT_LT(norm(scene.query(beside, {}, 128).load() - at_rest), (1e-9 + 30.0 * aside) * norm(at_rest)) << body << ", " << sense * aside << " aside";
      }
    }
  }
}

// Meshes of boxes and Ls over roofs with sides in the planes between these and along lines of the grid: what cuts leave of such a side counts for one of the
// two wedges, in any frame.
TEST(AlignedOnTriangles, SidesOfMeshesInPlanesBetweenWedgesCarryTheSameInAllFrames) {
  using namespace mesh_samples;
  const std::string roofs = height_field_text(2, 9, [](double x, double) { return x <= 0.0 ? 0.0 : 0.25 - std::fabs(x - 0.25 - 0.5 * std::floor(2.0 * x)); });
  random_bodies::Random random(7);
  for (const std::string &body : {mesh_text(with_speck(box_mesh({0.25, 0.75, 0.5}, 2))), mesh_text(with_speck(box_mesh({0.5, 0.5, 0.25}, 1))),
                                  mesh_text(angle_prism({-0.25, 0.25, 0.25, 0, 0, -0.25}, {-0.25, -0.25, 0, 0, 0.25, 0.25}, -0.25, 0.25))}) {
    const PairScene scene(body, roofs);
    for (int trial = 0; trial < 24; ++trial) {
      const double deep = random.log_uniform(1e-5, 1e-2);
      Mat3 rotation;
      for (const Vec3 &axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        rotation = product(rotation_about(axis, 2.0 * std::atan(1.0) * random.integer(0, 3)), rotation);
      }
      BodyPose pose{{0.125 * random.integer(-4, 6), 0.125 * random.integer(-4, 4), 1.0}, rotation};
      for (int step = 0; step < 60; ++step) pose.position.z -= scene.query(pose, {}, 128).distance;
      pose.position.z -= deep;
      const Vec3 at_rest = scene.query(pose, {}, 128).load();
      for (int k = 0; k < 20; ++k) {
        const BodyPose frame{random.direction(), random_bodies::random_rotation(random)};
        const BodyPose moved{frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)};
        const Vec3 load = transposed_times(frame.rotation, scene.query(moved, frame, 128).load());
        EXPECT_LT(norm(load - at_rest), 1e-8 * norm(at_rest)) << body.substr(0, 60) << ", trial " << trial << ", frame " << k;
      }
    }
  }
}

// A box whose sole as good as touches level ground and whose edge is deep in the slope beside it: the force is its energy's gradient, whatever the
// sole's area.
TEST(AlignedOnTriangles, WideSideThatHardlyTouchesLeavesAnEdgeItsLoad) {
  const std::string rise = mesh_samples::height_field_text(2, 9, [](double x, double) { return std::fmax(0.0, x); });
  using namespace mesh_samples;
  for (const std::string &body : {std::string("cmb/1 box size=0.8,0.5,0.4"), mesh_text(with_speck(box_mesh({0.8, 0.5, 0.4}, 2), {0, 0, 20}))}) {
    const PairScene scene(body, rise);
    for (const double deep : {1e-9, 1e-7, 1e-5}) {
      const BodyPose pose{{-0.37, 0.03, 0.2 - deep}, {}};
      const Contact contact = scene.query(pose, {}, 128);
      constexpr double step = 1e-6;
      for (const Vec3 &way : {Vec3{1, 0, 0}, Vec3{0, 0, 1}}) {
        const auto energy_at = [&](double length) { return scene.query({pose.position + length * way, pose.rotation}, {}, 128).energy(); };
        const double slope = (energy_at(step) - energy_at(-step)) / (2.0 * step);
        // The sole itself comes off within the step.
        EXPECT_NEAR(dot(way, contact.load()), -slope, 1e-3 * norm(contact.load())) << body.substr(0, 10) << ", " << deep << " deep";
      }
      EXPECT_GT(norm(contact.load()), 0.01) << body.substr(0, 10) << ", " << deep << " deep";
    }
  }
}

// Bodies let down until they touch, and so much further: squares of such depths are below rounding.
TEST(AlignedOnTriangles, LoadIsANumberHoweverShallow) {
  using namespace mesh_samples;
  const std::string ramp = height_field_text(2, 9, [](double x, double) { return 0.5 * std::fmax(0.0, x); });
  random_bodies::Random random(5);
  for (const std::string body : {"box size=0.4,0.3,0.2", "cylinder radius=0.2 length=0.4", "cone radius=0.2 length=0.3", "capsule radius=0.1 length=0.4",
                                 "ellipsoid size=0.4,0.2,0.3"}) {
    const PairScene scene("cmb/1 " + body, ramp);
    for (int trial = 0; trial < 100; ++trial) {
      const Mat3 rotation = trial % 3 == 0 ? Mat3{} : random_bodies::random_rotation(random);
      Vec3 place{random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), 1.0};
      for (int step = 0; step < 60; ++step) place.z -= scene.query({place, rotation}, {}, 128).distance;
      for (int digits = 6; digits < 18; ++digits) {
        const Contact contact = scene.query({place - Vec3{0, 0, std::pow(10.0, -digits)}, rotation}, {}, 128);
        EXPECT_TRUE(std::isfinite(norm(contact.load())) && std::isfinite(contact.energy())) << body << ", trial " << trial << ", 1e-" << digits << " deep";
      }
    }
  }
}

// Long beside its depth: the square of that would be a difference of squares of the length.
TEST(AlignedOnTriangles, LyingConeCarriesTheSameInAllFrames) {
  using namespace mesh_samples;
  const PairScene scene("cmb/1 cone radius=0.05 length=0.4", mesh_text(with_speck(box_mesh({2, 2, 1}, 4))));
  const Mat3 level = rotation_about({0, 1, 0}, 2.0 * std::atan(1.0) + std::atan2(0.05, 0.4));
  random_bodies::Random random(5);
  for (const double deep : {7e-8, 1e-6}) {
    for (int k = 0; k < 300; ++k) {
      const Mat3 turned = product(rotation_about({0, 0, 1}, random.integer(0, 1) == 1 ? random.uniform(0, 6.28) : 2.0 * std::atan(1.0) * random.integer(0, 3)), level);
      const BodyPose pose{{0.05 * random.integer(-2, 2), 0.05 * random.integer(-2, 2), 0.5 - 0.2 * level.row[2].z - deep}, turned};
      const BodyPose frame{random.direction(), random_bodies::random_rotation(random)};
      const BodyPose moved{frame.rotation * pose.position + frame.position, product(frame.rotation, pose.rotation)};
      EXPECT_NEAR(norm(scene.query(moved, frame, 64).load()), 16.0 / 21.0 * deep, 1e-4 * deep) << k;
    }
  }
}

}  // namespace
}  // namespace test_aligned_on_triangles
