// Distances of triangles and convex bodies, of meshes and bodies apart, and which wedges a round body may reach.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/contact/mesh_contact.hpp"
#include "mesh/contact/polytope_distance.hpp"
#include "mesh/contact/triangle_convex_distance.hpp"
#include "mesh/wedges/triangle_wedge.hpp"
#include "shape/convex_hull.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_triangle_convex_distance {
namespace {

using namespace cmb::mesh;
using namespace cmb::convex;

const ConvexBody bodies[] = {make_ellipsoid({0.5, 0.3, 0.2}), make_cylinder(0.3, 0.8), make_cone(0.4, 0.7)};

// How far p is from the triangle.
double off_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  return norm(p - nearest_on_triangle(p, a, b, c).point);
}

// How far p reaches beyond the body along the directions of a grid: 0 for points of the body.
double off_body(const Vec3 &p, const ConvexBody &body, const Pose &pose) {
  random_bodies::Random random(5);
  const Vec3 local = transposed_times(pose.rotation, p - pose.translation);
  double most = 0.0;
  for (int k = 0; k < 300; ++k) {
    const Vec3 d = random.direction();
    most = std::fmax(most, dot(d, local) - dot(d, core_support(body, d).point));
  }
  return most;
}

TEST(ConvexGap, PointsLieOnBothAndAreAsFarApartAsItSays) {
  random_bodies::Random random(2);
  int touching = 0, apart = 0;
  for (int k = 0; k < 6000; ++k) {
    const ConvexBody &body = bodies[k % 3];
    Pose pose{random_bodies::random_rotation(random), random.uniform(0.0, 1.2) * random.direction()};
    if (k % 5 == 0) pose.rotation = Mat3{};
    const double scale = random.log_uniform(0.01, 3.0);
    const Vec3 a = scale * random.direction(), b = scale * random.direction(), c = scale * random.direction();
    const double infinity = std::numeric_limits<double>::infinity();
    const TriangleGap gap = triangle_convex_gap(a, b, c, body, pose, infinity);
    ASSERT_LT(off_triangle(gap.on_triangle, a, b, c), 1e-9) << k;
    if (k < 600) {
      ASSERT_LT(off_body(gap.on_body, body, pose), 1e-9) << k;
    }
    if (gap.distance > 0.0) {
      ++apart;
      ASSERT_NEAR(norm(gap.on_triangle - gap.on_body), gap.distance, 1e-9) << k;
      // The plane across the gap parts the two.
      const Vec3 d = (1.0 / gap.distance) * (gap.on_triangle - gap.on_body);
      const Vec3 local = transposed_times(pose.rotation, d);
      const double reach = dot(d, pose.translation) + dot(local, core_support(body, local).point);
      ASSERT_NEAR(std::fmin(dot(d, a), std::fmin(dot(d, b), dot(d, c))) - reach, gap.distance, 1e-6) << k;
      // Moved together until they touch: the points stay where the bodies meet.
      pose.translation = pose.translation + gap.distance * d;
      const TriangleGap meeting = triangle_convex_gap(a, b, c, body, pose, infinity);
      ASSERT_LT(meeting.distance, 1e-6) << k;
      ASSERT_LT(off_triangle(meeting.on_triangle, a, b, c), 1e-9) << k;
      if (k < 600) {
        ASSERT_LT(off_body(meeting.on_triangle, body, pose), 1e-6) << k;
      }
    } else {
      ++touching;
    }
  }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(apart, 1000);
}

// A cylinder's rim 2e-6 m from an edge: the search meets a tetrahedron so flat that by rounding it seems to hold the origin.
// The reference is the distance to the ball of triangles that this one is of, as a hull (`narrowphase/convex_distance.hpp`).
TEST(ConvexGap, FlatTetrahedraDoNotMakeBodiesMeet) {
  const Vec3 a{0x0p+0, -0x1.5db10e004ed4bp-3, 0x1.1ae80dfa49ff6p-2};
  const Vec3 b{-0x1.9b164fba3c652p-4, -0x1.0d0f5e7afd928p-2, 0x1.4c939518dcf26p-3};
  const Vec3 c{0x1.9b164fba3c652p-4, -0x1.0d0f5e7afd928p-2, 0x1.4c939518dcf26p-3};
  const Pose pose{{{{-0x1.44bd0ce5ff187p-2, 0x1.af187de8f3e76p-2, 0x1.b31bc3312d7dp-1},
                    {-0x1.35c227e70712bp-3, 0x1.b96c445f39d3ap-1, -0x1.ef25eb13985f9p-2},
                    {-0x1.df5b7251286e3p-1, -0x1.20a509bb09e87p-2, -0x1.ad8b20c5d0ap-3}}},
                  {0x1.054595518d41cp-2, -0x1.24e35f05eaefep-1, 0x1.9d30179764c5p-4}};
  const ConvexBody cylinder = make_cylinder(0.1, 2.0);
  const double enough[] = {2.0993755777948345e-06, 1.0, std::numeric_limits<double>::infinity()};
  for (const double e : enough) {
    for (int turn = 0; turn < 3; ++turn) {
      const Vec3 corner[3] = {a, b, c};
      const TriangleGap gap = triangle_convex_gap(corner[turn], corner[(turn + 1) % 3], corner[(turn + 2) % 3], cylinder, pose, e);
      EXPECT_NEAR(gap.distance, 2.0993695676682222e-06, 1.5e-7) << e << ' ' << turn;
    }
  }
}

