// Triangle meshes: refusal of bad ones, mass properties against closed forms, nearest points against brute force.
#include <gtest/gtest.h>

#include <limits>

#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_triangle_mesh {
namespace {

using namespace mesh_samples;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;

void expect_near(const Vec3 &a, const Vec3 &b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// The message of the refusal; a test failure where there is none.
std::string refusal(const MeshData &data, MeshUse use = MeshUse::any) {
  try {
    cmb::mesh::check_mesh(data, use, "part.stl");
  } catch (const cmb::mesh::MeshError &error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted";
  return "";
}

void expect_refusal(const std::string &message, const std::string &part) {
  EXPECT_EQ(message.find("part.stl: "), 0u) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_NE(message.find("; "), std::string::npos) << "no remedy: " << message;
}

TEST(MeshCheck, AcceptsSolidsAndSheets) {
  EXPECT_NO_THROW(cmb::mesh::check_mesh(box_mesh({1, 2, 3}, 4), MeshUse::solid, "box"));
  EXPECT_NO_THROW(cmb::mesh::check_mesh(sheet_mesh(1, 3, [](double, double) { return 0.0; }), MeshUse::any, "sheet"));
}

TEST(MeshCheck, RefusesNumbersThatAreNone) {
  MeshData data = box_mesh({1, 1, 1});
  data.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(refusal(data), "vertex 3 has a coordinate that is not a finite number");
  EXPECT_THROW(cmb::mesh::weld_vertices(data, "part.stl"), cmb::mesh::MeshError);
  data.vertices[2].y = 1e12;
  expect_refusal(refusal(data), "vertex 3 lies farther");
}

TEST(MeshCheck, RefusesNumbersOutOfRange) {
  MeshData data = box_mesh({1, 1, 1});
  data.triangles[4][1] = 8;
  expect_refusal(refusal(data), "triangle 5 names vertex 9 of 8");
  EXPECT_THROW(cmb::mesh::weld_vertices(data, "part.stl"), cmb::mesh::MeshError);
}

TEST(MeshCheck, RefusesEmptyMeshes) { expect_refusal(refusal({}), "no triangles"); }

TEST(MeshCheck, RefusesTooManyTriangles) {
  MeshData data = box_mesh({1, 1, 1});
  data.triangles.resize(cmb::mesh::MeshLimits::triangles + 1, data.triangles[0]);
  expect_refusal(refusal(data), "5000001 triangles");
}

TEST(MeshCheck, RefusesDegenerateTriangles) {
  MeshData data = box_mesh({1, 1, 1});
  data.triangles.push_back({0, 1, 1});
  expect_refusal(refusal(data), "triangle 13 is degenerate");
  data = box_mesh({1, 1, 1});
  data.vertices.insert(data.vertices.end(), {{5, 0, 0}, {6, 0, 0}, {7, 0, 0}});
  data.triangles.push_back({8, 9, 10});
  expect_refusal(refusal(data), "triangle 13 is degenerate");
}

TEST(MeshCheck, RefusesRepeatedTriangles) {
  MeshData data = box_mesh({1, 1, 1});
  data.triangles.push_back({data.triangles[3][1], data.triangles[3][2], data.triangles[3][0]});
  expect_refusal(refusal(data), "triangle 13 repeats triangle 4");
}

TEST(MeshCheck, RefusesEdgesOfThreeTriangles) {
  MeshData data = box_mesh({1, 1, 1});
  data.vertices.push_back({3, 3, 3});
  data.triangles.push_back({data.triangles[0][0], data.triangles[0][1], 8});
  expect_refusal(refusal(data), "belongs to 3 triangles");
}

TEST(MeshCheck, RefusesInconsistentOrientation) {
  MeshData data = box_mesh({1, 1, 1});
  std::swap(data.triangles[6][0], data.triangles[6][1]);
  expect_refusal(refusal(data), "opposite orientation");
}

TEST(MeshCheck, RefusesMeshesInsideOut) {
  MeshData data = box_mesh({1, 1, 1});
  for (Triangle &t : data.triangles) std::swap(t[0], t[1]);
  expect_refusal(refusal(data), "inside out");
}

TEST(MeshCheck, RefusesClosedMeshesWithoutVolume) {
  // Two sheets with one rim.
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.4, 0.5, 0}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    data.triangles.push_back({k, (k + 1) % 4, 4});
    data.triangles.push_back({(k + 1) % 4, k, 5});
  }
  expect_refusal(refusal(data), "encloses no volume");
}

TEST(MeshCheck, RefusesHolesWhereSolidsAreAskedFor) {
  MeshData data = box_mesh({1, 1, 1});
  data.triangles.pop_back();
  expect_refusal(refusal(data, MeshUse::solid), "boundary");
}

TEST(TriangleMesh, BoxHasItsMassProperties) {
  MeshData data = box_mesh({1, 2, 3}, 3);
  for (Vec3 &p : data.vertices) p = p + Vec3{10, -20, 5};
  const TriangleMesh box = mesh(std::move(data));
  EXPECT_TRUE(box.closed());
  EXPECT_NEAR(box.area(), 22.0, 1e-12);
  const auto &mass = box.mass_properties();
  EXPECT_NEAR(mass.volume, 6.0, 1e-12);
  expect_near(mass.centroid, {10, -20, 5}, 1e-12);
  expect_near(mass.inertia.row[0], {6.5, 0, 0}, 1e-11);  // m (b^2 + c^2) / 12
  expect_near(mass.inertia.row[1], {0, 5.0, 0}, 1e-11);
  expect_near(mass.inertia.row[2], {0, 0, 2.5}, 1e-11);
}

TEST(TriangleMesh, TetrahedronHasItsMassProperties) {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  data.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto mass = mesh(std::move(data)).mass_properties();
  EXPECT_NEAR(mass.volume, 1.0 / 6.0, 1e-15);
  expect_near(mass.centroid, {0.25, 0.25, 0.25}, 1e-15);
  // About the origin Ixx = V/5 and the product of inertia -V/20 (integrals of y^2 + z^2 and of x y); about the
  // centroid V/5 - V/8 and -V/20 + V/16.
  expect_near(mass.inertia.row[0], {0.075 / 6, 0.0125 / 6, 0.0125 / 6}, 1e-15);
}

TEST(TriangleMesh, SphereTendsToItsMassProperties) {
  // Inscribed: the error falls as the square of the edge length, to a quarter each time.
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const auto mass = mesh(sphere_mesh(2.0, 3 + i)).mass_properties();
    const double volume = 4.0 / 3.0 * pi * 8.0;
    error[i] = volume - mass.volume;
    EXPECT_GT(error[i], 0.0);
    expect_near(mass.centroid, {}, 1e-12);
    EXPECT_NEAR(mass.inertia.row[1].y, 0.4 * volume * 4.0, 0.02 * volume * 4.0);
    EXPECT_NEAR(mass.inertia.row[0].x, mass.inertia.row[2].z, 1e-9);
    EXPECT_NEAR(mass.inertia.row[0].y, 0.0, 1e-9);
  }
  EXPECT_NEAR(error[0] / error[1], 4.0, 0.1);
}

