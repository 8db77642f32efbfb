// Round bodies on meshes in poses that users have: half of them along the axes, over corners and sides of triangles, of all sizes and depths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/contact/mesh_contact.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_aligned_round_bodies {
namespace {

using cmb::ContactPoint;
using cmb::ContactSet;
using cmb::convex::ConvexBody;
using cmb::convex::Mat3;
using cmb::convex::Pose;
using cmb::convex::Vec3;
using cmb::mesh::TriangleMesh;
using random_bodies::Random;

struct Body {
  ConvexBody shape;
  double least;  // of its lengths
};

Body any_body(Random &random, double scale) {
  const double a = scale * random.log_uniform(1e-2, 1), b = scale * random.log_uniform(1e-2, 1), c = scale * random.log_uniform(1e-2, 1);
  switch (random.integer(0, 3)) {
    case 0: return {cmb::convex::make_ellipsoid({a, b, c}), std::min({a, b, c})};
    case 3: return {cmb::convex::make_capsule(a, b), a};
    case 1: return {cmb::convex::make_cylinder(a, b), std::min(a, b)};
    default: return {cmb::convex::make_cone(a, b), std::min(a, b)};
  }
}

Pose any_pose(Random &random, double scale) {
  Mat3 rotation;
  if (random.integer(0, 1) == 1) {
    rotation = random_bodies::random_rotation(random);
  } else {
    for (const Vec3 &axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const Mat3 turn = random_bodies::rotation_about(axis, std::asin(1.0) * random.integer(0, 3)), rows = transposed(rotation);
      rotation = transposed(Mat3{{turn * rows.row[0], turn * rows.row[1], turn * rows.row[2]}});
    }
  }
  const double aside = random.integer(0, 1) == 1 ? random.uniform(-0.3, 0.3) : 0.0;
  return {rotation, {scale * (0.25 * random.integer(-2, 2) + aside), scale * 0.25 * random.integer(-2, 2), 3.0 * scale}};
}

std::vector<TriangleMesh> grounds(double scale) {
  const auto level = [](double, double) { return 0.0; };
  const auto hills = [scale](double x, double y) { return 0.1 * scale * std::sin(2.0 * x / scale) * std::cos(3.0 * y / scale); };
  std::vector<TriangleMesh> result;
  result.push_back(mesh_samples::mesh(mesh_samples::with_speck(mesh_samples::box_mesh({scale, scale, scale}, 2), {0, 40 * scale, 0})));
  result.push_back(mesh_samples::mesh(mesh_samples::sheet_mesh(4.0 * scale, 5, level)));
  result.push_back(mesh_samples::mesh(mesh_samples::sheet_mesh(4.0 * scale, 9, hills)));
  return result;
}

// Points are finite and push; deeper than 1e-4 of the body's least length, where the overlap is no rounding, a shift by next to nothing
// changes the load by next to nothing.
TEST(AlignedRoundBodies, PushAndDoNotJump) {
  Random random(1);
  cmb::mesh::MeshContactScratch scratch;
  int touching = 0, deep_enough = 0;
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const std::vector<TriangleMesh> meshes = grounds(scale);
    for (int k = 0; k < 1500; ++k) {
      const TriangleMesh &mesh = meshes[static_cast<std::size_t>(k) % meshes.size()];
      const Body body = any_body(random, scale);
      Pose pose = any_pose(random, scale);
      const double deep = body.least * random.log_uniform(1e-7, 0.3);
      const auto touch = [&](const Pose &at) {
        ContactSet set;
        smooth_contact(body.shape, at, mesh, {}, scratch, set);
        return set;
      };
      bool reached = false;
      for (int step = 0; step < 60 && !reached; ++step) {
        const double more = touch(pose).distance + deep;
        reached = std::fabs(more) < 1e-3 * deep;
        if (!reached) pose.translation.z -= more;
      }
      if (!reached) continue;
      ++touching;
      Vec3 load;
      double all = 0.0;
      for (const ContactPoint &point : touch(pose).points) {
        ASSERT_GT(point.weight, 0.0) << k;
        ASSERT_GT(point.depth, 0.0) << k;
        ASSERT_TRUE(std::isfinite(point.weight * point.depth + norm(point.position))) << k;
        ASSERT_NEAR(norm(point.normal), 1.0, 1e-9) << k;
        load = load + (point.weight * point.depth) * point.normal;
        all += point.weight * point.depth;
      }
      ASSERT_GT(all, 0.0) << "scale " << scale << " " << k;
      if (deep < 1e-4 * body.least) continue;
      ++deep_enough;
      for (const double part : {1e-15, 1e-12, 1e-9}) {
        const Pose beside{pose.rotation, pose.translation + (part * scale) * random.direction()};
        Vec3 there;
        for (const ContactPoint &point : touch(beside).points) there = there + (point.weight * point.depth) * point.normal;
        EXPECT_LT(norm(there - load), all * (1e-3 + 100.0 * part * scale / deep)) << "scale " << scale << " " << k << " by " << part;
      }
    }
  }
  EXPECT_GT(touching, 3500);
  EXPECT_GT(deep_enough, 1000);
}