// Balls about places of a wedge, drawn from a large box cut by the wedge's planes, meet its hull; those well outside do not.
TEST(WedgeHull, HoldsWhatLiesInTheWedge) {
  random_bodies::Random random(7);
  double xs[] = {0, 2, 2, 1, 1, 0}, ys[] = {0, 0, 1, 1, 2, 2};
  const TriangleMesh meshes[] = {mesh_samples::mesh(mesh_samples::sphere_mesh(0.5, 2)),
                                 mesh_samples::mesh(mesh_samples::box_mesh({0.6, 0.8, 1.0}, 2)),
                                 mesh_samples::mesh(mesh_samples::angle_prism(xs, ys, 0.0, 1.0))};
  int within = 0, parted = 0;
  std::vector<Vec3> polygon, room;
  for (const TriangleMesh &mesh : meshes) {
    for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
      const TriangleWedge wedge(mesh, t, 0.4);
      Vec3 corner[6];
      if (!wedge.hull(corner)) continue;
      for (int k = 0; k < 40; ++k) {
        const Vec3 u = random.direction(), v = normalized(cross(u, random.direction())), w = cross(u, v);
        const Vec3 middle = mesh.corner(t, 0) + random.uniform(0.0, 0.5) * random.direction();
        polygon = {middle + 9.0 * v, middle + 9.0 * w, middle - 9.0 * v, middle - 9.0 * w};
        wedge.clip(polygon, room);
        for (const Vec3 &p : polygon) {
          ++within;
          EXPECT_FALSE(are_parted(corner, make_ellipsoid({1e-6, 1e-6, 1e-6}), {Mat3{}, p})) << t;
        }
        const Vec3 outside = mesh.corner(t, 0) + random.uniform(0.01, 1.0) * mesh.face_normal(t);
        parted += are_parted(corner, make_ellipsoid({1e-6, 1e-6, 1e-6}), {Mat3{}, outside});
      }
    }
  }
  EXPECT_GT(within, 10000);
  EXPECT_GT(parted, 10000);
}

// A body apart from a mesh is as far as from the nearest of all its triangles.
TEST(ApartFromMesh, NoTriangleIsNearer) {
  random_bodies::Random random(3);
  double xs[] = {0, 2, 2, 1, 1, 0}, ys[] = {0, 0, 1, 1, 2, 2};
  const TriangleMesh meshes[] = {mesh_samples::mesh(mesh_samples::sphere_mesh(0.5, 3)),
                                 mesh_samples::mesh(mesh_samples::box_mesh({0.6, 0.8, 1.0}, 4)),
                                 mesh_samples::mesh(mesh_samples::angle_prism(xs, ys, 0.0, 1.0))};
  MeshContactScratch scratch;
  int apart = 0;
  for (int k = 0; k < 360; ++k) {
    const TriangleMesh &mesh = meshes[k % 3];
    const ConvexBody &body = bodies[(k / 3) % 3];
    const Pose pose{random_bodies::random_rotation(random), random.uniform(0.0, 2.5) * random.direction()};
    cmb::ContactSet contact;
    smooth_contact(body, pose, mesh, {}, scratch, contact);
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
      least = std::fmin(least, triangle_convex_gap(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), body, pose, least).distance);
    }
    if (!(least > 0.0) || (mesh.nearest(pose.translation).distance < 0.0)) {
      EXPECT_LE(contact.distance, 0.0) << k;
      continue;
    }
    ++apart;
    EXPECT_NEAR(contact.distance, least, 1e-7) << k;
    EXPECT_TRUE(contact.points.empty()) << k;
  }
  EXPECT_GT(apart, 150);
}