TEST(TriangleMesh, DepthLimitIsHalfTheThickness) {
  const TriangleMesh plate = mesh(box_mesh({4, 4, 0.2}, 3));
  for (std::uint32_t t = 0; t < plate.triangles().size(); ++t) {
    EXPECT_NEAR(plate.depth_limit(t), std::fabs(plate.face_normal(t).z) > 0.5 ? 0.1 : 2.0, 1e-12);
  }
}

TEST(TriangleMesh, InnerPlacesAreInsideAndApart) {
  const TriangleMesh solids[] = {mesh(box_mesh({1, 2, 3})), mesh(box_mesh({1, 0.2, 0.2}, 3)), mesh(sphere_mesh(0.7, 2)),
                                 mesh(angle_prism({-3, 3, 3, -1, -1, -3}, {-3, -3, -1, -1, 3, 3}, -1, 1))};
  for (const TriangleMesh &solid : solids) {
    const std::vector<Vec3> &places = solid.interior_points();
    ASSERT_GE(places.size(), 4u);  // triangles that face each other may share theirs
    ASSERT_LE(places.size(), TriangleMesh::max_interior_points);
    const Vec3 size = solid.hierarchy().bounds().high - solid.hierarchy().bounds().low;
    const double least = std::fmin(size.x, std::fmin(size.y, size.z));
    // Half way through the thickest part, which is no thinner than the whole.
    EXPECT_LE(solid.nearest(places[0]).distance, -0.1 * least);
    for (std::size_t k = 0; k < places.size(); ++k) {
      EXPECT_LT(solid.nearest(places[k]).distance, -0.01 * least) << k;
      for (std::size_t i = 0; i < k; ++i) EXPECT_GT(norm(places[k] - places[i]), 0.0);
    }
  }
  const TriangleMesh sheet = mesh(sheet_mesh(2.0, 3, [](double, double) { return 0.0; }));
  ASSERT_EQ(sheet.interior_points().size(), 1u);
  expect_near(sheet.interior_points()[0], sheet.vertices()[0], 0.0);
}

