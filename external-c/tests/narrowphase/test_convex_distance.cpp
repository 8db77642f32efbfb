// Signed distances with known answers.
#include <gtest/gtest.h>

#include "math/pose_algebra.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"
#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/polytope/feature_enumeration.hpp"
#include "shape/convex_hull.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_smooth.hpp"

namespace test_convex_distance {
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
    const Feature of_a = support_feature(cube, -d.normal), of_b = support_feature(cube, d.normal);
    EXPECT_EQ(of_a.kind, FeatureKind::face);
    EXPECT_EQ(of_a.index, 5);
    EXPECT_EQ(of_b.index, 4);
  }
}

TEST(ClosedForm, CubeOnACubesDiagonal) {
  // Centres 0.8 apart along each axis: the minimum translation is 0.2 along an axis.
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
  EXPECT_EQ(support_feature(cube, -edge.normal).kind, FeatureKind::face);
  EXPECT_EQ(support_feature(cube, transposed_times(on_edge, edge.normal)).kind, FeatureKind::edge);
  const Mat3 on_corner = rotation_about(normalized({1, -1, 0}), std::acos(1 / std::sqrt(3.0)));
  const SignedDistance corner = signed_distance(cube, cube, {on_corner, {0, 0, 0.5 + std::sqrt(0.75) + 0.2}}, scratch);
  EXPECT_NEAR(corner.distance, 0.2, 1e-15);
  EXPECT_EQ(support_feature(cube, transposed_times(on_corner, corner.normal)).kind, FeatureKind::vertex);
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
  EXPECT_EQ(norm(d.normal), 1);
}

TEST(Input, AnyFinitePoseIsAnsweredWithNumbers) {
  DistanceScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  const ConvexBody bodies[] = {make_sphere(1),          make_capsule(0.1, 1), make_box({1, 1, 1}), make_polytope(cube),
                               make_ellipsoid({1, 2, 3}), make_cylinder(1, 1),  make_cone(1, 1)};
  Random random(1);
  for (double reach : {0.0, 1e-320, 1e-200, 1e-16, 1.0, 1e9, 1e100, 1e200, 1e308}) {
    for (const ConvexBody &a : bodies) {
      for (const ConvexBody &b : bodies) {
        const Pose pose{random_rotation(random), {reach, -0.5 * reach, 0.25 * reach}};
        const SignedDistance d = signed_distance(a, b, pose, scratch);
        ASSERT_TRUE(std::isfinite(d.distance) && is_finite(d.normal) && is_finite(d.point_a) && is_finite(d.point_b))
            << reach << " " << static_cast<int>(a.core) << " " << static_cast<int>(b.core);
        EXPECT_NEAR(norm(d.normal), 1, 1e-12);
        if (reach > 10) {
          EXPECT_NEAR(d.distance / reach, std::sqrt(1.3125), 1e-6);
        }
      }
    }
  }
}

TEST(Property, ScalingByAPowerOfTwoScalesTheAnswerToTheBit) {
  DistanceScratch scratch;
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const auto points_a = random_points(random, 12, {1, 0.5, 0.25}, false);
    const auto points_b = random_points(random, 9, {0.5, 1, 0.75}, false);
    const double factor = k % 2 ? 0x1p-10 : 0x1p+10;
    auto scaled = [factor](std::vector<Vec3> points) {
      for (Vec3 &p : points) p = factor * p;
      return points;
    };
    Polytope a, b, scaled_a, scaled_b;
    ASSERT_TRUE(build_convex_hull(points_a, a, nullptr, nullptr) && build_convex_hull(points_b, b, nullptr, nullptr));
    ASSERT_TRUE(build_convex_hull(scaled(points_a), scaled_a, nullptr, nullptr));
    ASSERT_TRUE(build_convex_hull(scaled(points_b), scaled_b, nullptr, nullptr));
    Pose pose{random_rotation(random), random.uniform(0, 1.5) * random.direction()};
    const SignedDistance d = signed_distance(make_polytope(a), make_polytope(b), pose, scratch);
    pose.translation = factor * pose.translation;
    const SignedDistance s = signed_distance(make_polytope(scaled_a), make_polytope(scaled_b), pose, scratch);
    EXPECT_EQ(s.distance, factor * d.distance);
    EXPECT_EQ(norm(s.normal - d.normal), 0);
  }
}

