// Contact of meshes with other bodies.
#include <gtest/gtest.h>

#include "mesh/contact/mesh_contact.hpp"
#include "narrowphase/convex_distance.hpp"
#include "query/mesh_halfspace.hpp"
#include "scene/mesh_hull.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_mesh_contact {
namespace {

using namespace mesh_samples;
using cmb::ContactPoint;
using cmb::ContactSet;
using cmb::convex::Polytope;
using cmb::mesh::MeshContactScratch;
using random_bodies::Random;
using random_bodies::random_rotation;
using random_bodies::rotation_about;

struct Wrench {
  Vec3 force, torque;  // of loads, about the origin
  double load = 0.0;
};

Wrench wrench(const ContactSet &set) {
  Wrench sum;
  for (const ContactPoint &p : set.points) {
    const Vec3 f = p.weight * p.depth * p.normal;
    sum.force = sum.force + f;
    sum.torque = sum.torque + cross(p.position, f);
    sum.load += p.weight * p.depth;
  }
  return sum;
}

void expect_near(const Vec3 &a, const Vec3 &b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

ContactSet ball(const Vec3 &center, double radius, const TriangleMesh &m, const Pose &pose = {}) {
  static MeshContactScratch scratch;
  ContactSet set;
  sphere_contact(center, radius, m, pose, scratch, set);
  return set;
}

ContactSet capsule(double radius, double length, const Pose &body, const TriangleMesh &m, const Pose &pose = {}) {
  static MeshContactScratch scratch;
  ContactSet set;
  smooth_contact(cmb::convex::make_capsule(radius, length), body, m, pose, scratch, set);
  return set;
}

ContactSet polytope(const Polytope &body, const Pose &body_pose, const TriangleMesh &m, const Pose &pose = {}) {
  static MeshContactScratch scratch;
  ContactSet set;
  polytope_contact(body, body_pose, m, pose, scratch, set);
  return set;
}

TriangleMesh flat_sheet() {
  return mesh(sheet_mesh(4.0, 9, [](double, double) { return 0.0; }));
}

// Mesh against half-space.

cmb::Shape mesh_shape(const TriangleMesh &m) {
  cmb::Shape shape;
  shape.kind = cmb::ShapeKind::mesh;
  shape.mesh = std::make_shared<const TriangleMesh>(m);
  shape.mesh_hull = cmb::make_mesh_hull(m);
  return shape;
}

TEST(MeshOnHalfspace, CubeIsTheBox) {
  Random random(1);
  const cmb::Shape cube = mesh_shape(mesh(box_mesh({1, 2, 3}, 3)));
  ASSERT_TRUE(cube.mesh_hull);
  cmb::Shape box;
  box.kind = cmb::ShapeKind::box;
  box.body = cmb::convex::make_box({1, 2, 3});
  box.polytope = std::make_shared<const cmb::ContactPolytope>(Polytope::box({1, 2, 3}));
  for (int i = 0; i < 500; ++i) {
    const Pose pose{random_rotation(random), {0, 0, random.uniform(0.3, 2.0)}};
    const cmb::Plane plane{{0, 0, 1}, 0.0};
    ContactSet a, b;
    mesh_halfspace_contact(cube, pose, plane, a);
    halfspace_contact(box, pose, plane, b);
    ASSERT_NEAR(a.distance, b.distance, 1e-13);
    ASSERT_EQ(a.points.size(), b.points.size());
    const Wrench x = wrench(a), y = wrench(b);
    ASSERT_NEAR(norm(x.force - y.force), 0.0, 1e-12);
    ASSERT_NEAR(norm(x.torque - y.torque), 0.0, 1e-12);
  }
}

TEST(MeshOnHalfspace, FlatSheetRestsOnAllItsVertices) {
  const cmb::Shape sheet = mesh_shape(flat_sheet());
  ASSERT_FALSE(sheet.mesh_hull);
  ContactSet set;
  mesh_halfspace_contact(sheet, {{}, {0, 0, -0.25}}, {{0, 0, 1}, 0.0}, set);
  EXPECT_DOUBLE_EQ(set.distance, -0.25);
  expect_near(wrench(set).force, {0, 0, 0.25}, 1e-14);
  expect_near(wrench(set).torque, {}, 1e-13);
}

// The hull of a fine mesh is found from a choice of its vertices.
TEST(MeshOnHalfspace, FineSphereReachesAsFarAsItsRadius) {
  const TriangleMesh sphere = mesh(sphere_mesh(1.0, 5));
  ASSERT_GT(sphere.vertices().size(), 8192u);
  const auto hull = cmb::make_mesh_hull(sphere);
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    const Vec3 d = random_rotation(random).column(0);
    const double reach = dot(d, hull->geometry().vertices()[static_cast<std::size_t>(hull->geometry().support_vertex(d))]);
    ASSERT_LE(reach, 1.0 + 1e-12);
    ASSERT_GT(reach, 0.998);
  }
}

// Balls.

TEST(BallOnMesh, CubeIsTheBoxAwayFromConcavity) {
  Random random(2);
  const TriangleMesh cube = mesh(box_mesh({1, 2, 3}, 2));
  cmb::convex::DistanceScratch scratch;
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose pose{random_rotation(random), random.direction()};
    const Vec3 center = random.uniform(0.8, 2.2) * random.direction() + pose.translation;
    const double radius = random.uniform(0.2, 0.6);
    const ContactSet set = ball(center, radius, cube, pose);
    const auto reference = signed_distance(cmb::convex::make_sphere(radius), cmb::convex::make_box({1, 2, 3}),
                                           {pose.rotation, pose.translation - center}, scratch);
    ASSERT_NEAR(set.distance, reference.distance, 1e-13);
    ASSERT_NEAR(norm(set.normal - reference.normal), 0.0, 1e-7);
    ASSERT_NEAR(norm(set.witness - center - 0.5 * (reference.point_a + reference.point_b)), 0.0, 1e-7);
    if (set.distance >= 0.0) {
      ASSERT_TRUE(set.points.empty());
      continue;
    }
    ++touching;
    ASSERT_EQ(set.points.size(), 1u);  // a convex body has one nearest place
    ASSERT_NEAR(set.points[0].depth, -reference.distance, 1e-13);
    ASSERT_NEAR(set.points[0].weight, 1.0, 1e-12);
    ASSERT_NEAR(norm(set.points[0].normal - reference.normal), 0.0, 1e-7);
  }
  EXPECT_GT(touching, 200);
}

