// Bounds of a hierarchy's nodes: never farther apart than what they hold, and close on thin slanted patches.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh/core/triangle_hierarchy.hpp"
#include "mesh/distance/mesh_pair_distance.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_cylinder_bound {
namespace {

using namespace cmb::mesh;

double distance_of_leaves(const MeshData &a, const TriangleHierarchy &tree_a, const TriangleHierarchy::Node &leaf_a,
                          const MeshData &b, const TriangleHierarchy &tree_b, const TriangleHierarchy::Node &leaf_b,
                          const Pose &b_in_a) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = leaf_a.first; i < leaf_a.first + leaf_a.count; ++i) {
    const Triangle &s = a.triangles[tree_a.order()[i]];
    const Vec3 one[3] = {a.vertices[s[0]], a.vertices[s[1]], a.vertices[s[2]]};
    for (std::uint32_t j = leaf_b.first; j < leaf_b.first + leaf_b.count; ++j) {
      const Triangle &t = b.triangles[tree_b.order()[j]];
      const Vec3 other[3] = {b_in_a(b.vertices[t[0]]), b_in_a(b.vertices[t[1]]), b_in_a(b.vertices[t[2]])};
      least = std::fmin(least, triangle_distance(one, other).distance);
    }
  }
  return least;
}

TEST(CylinderBound, IsNoFartherThanWhatItHolds) {
  const MeshData meshes[] = {mesh_samples::sphere_mesh(0.5, 2), mesh_samples::box_mesh({1.0, 0.01, 0.4})};
  random_bodies::Random random(3);
  int apart = 0;
  for (const MeshData &a : meshes) {
    for (const MeshData &b : meshes) {
      const TriangleHierarchy tree_a(a.vertices, a.triangles), tree_b(b.vertices, b.triangles);
      const Pose pose{random_bodies::random_rotation(random), 0.9 * random.direction()};
      for (std::size_t i = 0; i < tree_a.nodes().size(); ++i) {
        for (std::size_t j = 0; j < tree_b.nodes().size(); ++j) {
          if (tree_a.nodes()[i].count == 0 || tree_b.nodes()[j].count == 0) continue;
          const double bound = least_distance(tree_a.flat_bounds()[i], moved(tree_b.flat_bounds()[j], pose));
          const double exact =
              distance_of_leaves(a, tree_a, tree_a.nodes()[i], b, tree_b, tree_b.nodes()[j], pose);
          ASSERT_LE(bound, exact + 1e-15);
          apart += bound > 0.0;
        }
      }
    }
  }
  EXPECT_GT(apart, 1000);
}

TEST(CylinderBound, OfFacingPatchesIsTheirGap) {
  // Two slanted squares, one 0.1 in front of the other: boxes along the axes overlap.
  MeshData square;
  square.vertices = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Pose slanted{random_bodies::rotation_about(normalized(Vec3{1, 2, 0.5}), 0.7), {}};
  for (Vec3 &v : square.vertices) v = slanted(v);
  const TriangleHierarchy tree(square.vertices, square.triangles);
  const Pose in_front{Mat3{}, 0.1 * slanted.rotation.column(2)};
  EXPECT_EQ(distance2(tree.bounds(), moved(tree.bounds(), in_front)), 0.0);
  EXPECT_NEAR(least_distance(tree.flat_bounds()[0], moved(tree.flat_bounds()[0], in_front)), 0.1, 1e-11);
}

TEST(CylinderBound, OfSquaresHardlyTiltedIsNotTooGreat) {
  MeshData square;
  square.vertices = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  const TriangleHierarchy tree(square.vertices, square.triangles);
  random_bodies::Random random(6);
  for (int k = 0; k < 500; ++k) {
    const Vec3 axis = normalized(Vec3{random.normal(), random.normal(), 0.0});
    const Pose pose{random_bodies::rotation_about(axis, random.log_uniform(1e-10, 1e-5)), {0, 0, 0.5}};
    const double bound = least_distance(tree.flat_bounds()[0], moved(tree.flat_bounds()[0], pose));
    const double exact =
        distance_of_leaves(square, tree, tree.nodes()[0], square, tree, tree.nodes()[0], pose);
    ASSERT_LE(bound, exact + 1e-13) << k;
  }
}

}  // namespace
}  // namespace test_cylinder_bound