TEST(ClosedForm, CylinderAndConeStandOnABox) {
  DistanceScratch scratch;
  const ConvexBody table = make_box({2, 2, 0.5});
  for (double depth : {1e-7, 1e-3, 0.1}) {
    const SignedDistance foot = signed_distance(make_cylinder(0.3, 1), table, at(0.2, 0, -0.75 + depth), scratch);
    EXPECT_NEAR(foot.distance, -depth, 1e-15);
    EXPECT_NEAR(foot.normal.z, 1, 1e-15);
    const SignedDistance tip = signed_distance(table, make_cone(0.3, 1), at(0.2, 0, -0.75 + depth), scratch);
    EXPECT_NEAR(tip.distance, -depth, 1e-15);
    EXPECT_NEAR(tip.point_b.z, -0.25 + depth, 1e-15);
    EXPECT_NEAR(tip.point_b.x, 0.2, 1e-12);
    const Pose lying{rotation_about({1, 0, 0}, pi / 2), {0, 0, 0.25 + 0.3 - depth}};
    EXPECT_NEAR(signed_distance(table, make_cylinder(0.3, 1), lying, scratch).distance, -depth, 1e-15);
  }
}

TEST(ClosedForm, CrossedCylindersTouchWhereTheirSidesCross) {
  DistanceScratch scratch;
  const Pose crossed{rotation_about({1, 0, 0}, pi / 2), {0.7, 0.05, 0.02}};
  const SignedDistance d = signed_distance(make_cylinder(0.4, 2), make_cylinder(0.25, 2), crossed, scratch);
  EXPECT_NEAR(d.distance, 0.05, 1e-15);
  EXPECT_NEAR(d.point_a.x, 0.4, 1e-14);
  EXPECT_NEAR(d.point_a.y, 0, 1e-12);
  EXPECT_NEAR(d.point_a.z, 0.02, 1e-12);
}

TEST(ClosedForm, EllipsoidAndPointOnAnAxis) {
  DistanceScratch scratch;
  const ConvexBody ellipsoid = make_ellipsoid({1, 2, 3});
  EXPECT_NEAR(signed_distance(ellipsoid, make_sphere(0.5), at(0, 0, 4), scratch).distance, 0.5, 1e-14);
  EXPECT_NEAR(signed_distance(ellipsoid, make_sphere(0), at(0, 0, 0), scratch).distance, -1, 1e-14);
  // From (0, 0, z) to the ellipse of semi-axes a < c: d^2 = a^2 (1 - z^2 / (c^2 - a^2)) while z < (c^2 - a^2) / c.
  const double z = 0.8;
  const SignedDistance inside = signed_distance(ellipsoid, make_sphere(0), at(0, 0, z), scratch);
  EXPECT_NEAR(inside.distance, -std::sqrt(1 - z * z / 8), 1e-14);
}

TEST(Reference, EqualConesOnOneAxisAreAsDeepWhicheverIsFirst) {
  // Equally deep all round: no single direction wins.
  DistanceScratch scratch;
  const ConvexBody a = make_cone(0.17, 0.63), b = make_cone(0.26, 0.77);
  const Pose pose = at(0, 0, -0.15);
  const SignedDistance d = signed_distance(a, b, pose, scratch), e = signed_distance(b, a, pose.inverse(), scratch);
  const double exact = static_cast<double>(-reference::SmoothReference(a, b, pose).lowest());
  EXPECT_NEAR(d.distance, exact, 1e-12);
  EXPECT_NEAR(e.distance, exact, 1e-12);
}

TEST(Reference, NearlyParallelEdgesNeedTheRightNormal) {
  // Two cubes, edge over edge, turned by 2e-8: the gap's own direction is off by 1e-8 there.
  DistanceScratch scratch;
  const Pose pose{{{{0x1.ffffffffffff3p-1, -0x1.317bdc5d65992p-25, 0x1.46049899368a1p-25},
                    {0x1.317bdbdbaf432p-25, 0x1.ffffffffffff8p-1, 0x1.8bd98e021642fp-26},
                    {-0x1.46049912c162bp-25, -0x1.8bd98c71aec0dp-26, 0x1.ffffffffffff7p-1}}},
                  {-0x1.00199c0677a0fp+0, -0x1.addec3d9caeebp-28, 0x1.00176c3dc9f49p+0}};
  const Polytope cube = Polytope::box({1, 1, 1});
  const SignedDistance d = signed_distance(make_polytope(cube), make_polytope(cube), pose, scratch);
  const reference::Polyhedron r = reference_of(cube);
  EXPECT_LT(reference::check(r, moved(r, pose), 0, 0, d).normal, 1e-12);
}

TEST(Reference, NearlyParallelFacesKeepTheirWitnessPointsOnTheBodies) {
  // Slender boxes turned by 1e-12 to 1e-8, one inside the other: any corner may be deepest by rounding.
  Random random(8);
  DistanceScratch scratch;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 size_a{random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1)};
    const Vec3 size_b{random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1), random.log_uniform(1e-3, 1)};
    const Polytope shape_a = Polytope::box(size_a), shape_b = Polytope::box(size_b);
    const Pose pose{rotation_about(random.direction(), random.log_uniform(1e-13, 1e-8)), {}};
    const bool hull_a = random.integer(0, 1) != 0, hull_b = random.integer(0, 1) != 0;
    const SignedDistance d = signed_distance(hull_a ? make_polytope(shape_a) : make_box(size_a),
                                             hull_b ? make_polytope(shape_b) : make_box(size_b), pose, scratch);
    ASSERT_LT(reference::check(reference_of(shape_a), moved(reference_of(shape_b), pose), 0, 0, d).witness, 1e-7);
  }
}