TEST(BallOnMesh, RollsOverATriangulatedPlaneWithoutBumps) {
  const TriangleMesh sheet = flat_sheet();
  Random random(3);
  for (int i = 0; i <= 20000; ++i) {
    // Along grid lines, along diagonals, through vertices, and anywhere.
    double x = -1.8 + 3.6 * i / 20000.0, y = 0.0;
    if (i % 4 == 1) y = x;
    if (i % 4 == 2) y = 2.0 / 9.0;
    if (i % 4 == 3) y = random.uniform(-1.8, 1.8);
    const ContactSet set = ball({x, y, 0.4}, 0.5, sheet);
    ASSERT_EQ(set.points.size(), 1u) << x << " " << y;
    ASSERT_NEAR(set.distance, -0.1, 1e-15);
    ASSERT_NEAR(set.points[0].depth, 0.1, 1e-15);
    ASSERT_NEAR(set.points[0].weight, 1.0, 1e-12);
    ASSERT_NEAR(norm(set.points[0].normal - Vec3{0, 0, 1}), 0.0, 1e-12);
    ASSERT_NEAR(norm(set.points[0].position - Vec3{x, y, -0.05}), 0.0, 1e-12);
  }
}

TEST(BallOnMesh, GrooveCarriesOnBothSides) {
  // Two slopes of 45 degrees that meet in the line x = 0.
  const TriangleMesh groove = mesh(sheet_mesh(4.0, 8, [](double x, double) { return std::fabs(x); }));
  const double radius = 0.5, depth = 0.02;
  const ContactSet set = ball({0, 0.1, (radius - depth) * std::sqrt(2.0)}, radius, groove);
  const Wrench sum = wrench(set);
  // The normals are at right angles: each side carries its whole depth.
  expect_near(sum.force, {0, 0, std::sqrt(2.0) * depth}, 1e-12);
  EXPECT_NEAR(set.distance, -depth, 1e-14);
}

// The largest change of the load vector between neighbouring poses, relative to the step.
template <typename Query>
double roughness(const Query &query, int steps) {
  double most = 0.0;
  Vec3 last = wrench(query(0.0)).force;
  for (int i = 1; i <= steps; ++i) {
    const Vec3 now = wrench(query(static_cast<double>(i) / steps)).force;
    most = std::fmax(most, norm(now - last) * steps);
    last = now;
  }
  return most;
}