// Where a body swallows a mesh its faces as good as vanish from the sums of depths: what carries nothing is not deep for that.
TEST(AlignedRoundBodies, AreNoDeeperThanTheyAreLarge) {
  Random random(2);
  cmb::mesh::MeshContactScratch scratch;
  const double size = 0.2;  // of the meshes; their diagonal is less than 3 of it
  std::vector<TriangleMesh> meshes;
  meshes.push_back(mesh_samples::mesh(mesh_samples::angle_prism({-size, size, size, 0, 0, -size}, {-size, -size, 0, 0, size, size}, -size, size)));
  meshes.push_back(mesh_samples::mesh(mesh_samples::with_speck(mesh_samples::box_mesh({size, size, size}, 1), {0, 2 * size, 0})));
  int touching = 0;
  for (int k = 0; k < 4000; ++k) {
    const Body body = any_body(random, 2.0);
    Pose pose{random_bodies::random_rotation(random), {}};
    if (random.integer(0, 1) == 1) pose = any_pose(random, size);
    pose.translation = random.log_uniform(1e-3, 1) * random.direction();
    ContactSet set;
    smooth_contact(body.shape, pose, meshes[static_cast<std::size_t>(k) % meshes.size()], {}, scratch, set);
    if (set.distance < 0.0) ++touching;
    for (const ContactPoint &point : set.points) {
      ASSERT_LE(point.depth, 3.0 * size + norm(pose.translation) + core_radius(body.shape) + body.shape.radius) << k << ", weight " << point.weight;
      ASSERT_TRUE(std::isfinite(point.weight)) << k;
    }
  }
  EXPECT_GT(touching, 2000);
}

// A cone in a dale, as a simulation came by it: what would pull is left out, which leaves a torque without much force. Points stay where the
// body is all the same, else friction there stops it at once.
TEST(AlignedRoundBodies, TouchWhereTheyAre) {
  Random random(3);
  cmb::mesh::MeshContactScratch scratch;
  const auto hills = [](double x, double y) { return 0.12 * std::sin(3.6 * x) * std::cos(2.8 * y); };
  const TriangleMesh mesh = mesh_samples::mesh(mesh_samples::sheet_mesh(2.0, 17, hills));
  const ConvexBody bodies[] = {cmb::convex::make_cone(0.1, 0.1), cmb::convex::make_cylinder(0.1, 0.1), cmb::convex::make_ellipsoid({0.15, 0.1, 0.07}),
                               cmb::convex::make_capsule(0.05, 0.15)};
  int touching = 0;
  for (int k = 0; k < 6000; ++k) {
    const ConvexBody &body = bodies[k % 4];
    Pose pose{random_bodies::random_rotation(random), {random.uniform(-1, 1), random.uniform(-1, 1), 1.0}};
    const double deep = random.log_uniform(1e-5, 1e-2);
    ContactSet set;
    for (int step = 0; step < 20; ++step) {
      set = {};
      smooth_contact(body, pose, mesh, {}, scratch, set);
      const double more = set.distance + deep;
      if (std::fabs(more) < 0.1 * deep) break;
      pose.translation.z -= more;
    }
    if (set.distance < 0.0) ++touching;
    for (const ContactPoint &point : set.points) {
      ASSERT_LT(norm(point.position - pose.translation), 4.0 * (core_radius(body) + body.radius)) << k << ", load " << point.weight * point.depth;
    }
  }
  EXPECT_GT(touching, 5000);
}

}  // namespace
}  // namespace test_aligned_round_bodies