TEST(Fallback, EnumerationAgreesWithExpansion) {
  Random random(6);
  DistanceScratch scratch;
  for (int k = 0; k < 300; ++k) {
    Polytope a, b;
    const auto points = [&] { return random_points(random, random.integer(4, 60), {1, 0.7, 0.4}, k % 2 == 0); };
    ASSERT_TRUE(build_convex_hull(points(), a, nullptr, nullptr));
    ASSERT_TRUE(build_convex_hull(points(), b, nullptr, nullptr));
    const Pose pose{random_rotation(random), random.uniform(0, 2) * random.direction()};
    const ConvexBody body_a = make_polytope(a), body_b = make_polytope(b);
    const SignedDistance d = signed_distance(body_a, body_b, pose, scratch);
    const EnumerationResult e = enumerate_features(MinkowskiDifference(body_a, body_b, pose));
    EXPECT_NEAR(e.distance, d.distance, 1e-13);
    EXPECT_NEAR(norm(e.direction + d.normal), 0, 1e-6);
  }
  EXPECT_EQ(scratch.counters.brute_force, 0u);
}

TEST(Reference, CoincidentHullsOfAThousandVertices) {
  Random random(7);
  DistanceScratch scratch;
  Polytope hull;
  ASSERT_TRUE(build_convex_hull(random_points(random, 1000, {1, 1, 1}, false), hull, nullptr, nullptr));
  const SignedDistance d = signed_distance(make_polytope(hull), make_polytope(hull), Pose{}, scratch);
  // A - A is symmetric: its faces include A's; no width of A may be less than the depth, and one is equal.
  double least_width = INFINITY;
  for (const Polytope::Face &f : hull.faces()) {
    double low = INFINITY;
    for (const Vec3 &v : hull.vertices()) low = std::min(low, dot(f.normal, v));
    least_width = std::min(least_width, f.offset - low);
  }
  EXPECT_LE(-d.distance, least_width + 1e-14);
  double low = INFINITY, high = -INFINITY;
  for (const Vec3 &v : hull.vertices()) {
    low = std::min(low, dot(d.normal, v));
    high = std::max(high, dot(d.normal, v));
  }
  EXPECT_NEAR(-d.distance, high - low, 1e-14);
}

// Cylinders and cones on one axis are equally deep all round: their profiles settle the depth.
TEST(ConvexDistance, CoaxialBodiesOfRevolutionAreProven) {
  DistanceScratch scratch;
  const ConvexBody bodies[] = {make_cylinder(0.5, 1.0), make_cylinder(0.2, 3.0), make_cone(0.5, 1.0),
                               make_cone(0.8, 0.6), make_capsule(0.3, 0.8)};
  const Mat3 upright, over{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
  for (const ConvexBody &a : bodies) {
    for (const ConvexBody &b : bodies) {
      for (const Mat3 &rotation : {upright, over}) {
        for (const double height : {-0.4, -0.1, 0.0, 0.2, 0.45}) {
          const Pose pose{rotation, {0, 0, height}};
          const SignedDistance d = signed_distance(a, b, pose, scratch);
          if (d.distance >= 0.0) continue;
          EXPECT_TRUE(d.proven) << height;
          // Never deeper than along any direction, all round.
          const MinkowskiDifference difference(a, b, pose);
          for (int k = 0; k <= 720; ++k) {
            const double angle = 3.14159265358979323846 * k / 720.0;
            const Vec3 m{0.6 * std::sin(angle), 0.8 * std::sin(angle), std::cos(angle)};
            EXPECT_LE(-d.distance, dot(difference.support(m).w, m) + a.radius + b.radius + 1e-12) << height;
          }
          EXPECT_NEAR(norm(d.point_a - d.point_b - d.distance * d.normal), 0.0, 1e-9) << height;
        }
      }
    }
  }
}

// Apart, the answer carries its own proof: places of both bodies that are as far from each other as the bodies' extents along the
// normal.
TEST(ConvexDistance, CurvedBodiesApartFromHullsAreProven) {
  Random random(17);
  DistanceScratch scratch;
  int apart = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 size{random.log_uniform(1e-3, 1), random.log_uniform(0.1, 1), random.log_uniform(0.1, 1)};
    Polytope hull;
    if (!build_convex_hull(random_points(random, random.integer(5, 60), size, false), hull, nullptr, nullptr)) continue;
    const double r = random.log_uniform(0.01, 1), length = random.log_uniform(0.01, 1);
    const ConvexBody curved[] = {make_cylinder(r, length), make_cone(r, length), make_ellipsoid({r, length, 0.5})};
    const ConvexBody &a = curved[k % 3], b = make_polytope(hull);
    Pose pose{random_rotation(random), random.uniform(1.0, 2.0) * random.direction()};
    for (int step = 0; step < 3; ++step) {  // nearer, down to gaps of 1e-6
      const SignedDistance d = signed_distance(a, b, pose, scratch);
      if (!(d.distance > 0.0)) break;
      ++apart;
      EXPECT_TRUE(d.proven) << k;
      EXPECT_NEAR(norm(d.point_a - d.point_b - d.distance * d.normal), 0.0, 1e-10) << k;
      // The points may slide where surfaces are nearly parallel, which hardly changes the distance.
      EXPECT_LE(outside(a, d.point_a), 1.5e-7) << k;
      const Vec3 local = transposed_times(pose.rotation, d.point_b - pose.translation);
      EXPECT_LE(outside_planes(b, local), 1.5e-7) << k;
      const MinkowskiDifference difference(a, b, pose);
      EXPECT_NEAR(dot(difference.support(-d.normal).w, -d.normal), -d.distance, 1e-10) << k;
      pose.translation = pose.translation + (d.distance * (1.0 - random.log_uniform(1e-6, 0.5))) * d.normal;
    }
  }
  EXPECT_GT(apart, 2000);
}