TEST(BallOnMesh, LoadIsContinuousOverConcaveTerrain) {
  // If the load jumped, the quotient would grow with the number of steps.
  const TriangleMesh terrain =
      mesh(sheet_mesh(4.0, 12, [](double x, double y) { return 0.15 * std::sin(3 * x) * std::cos(2 * y + x); }));
  const auto query = [&](double s) {
    const double x = -1.5 + 3.0 * s, y = 0.7 * std::sin(4 * s);
    return ball({x, y, 0.36 + 0.15 * std::sin(3 * x) * std::cos(2 * y + x)}, 0.4, terrain);
  };
  const double coarse = roughness(query, 2000), fine = roughness(query, 32000);
  EXPECT_GT(coarse, 0.01);
  EXPECT_LT(fine, 1.5 * coarse + 0.2);
  RecordProperty("roughness", std::to_string(coarse) + " " + std::to_string(fine));
}

TEST(BallOnMesh, LoadIsContinuousFromFloorToWall) {
  for (const double slope : {0.05, 0.3, 1.0, 5.0, -0.3, -2.0}) {
    const TriangleMesh bend = mesh(sheet_mesh(4.0, 8, [&](double x, double) { return slope * std::fmax(0.0, x); }));
    // Up to where the slope is half a radius deep.
    const double end = slope > 0.0 ? std::fmin(0.4, (0.35 - 0.25 * std::hypot(1.0, slope)) / slope) : 0.4;
    const auto query = [&](double s) { return ball({-0.6 + (end + 0.6) * s, 0.03, 0.45 - 0.1 * s}, 0.5, bend); };
    const double coarse = roughness(query, 1000), fine = roughness(query, 16000);
    EXPECT_LT(fine, 1.2 * coarse + 0.1) << slope << " " << coarse << " " << fine;
  }
}

TEST(BallOnMesh, BallPassesASheetFromBehindWithoutAJump) {
  const TriangleMesh sheet = flat_sheet();
  const auto query = [&](double s) { return ball({0.1, 0.2, -0.7 + 1.4 * s}, 0.5, sheet); };
  EXPECT_LT(roughness(query, 16000), 1.41);  // its rate of change is the speed
}

// Capsules.

// What a capsule stores is 21/16 of the integral of the depth's cube by that of the depth, over what lies below the plane: so lying it carries its
// depth. Of a segment of the cylinder and a cap of the ball, d deep, these integrals:
struct Sunk {
  double depth, cube;
  double energy() const { return 21.0 / 16.0 * cube / depth; }
};
Sunk segment(double radius, double d) {  // by length; depth d - radius (1 - cos u) on the chord at angle u
  Sunk sum{};
  const double most = std::acos(1.0 - d / radius);
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double u = most * (i + 0.5) / steps, z = radius * (1.0 - std::cos(u)), sine = std::sin(u);
    const double area = 2.0 * radius * sine * radius * sine * most / steps;
    sum.depth += (d - z) * area, sum.cube += (d - z) * (d - z) * (d - z) * area;
  }
  return sum;
}
Sunk cap(double radius, double d) {
  constexpr double pi = 3.14159265358979323846;
  const double d3 = d * d * d;
  return {pi * d3 * (radius / 3.0 - d / 12.0), pi * d3 * d * d * (radius / 10.0 - d / 60.0)};
}

TEST(CapsuleOnMesh, CarriesItsDepthLyingAndLessStanding) {
  const TriangleMesh sheet = flat_sheet();
  const double radius = 0.2, length = 1.0;
  const auto energy = [&](double d, bool lying) {
    const Sunk ball = cap(radius, d), side = segment(radius, d);
    const double part = lying ? length : 0.0;
    return Sunk{ball.depth + part * side.depth, ball.cube + part * side.cube}.energy();
  };
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const bool lying = i % 2 == 0;
    const double d = random.log_uniform(1e-5, 0.1), step = 1e-4 * d;
    Pose body;
    if (lying) body.rotation = rotation_about({0, 1, 0}, 0.5 * 3.14159265358979323846);
    body.rotation = transposed(body.rotation);
    body.translation = {random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), radius + (lying ? 0.0 : 0.5 * length) - d};
    const ContactSet set = capsule(radius, length, body, sheet);
    ASSERT_NEAR(set.distance, -d, 1e-13);
    const double load = (energy(d + step, lying) - energy(d - step, lying)) / (2.0 * step);
    const Wrench sum = wrench(set);
    ASSERT_NEAR(norm(sum.force - Vec3{0, 0, load}), 0.0, 1e-6 * load) << d;
    ASSERT_NEAR(norm(sum.torque - cross(body.translation, Vec3{0, 0, load})), 0.0, 1e-6 * load) << d;
    ASSERT_NEAR(load, (lying ? 1.0 : 63.0 / 80.0) * d, (0.01 + d / radius) * d);
  }
}