TEST(TriangleMesh, NearestIsThatOfBruteForce) {
  Random random(7);
  const TriangleMesh meshes[] = {mesh(sphere_mesh(1.0, 3)), mesh(box_mesh({1, 2, 0.5}, 5)),
                                 mesh(sheet_mesh(2.0, 12, [](double x, double y) { return 0.3 * std::sin(3 * x * y); }))};
  for (const TriangleMesh &m : meshes) {
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.log_uniform(1e-3, 5.0) * random.direction();
      double least = std::numeric_limits<double>::infinity();
      for (std::uint32_t t = 0; t < m.triangles().size(); ++t) {
        least = std::fmin(least,
                          norm(p - cmb::mesh::nearest_on_triangle(p, m.corner(t, 0), m.corner(t, 1), m.corner(t, 2)).point));
      }
      const auto nearest = m.nearest(p);
      ASSERT_NEAR(std::fabs(nearest.distance), least, 1e-14);
      ASSERT_NEAR(norm(p - nearest.point), least, 1e-14);
      ASSERT_NEAR(norm(nearest.normal), 1.0, 1e-14);
    }
  }
}

TEST(TriangleMesh, NearestOfABoxIsSignedAsItsClosedForm) {
  Random random(11);
  const Vec3 half{0.5, 1.0, 0.25};
  const TriangleMesh box = mesh(box_mesh(2.0 * half, 2));
  for (int i = 0; i < 20000; ++i) {
    Vec3 p;
    // On faces, edges and corners too: coordinates in steps of a quarter.
    for (int k = 0; k < 3; ++k) p.set(k, 0.25 * random.integer(-8, 8) + (random.integer(0, 1) ? random.uniform(-0.1, 0.1) : 0.0));
    const Vec3 q{std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z};
    const Vec3 out{std::fmax(q.x, 0), std::fmax(q.y, 0), std::fmax(q.z, 0)};
    const double expected = norm(out) + std::fmin(0.0, std::fmax(q.x, std::fmax(q.y, q.z)));
    ASSERT_NEAR(box.nearest(p).distance, expected, 1e-14);
  }
}

TEST(TriangleMesh, RepeatsToTheBit) {
  const TriangleMesh a = mesh(sphere_mesh(1.0, 3)), b = mesh(sphere_mesh(1.0, 3));
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = 1.5 * random.direction();
    const auto x = a.nearest(p), y = b.nearest(p);
    ASSERT_EQ(x.distance, y.distance);
    ASSERT_EQ(x.triangle, y.triangle);
  }
}

}  // namespace
}  // namespace test_triangle_mesh
