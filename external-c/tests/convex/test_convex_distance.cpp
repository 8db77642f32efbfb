// Signed distances with known answers.
#include <gtest/gtest.h>

#include "random_bodies.hpp"

namespace {

using namespace cmb::convex;
using namespace random_bodies;

Pose at(double x, double y, double z) { return {Mat3{}, {x, y, z}}; }

constexpr double pi = 3.141592653589793;

TEST(ClosedForm, Spheres) {
  DistanceScratch scratch;
  const SignedDistance apart = signed_distance(make_sphere(0.5), make_sphere(0.25), at(0, 3, 4), scratch);
  EXPECT_NEAR(apart.distance, 4.25, 1e-15);
  EXPECT_NEAR(apart.normal.y, -0.6, 1e-15);  // from B to A
  EXPECT_NEAR(apart.point_a.y, 0.3, 1e-15);
  EXPECT_NEAR(apart.point_b.z, 4 - 0.2, 1e-15);
  const SignedDistance inside = signed_distance(make_sphere(0.5), make_sphere(0.25), at(0.1, 0, 0), scratch);
  EXPECT_NEAR(inside.distance, -0.65, 1e-15);
  const SignedDistance coincident = signed_distance(make_sphere(0.5), make_sphere(0.25), at(0, 0, 0), scratch);
  EXPECT_NEAR(coincident.distance, -0.75, 1e-15);
  EXPECT_NEAR(norm(coincident.normal), 1, 1e-15);
}

TEST(ClosedForm, CrossedCapsulesOverlapByTheirRadii) {
  DistanceScratch scratch;
  const Pose crossed{rotation_about({1, 0, 0}, pi / 2), {0.0, 0.1, 0.2}};
  const SignedDistance d = signed_distance(make_capsule(0.1, 1), make_capsule(0.05, 1), crossed, scratch);
  EXPECT_NEAR(d.distance, -0.15, 1e-15);
  EXPECT_NEAR(std::fabs(d.normal.x), 1, 1e-15);
}

TEST(ClosedForm, AlignedCubes) {
  DistanceScratch scratch;
  const ConvexBody cube = make_box({1, 1, 1});
  for (double depth : {1e-7, 1e-3, 0.1, 0.3}) {
    const SignedDistance d = signed_distance(cube, cube, at(0, 0, 1 - depth), scratch);
    EXPECT_NEAR(d.distance, -depth, 1e-15);
    EXPECT_NEAR(d.normal.z, -1, 1e-15);
    EXPECT_NEAR(d.point_a.z, 0.5, 1e-15);
    EXPECT_EQ(d.feature_a.kind, FeatureKind::face);
    EXPECT_EQ(d.feature_a.index, 5);
    EXPECT_EQ(d.feature_b.index, 4);
  }
}

TEST(ClosedForm, CubeOnACubesDiagonal) {
  // Centres 0.8 apart along each axis: the shortest way out is 0.2 along an axis.
  DistanceScratch scratch;
  const SignedDistance d = signed_distance(make_box({1, 1, 1}), make_box({1, 1, 1}), at(0.8, 0.8, 0.8), scratch);
  EXPECT_NEAR(d.distance, -0.2, 1e-15);
}

TEST(ClosedForm, CoincidentCubesAsBoxesAndAsHulls) {
  DistanceScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  for (const ConvexBody &a : {make_box({1, 1, 1}), make_polytope(cube)}) {
    for (const ConvexBody &b : {make_box({1, 1, 1}), make_polytope(cube)}) {
      const SignedDistance d = signed_distance(a, b, at(0, 0, 0), scratch);
      EXPECT_NEAR(d.distance, -1, 1e-14);
      EXPECT_NEAR(norm(d.normal), 1, 1e-14);
      EXPECT_NEAR(norm(d.point_a - d.point_b - d.distance * d.normal), 0, 1e-14);
    }
  }
}

TEST(ClosedForm, CubeOnEdgeAndOnCorner) {
  DistanceScratch scratch;
  const ConvexBody cube = make_box({1, 1, 1});
  const Mat3 on_edge = rotation_about({1, 0, 0}, pi / 4);
  const SignedDistance edge = signed_distance(cube, cube, {on_edge, {0, 0, 0.5 + std::sqrt(0.5) - 0.01}}, scratch);
  EXPECT_NEAR(edge.distance, -0.01, 1e-15);
  EXPECT_EQ(edge.feature_a.kind, FeatureKind::face);
  EXPECT_EQ(edge.feature_b.kind, FeatureKind::edge);
  const Mat3 on_corner = rotation_about(normalized({1, -1, 0}), std::acos(1 / std::sqrt(3.0)));
  const SignedDistance corner = signed_distance(cube, cube, {on_corner, {0, 0, 0.5 + std::sqrt(0.75) + 0.2}}, scratch);
  EXPECT_NEAR(corner.distance, 0.2, 1e-15);
  EXPECT_EQ(corner.feature_b.kind, FeatureKind::vertex);
}

TEST(ClosedForm, SphereAgainstBox) {
  DistanceScratch scratch;
  const ConvexBody box = make_box({2, 2, 2}), ball = make_sphere(0.5);
  EXPECT_NEAR(signed_distance(box, ball, at(4, 5, 1), scratch).distance, 4.5, 1e-15);
  EXPECT_NEAR(signed_distance(box, ball, at(0.9, 0, 0), scratch).distance, -0.6, 1e-15);
  EXPECT_NEAR(signed_distance(ball, box, at(-0.9, 0, 0), scratch).distance, -0.6, 1e-15);
  EXPECT_NEAR(signed_distance(ball, box, at(-0.9, 0, 0), scratch).normal.x, 1, 1e-15);
}

TEST(Input, PoseThatIsNotFiniteIsAnsweredWithoutProof) {
  DistanceScratch scratch;
  const SignedDistance d = signed_distance(make_box({1, 1, 1}), make_sphere(1), at(NAN, 0, 0), scratch);
  EXPECT_FALSE(d.proven);
  EXPECT_EQ(d.distance, 0);
}

}  // namespace