TEST(CapsuleOnMesh, RidgeCarriesTheMiddle) {
  const TriangleMesh ridge = mesh(sheet_mesh(4.0, 8, [](double x, double) { return -std::fabs(x); }));
  // Axis along x, across the ridge, the ends clear of the slopes.
  Pose body{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}, {0.0, 0.1, 0.17}};
  const ContactSet set = capsule(0.2, 2.0, body, ridge);
  // Below slopes of 45 degrees a place is by the square root of 2 less deep than straight below.
  const auto energy = [](double d) {
    Sunk sum{};
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) {
      const Sunk slice = segment(0.2, d * (i + 0.5) / steps);
      sum.depth += std::sqrt(0.5) * slice.depth, sum.cube += std::sqrt(0.125) * slice.cube;
    }
    return sum.energy();
  };
  expect_near(wrench(set).force, {0, 0, (energy(0.0301) - energy(0.0299)) / 2e-4}, 1e-6);
  const auto query = [&](double s) {
    body.translation = {-2.0 * s + 1.0, 0.1, 0.17};
    return capsule(0.2, 1.0, body, ridge);
  };
  const double coarse = roughness(query, 1000), fine = roughness(query, 16000);
  EXPECT_LT(fine, 1.2 * coarse + 0.1);
}

// However a cube's faces are cut, and tilted by rounding or by more; but for the edge, whose slope is nearer to it, as in the middle.
TEST(CapsuleOnMesh, HangingOverAnEdgeCarriesWhatItDoesOnTheFace) {
  double first = 0.0;
  for (const std::uint32_t cells : {1u, 3u, 4u}) {
    const TriangleMesh cube = mesh(box_mesh({1, 1, 1}, cells));
    for (const double tilt : {0.0, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8}) {
      for (const double sense : {1.0, -1.0}) {
        for (const double beside : {0.0, 0.07}) {
          const Pose body{rotation_about({0, 1, 0}, 0.5 * 3.14159265358979323846 + sense * tilt), {0.4, beside, 0.599}};
          const ContactSet set = capsule(0.1, 0.6, body, cube);
          const double load = wrench(set).force.z;
          if (first == 0.0) first = load;
          EXPECT_NEAR(set.distance, -0.001, 1e-8);
          EXPECT_NEAR(load, 0.001, 2e-5);
          EXPECT_NEAR(load, first, 1e-10 + 0.5 * tilt) << cells << " cells, tilted by " << sense * tilt;
        }
      }
    }
  }
}

TEST(CapsuleOnMesh, LoadDoesNotDependOnTheTrianglesOfAFace) {
  Random random(7);
  const TriangleMesh coarse = mesh(box_mesh({1, 0.8, 0.6}, 1)), fine = mesh(box_mesh({1, 0.8, 0.6}, 4));
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pose pose{i % 2 == 0 ? rotation_about(normalized(Vec3{1, random.uniform(-1, 1), 0}), 1.5707963267948966)
                               : random_rotation(random),
                    {random.uniform(-0.7, 0.7), random.uniform(-0.6, 0.6), random.uniform(0.37, 0.6)}};
    const ContactSet set = capsule(0.1, 0.4, pose, coarse);
    if (set.distance >= 0.0 || set.distance < -0.05) continue;
    ++touching;
    const Wrench a = wrench(set), b = wrench(capsule(0.1, 0.4, pose, fine));
    ASSERT_NEAR(norm(a.force - b.force), 0.0, 1e-9) << i;
    ASSERT_NEAR(norm(a.torque - b.torque), 0.0, 1e-9) << i;
  }
  EXPECT_GT(touching, 300);
}

// Convex polytopes.