// The same of hulls and boxes, to rounding; each triangle exactly.
TEST(ApartFromMesh, NoTriangleIsNearerToPolytopes) {
  random_bodies::Random random(4);
  double xs[] = {0, 2, 2, 1, 1, 0}, ys[] = {0, 0, 1, 1, 2, 2};
  const TriangleMesh meshes[] = {mesh_samples::mesh(mesh_samples::sphere_mesh(0.5, 2)),
                                 mesh_samples::mesh(mesh_samples::box_mesh({0.6, 0.8, 1.0}, 3)),
                                 mesh_samples::mesh(mesh_samples::angle_prism(xs, ys, 0.0, 1.0))};
  MeshContactScratch scratch;
  int apart = 0;
  for (int k = 0; k < 300; ++k) {
    const TriangleMesh &mesh = meshes[k % 3];
    Polytope body = Polytope::box({0.2, 0.3, 0.5});
    const Vec3 size{random.log_uniform(1e-2, 0.5), 0.4, 0.5};
    if (k % 2 == 0) {
      ASSERT_TRUE(build_convex_hull(random_bodies::random_points(random, random.integer(5, 40), size, false), body, nullptr, nullptr));
    }
    Pose pose{random_bodies::random_rotation(random), random.uniform(0.0, 2.5) * random.direction()};
    if (k % 5 == 0) pose.rotation = Mat3{};  // flush
    cmb::ContactSet contact;
    polytope_contact(body, pose, mesh, {}, scratch, contact);
    std::vector<Vec3> vertices, normals, polygon, room;
    for (const Vec3 &v : body.vertices()) vertices.push_back(pose(v));
    for (const auto &face : body.faces()) normals.push_back(pose.rotation * face.normal);
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
      least = std::fmin(least, triangle_polytope_distance(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), body, vertices,
                                                          normals, polygon, room).distance);
    }
    if (!(least > 0.0) || mesh.nearest(vertices[0]).distance < 0.0) {
      EXPECT_LE(contact.distance, 0.0) << k;
      continue;
    }
    ++apart;
    EXPECT_NEAR(contact.distance, least, 1e-12) << k;
    EXPECT_TRUE(contact.points.empty()) << k;
  }
  EXPECT_GT(apart, 120);
}

// Where rounding ends the search of bodies that nearly touch, nearly flush, a bound above what is enough proves nothing.
TEST(TrianglePolytopeGap, ProvesOnlyWhatItIsOrThatItIsEnough) {
  random_bodies::Random random(31);
  const Polytope body = Polytope::box({1.0, 0.4, 0.8});
  int proofs = 0, parted = 0;
  for (int k = 0; k < 20000; ++k) {
    // A triangle hardly above the box's upper face or, turned, above one of that face's edges.
    const double tilt = random.log_uniform(1e-10, 1e-6), gap = random.log_uniform(1e-10, 1e-7);
    const double spin = random.uniform(-3.0, 3.0), aside = k % 2 == 0 ? random.uniform(-0.7, 0.7) : 0.5;
    const Mat3 turned = random_bodies::rotation_about(random.direction(), tilt);
    const auto place = [&](double x, double y) {
      const Vec3 flat{x * std::cos(spin) - y * std::sin(spin) + aside, x * std::sin(spin) + y * std::cos(spin), 0.4 + gap};
      return turned * flat;
    };
    const Vec3 a = place(-0.4, -0.3), b = place(0.5, -0.2), c = place(0.1, 0.4);
    const Pose frame{random_bodies::random_rotation(random), random.direction()};
    std::vector<Vec3> vertices, normals, polygon, room;
    for (const Vec3 &v : body.vertices()) vertices.push_back(frame(v));
    for (const auto &face : body.faces()) normals.push_back(frame.rotation * face.normal);
    const double exact =
        triangle_polytope_distance(frame(a), frame(b), frame(c), body, vertices, normals, polygon, room).distance;
    const double enough = exact * random.uniform(0.3, 6.0);
    bool proven;
    Vec3 parting;
    const TriangleGap found = triangle_polytope_gap(frame(a), frame(b), frame(c), body, frame, enough, proven, parting);
    if (!proven) continue;
    ++proofs;
    if (exact <= enough) {
      ASSERT_NEAR(found.distance, exact, 1e-12) << "sample " << k << ", tilt " << tilt << ", gap " << gap;
    } else {
      ASSERT_GT(found.distance, enough - 1e-15) << "sample " << k;
      // The body is beyond the triangle along the parting direction by what is enough.
      ASSERT_NEAR(norm(parting), 1.0, 1e-12) << "sample " << k;
      double lowest = dot(parting, vertices[0]);
      for (const Vec3 &v : vertices) lowest = std::fmin(lowest, dot(parting, v));
      for (const Vec3 &p : {a, b, c}) ASSERT_GT(lowest - dot(parting, frame(p)), enough - 1e-14) << "sample " << k;
      ++parted;
    }
  }
  EXPECT_GT(proofs, 400);
  EXPECT_GT(parted, 100);
}

}  // namespace
}  // namespace test_triangle_convex_distance