// Their difference is nearly a body of revolution, and the least depth a valley nearly all round.
TEST(ConvexDistance, BodiesOfRevolutionOnNearlyOneAxisAreAsDeepAsAlongAnyDirection) {
  DistanceScratch scratch;
  const ConvexBody bodies[] = {make_cylinder(0.5, 1.0), make_cone(0.25, 0.25), make_ellipsoid({0.5, 0.5, 2}),
                               make_ellipsoid({1, 1, 0.4}), make_capsule(0.3, 0.8)};
  for (const ConvexBody &a : bodies) {
    for (const ConvexBody &b : bodies) {
      for (const double tilt : {1e-13, 1e-10, 3e-8, 1e-5, 1e-3}) {
        for (const double height : {0.0, 0.15}) {
          const double c = std::cos(tilt), s = std::sin(tilt);
          const Pose pose{{{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}}, {0.3 * tilt, tilt, height}};
          const SignedDistance d = signed_distance(a, b, pose, scratch);
          const SignedDistance reversed = signed_distance(b, a, pose.inverse(), scratch);
          ASSERT_LT(d.distance, 0.0);
          EXPECT_NEAR(d.distance, reversed.distance, 1e-8) << tilt << " " << height;
          const MinkowskiDifference difference(a, b, pose);
          double least = HUGE_VAL;
          for (int k = 0; k <= 4000; ++k) {
            const double angle = 3.14159265358979323846 * k / 4000.0;
            for (const Vec3 &across : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
              const Vec3 m = std::sin(angle) * across + Vec3{0, 0, std::cos(angle)};
              least = std::fmin(least, dot(difference.support(m).w, m));
            }
          }
          EXPECT_LT(-d.distance - a.radius - b.radius, least + 1e-8) << tilt << " " << height;
        }
      }
    }
  }
}

// A ball's centre hardly beside a cone's axis: the side is almost equally near all round, and the search ends anywhere on it.
// The minimum translation is through the ruling that the centre leans to (closed form).
TEST(ConvexDistance, BallsAsEllipsoidsHardlyBesideAConesAxis) {
  random_bodies::Random random(11);
  const double radius = 2.0, length = 2.0, slant = std::hypot(radius, length);
  DistanceScratch scratch;
  for (int k = 0; k < 200; ++k) {
    const Pose cone{random_bodies::random_rotation(random), random.direction()};
    const double turn = random.uniform(-3.2, 3.2), aside = random.log_uniform(1e-7, 1e-2), z = random.uniform(0.0, 0.4);
    const Pose ball{random_bodies::random_rotation(random),
                    cone({aside * std::cos(turn), aside * std::sin(turn), z})};
    const double exact = -1.0 - (length * (radius - aside) - radius * (z + 0.5 * length)) / slant;
    const Pose ball_in_cone = cmb::relative_pose(cone, ball), cone_in_ball = cmb::relative_pose(ball, cone);
    const ConvexBody a = make_cone(radius, length), b = make_ellipsoid({1, 1, 1});
    EXPECT_NEAR(signed_distance(a, b, ball_in_cone, scratch).distance, exact, 1e-12) << k;
    EXPECT_NEAR(signed_distance(b, a, cone_in_ball, scratch).distance, exact, 1e-12) << k;
  }
}

}  // namespace
}  // namespace test_convex_distance