TEST(BoxOnMesh, RestsOnATriangulatedPlaneWithTheBoxsLoad) {
  const TriangleMesh sheet = flat_sheet();
  Random random(5);
  const Polytope box = Polytope::box({1.0, 0.8, 0.4});
  for (int i = 0; i < 300; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), depth = random.log_uniform(1e-6, 0.1);
    const Pose pose{rotation_about({0, 0, 1}, i % 5 == 0 ? 0.0 : random.uniform(-3, 3)), {x, y, 0.2 - depth}};
    const ContactSet set = polytope(box, pose, sheet);
    ASSERT_NEAR(set.distance, -depth, 1e-14);
    ASSERT_GE(set.points.size(), 3u);
    ASSERT_LE(set.points.size(), 64u);
    const Wrench sum = wrench(set);
    ASSERT_NEAR(norm(sum.force - Vec3{0, 0, depth}), 0.0, 1e-12 * depth + 1e-15);
    ASSERT_NEAR(norm(sum.torque - cross(Vec3{x, y, 0}, Vec3{0, 0, depth})), 0.0, 1e-12 * depth + 1e-15);
    for (const ContactPoint &p : set.points) {
      ASSERT_NEAR(p.depth, depth, 1e-12);
      ASSERT_NEAR(p.position.z, -0.5 * depth, 1e-12);
      ASSERT_EQ(p.normal.z, 1.0);
    }
  }
}

TEST(BoxOnMesh, LoadDoesNotDependOnTheTrianglesOfAFace) {
  Random random(6);
  const Polytope box = Polytope::box({1.0, 0.8, 0.4});
  const TriangleMesh coarse = mesh(box_mesh({4, 4, 2}, 1)), fine = mesh(box_mesh({4, 4, 2}, 9));
  for (int i = 0; i < 200; ++i) {
    const Pose pose{rotation_about(random.direction(), random.uniform(-0.2, 0.2)),
                    {random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1), 1.18}};
    const Wrench a = wrench(polytope(box, pose, coarse)), b = wrench(polytope(box, pose, fine));
    ASSERT_NEAR(norm(a.force - b.force), 0.0, 1e-10);
    ASSERT_NEAR(norm(a.torque - b.torque), 0.0, 1e-10);
  }
}

// On faces, over edges and corners, of 12 triangles against 108 and 192.
TEST(BodiesOnMeshes, LoadAndDepthDoNotDependOnTheTrianglesOfAFace) {
  const TriangleMesh coarse = mesh(box_mesh({1, 1, 1}, 1));
  const Polytope box = Polytope::box({0.6, 0.5, 0.4});
  const cmb::convex::ConvexBody round[] = {cmb::convex::make_cylinder(0.2, 0.5), cmb::convex::make_cone(0.25, 0.5),
                                           cmb::convex::make_ellipsoid({0.2, 0.25, 0.3})};
  for (const std::uint32_t cells : {3u, 4u}) {
    const TriangleMesh fine = mesh(box_mesh({1, 1, 1}, cells));
    for (std::size_t kind = 0; kind < 4; ++kind) {
      Random random(12 + kind);
      int touching = 0;
      for (int i = 0; i < 300; ++i) {
        const Pose pose{random_rotation(random), random.uniform(0.6, 1.0) * random.direction()};
        const auto query = [&](const TriangleMesh &ground) {
          static MeshContactScratch scratch;
          ContactSet set;
          if (kind == 0) {
            polytope_contact(box, pose, ground, {}, scratch, set);
          } else {
            smooth_contact(round[kind - 1], pose, ground, {}, scratch, set);
          }
          return set;
        };
        const ContactSet a = query(coarse), b = query(fine);
        if (a.distance >= 0.0 || a.distance < -0.1) continue;
        ++touching;
        const Wrench on_coarse = wrench(a), on_fine = wrench(b);
        // Round bodies' surfaces are integrated by rules, and parted 1e-11 of their radius beside where triangles meet.
        const double rounding = kind == 0 ? 1e-12 : 1e-9;
        ASSERT_NEAR(a.distance, b.distance, kind == 0 ? 1e-13 : 1e-11) << kind << " " << i;
        ASSERT_NEAR(norm(on_coarse.force - on_fine.force), 0.0, rounding) << kind << " " << i;
        ASSERT_NEAR(norm(on_coarse.torque - on_fine.torque), 0.0, rounding) << kind << " " << i;
      }
      EXPECT_GT(touching, 40) << kind;
    }
  }
}

TEST(BoxOnMesh, CubeGivesTheBoxsDistanceWhereApart) {
  Random random(8);
  const TriangleMesh cube = mesh(box_mesh({1, 2, 3}, 2));
  const Vec3 size{0.7, 0.5, 0.9};
  const Polytope box = Polytope::box(size);
  cmb::convex::DistanceScratch scratch;
  int apart = 0;
  for (int i = 0; i < 1000; ++i) {
    const Pose pose{i % 4 == 0 ? Mat3{} : random_rotation(random), random.uniform(0.5, 3.5) * random.direction()};
    const auto reference = signed_distance(cmb::convex::make_box(size), cmb::convex::make_box({1, 2, 3}), pose.inverse(), scratch);
    const ContactSet set = polytope(box, pose, cube);
    if (reference.distance > 0.0) {
      ++apart;
      ASSERT_NEAR(set.distance, reference.distance, 1e-12);
      ASSERT_NEAR(norm(set.normal - pose.rotation * reference.normal), 0.0, 1e-6);
      ASSERT_TRUE(set.points.empty());
    }
  }
  EXPECT_GT(apart, 300);
}

TEST(BoxOnMesh, CubeGivesTheBoxsDepthOnFaces) {
  // Shallow, near the middle of a face: the least translation is along its normal.
  Random random(9);
  const TriangleMesh cube = mesh(box_mesh({2, 2, 2}, 3));
  const Vec3 size{0.7, 0.5, 0.9};
  const Polytope box = Polytope::box(size);
  cmb::convex::DistanceScratch scratch;
  for (int i = 0; i < 500; ++i) {
    Pose pose{random_rotation(random), {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0}};
    const auto lowest = core_support(cmb::convex::make_box(size), transposed_times(pose.rotation, {0, 0, -1}));
    const double depth = random.log_uniform(1e-4, 0.05);
    pose.translation.z = 1.0 - depth - (pose.rotation * lowest.point).z;
    const auto reference = signed_distance(cmb::convex::make_box(size), cmb::convex::make_box({2, 2, 2}), pose.inverse(), scratch);
    const ContactSet set = polytope(box, pose, cube);
    ASSERT_NEAR(set.distance, reference.distance, 1e-12);
    ASSERT_NEAR(norm(set.normal - Vec3{0, 0, 1}), 0.0, 1e-12);
    const Wrench sum = wrench(set);
    ASSERT_GT(sum.load, 0.2 * depth);
    ASSERT_LE(sum.load, depth * (1.0 + 1e-12));
    ASSERT_NEAR(norm(sum.force - Vec3{0, 0, sum.load}), 0.0, 1e-12);
  }
}

// The side of the cube is nearer than its top to what lies within the depth of their edge, and so this stores less: of an overlap of
// length l and depth d, d^2 N / D with N = l / 4 - 3 d / 20 and D = l / 2 - d / 6. That is pushed off the edge by as little as it must.
TEST(BoxOnMesh, OverhangingBoxIsPushedSidewaysByCubeOfDepthBySquareOfOverlap) {
  const TriangleMesh cube = mesh(box_mesh({2, 2, 2}, 3));
  const Polytope box = Polytope::box({1, 1, 1});
  const double depth = 0.01;
  for (const double x : {0.6, 0.9, 1.0, 1.3}) {
    const ContactSet set = polytope(box, {{}, {x, 0.1, 1.5 - depth}}, cube);
    const Wrench sum = wrench(set);
    const double overlap = 1.5 - x;
    const double top = overlap / 4.0 - 0.15 * depth, base = overlap / 2.0 - depth / 6.0;
    EXPECT_NEAR(sum.force.z, depth * (2.0 * top + depth * (top / (6.0 * base) - 0.15)) / base, 1e-12);
    EXPECT_NEAR(sum.force.x, depth * depth * depth / (30.0 * base * base), 1e-12);
    EXPECT_NEAR(sum.force.y, 0.0, 1e-15);
  }
}

TEST(BoxOnMesh, LoadIsContinuous) {
  const TriangleMesh cube = mesh(box_mesh({2, 2, 2}, 2)), ball_mesh = mesh(sphere_mesh(1.0, 2));
  const TriangleMesh terrain =
      mesh(sheet_mesh(4.0, 12, [](double x, double y) { return 0.1 * std::sin(3 * x) * std::cos(2 * y + x) - 0.3; }));
  const Polytope box = Polytope::box({0.6, 0.5, 0.4});
  const Mat3 turned = rotation_about(cmb::convex::normalized({1, 2, 0.5}), 0.3);
  struct Case {
    const TriangleMesh *mesh;
    Vec3 from, to;
  };
  const Case cases[] = {{&cube, {-1.4, 0.2, 1.25}, {1.4, 0.3, 1.18}},
                        {&ball_mesh, {-0.3, 0.1, 1.3}, {0.3, 0.0, 1.15}},
                        {&terrain, {-1.3, 0.5, 0.05}, {1.3, -0.4, -0.05}}};
  for (const Case &c : cases) {
    const auto query = [&](double s) {
      return polytope(box, {turned, c.from + s * (c.to - c.from)}, *c.mesh);
    };
    const double coarse = roughness(query, 500), fine = roughness(query, 8000);
    EXPECT_GT(coarse, 0.001);
    EXPECT_LT(fine, 1.5 * coarse + 0.2) << coarse << " " << fine;
  }
}

TEST(BoxOnMesh, ThinWallPushesFromItsNearSideOnly) {
  const TriangleMesh wall = mesh(box_mesh({4, 4, 0.1}, 4));
  const Polytope box = Polytope::box({0.5, 0.5, 0.5});
  expect_near(wrench(polytope(box, {{}, {0, 0, 0.29}}, wall)).force, {0, 0, 0.01}, 1e-13);
  expect_near(wrench(polytope(box, {{}, {0, 0, -0.29}}, wall)).force, {0, 0, -0.01}, 1e-13);
  EXPECT_EQ(wrench(polytope(box, {{}, {0, 0, 0.31}}, wall)).load, 0.0);
}

TEST(BoxOnMesh, SteppedPlateDoesNotPushBelowItsThinPart) {
  // A tread: triangles of the top reach from the thick part to the thin one.
  MeshData data;
  const double outline[6][2] = {{-2, -2}, {0, -2}, {0, -0.1}, {2, -0.1}, {2, 0}, {-2, 0}};
  for (const double y : {-1.0, 1.0}) {
    for (const auto &p : outline) data.vertices.push_back({p[0], y, p[1]});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    data.triangles.push_back({i, i + 6, j + 6});
    data.triangles.push_back({i, j + 6, j});
  }
  for (const Triangle &cap : {Triangle{0, 1, 2}, Triangle{0, 2, 5}, Triangle{2, 3, 4}, Triangle{2, 4, 5}}) {
    data.triangles.push_back(cap);
    data.triangles.push_back({cap[0] + 6, cap[2] + 6, cap[1] + 6});
  }
  double volume = 0.0;
  for (const Triangle &t : data.triangles) volume += dot(data.vertices[t[0]], cross(data.vertices[t[1]], data.vertices[t[2]]));
  if (volume < 0.0) {
    for (Triangle &t : data.triangles) std::swap(t[0], t[1]);
  }
  const TriangleMesh tread = mesh(std::move(data));
  const Polytope box = Polytope::box({0.3, 0.3, 0.3});
  const ContactSet set = polytope(box, {{}, {0.5, 0, -0.4}}, tread);
  EXPECT_NEAR(set.distance, 0.15, 1e-14);
  EXPECT_TRUE(set.points.empty());
}

TEST(MeshContact, FollowsThePose) {
  // Moving both bodies moves the answer.
  Random random(10);
  const TriangleMesh cube = mesh(box_mesh({1, 2, 3}, 2));
  const Polytope box = Polytope::box({0.7, 0.5, 0.9});
  for (int i = 0; i < 100; ++i) {
    const Pose body{random_rotation(random), random.uniform(0.8, 1.2) * random.direction()};
    const Pose move{random_rotation(random), random.direction()};
    const Mat3 moved_axes{{move.rotation * body.rotation.column(0), move.rotation * body.rotation.column(1),
                           move.rotation * body.rotation.column(2)}};
    const Pose moved{transposed(moved_axes), move(body.translation)};
    const ContactSet a = polytope(box, body, cube), b = polytope(box, moved, cube, move);
    ASSERT_NEAR(a.distance, b.distance, 1e-12);
    ASSERT_NEAR(norm(move.rotation * wrench(a).force - wrench(b).force), 0.0, 1e-11);
  }
}

}  // namespace
}  // namespace test_mesh_contact
