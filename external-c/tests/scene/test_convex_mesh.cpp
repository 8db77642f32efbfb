// Closed convex meshes are the hulls that they enclose: which meshes those are, and that contacts are the same however their faces
// are cut into triangles.
#include <cmath>
#include <string>
#include <vector>

#include "query/mesh_query.hpp"
#include "scene/convex_mesh.hpp"
#include "scene/descriptor.hpp"
#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_convex_mesh {
namespace {

using namespace cmb::test;
using cmb::ShapeKind;
using mesh_samples::angle_prism;
using mesh_samples::box_mesh;
using mesh_samples::mesh_text;
using mesh_samples::MeshData;
using mesh_samples::sphere_mesh;
using mesh_samples::with_speck;
using random_bodies::Random;
using random_bodies::random_rotation;

constexpr double pi = 3.14159265358979323846;

ShapeKind kind_of(const MeshData &data) { return cmb::parse_descriptor(mesh_text(data)).front().kind; }

// Every face's triangles cut about a point somewhere in them, again and again: slivers, and corners in faces.
MeshData unevenly_cut(MeshData data, int cuts, Random &random) {
  for (int k = 0; k < cuts; ++k) {
    const auto t = static_cast<std::size_t>(random.integer(0, static_cast<int>(data.triangles.size()) - 1));
    const mesh_samples::Triangle old = data.triangles[t];
    const double u = random.uniform(0.1, 0.8), v = random.uniform(0.1, 0.9 - u);
    const Vec3 &a = data.vertices[old[0]];
    const auto added = static_cast<std::uint32_t>(data.vertices.size());
    data.vertices.push_back(a + u * (data.vertices[old[1]] - a) + v * (data.vertices[old[2]] - a));
    data.triangles[t] = {old[0], old[1], added};
    data.triangles.push_back({old[1], old[2], added});
    data.triangles.push_back({old[2], old[0], added});
  }
  return data;
}

// A prism of so many sides, ends cut into fans about a corner; a thirtieth of the size long.
MeshData disc_mesh(std::uint32_t sides, double radius, double half) {
  MeshData data;
  for (const double z : {-half, half}) {
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * pi * k / sides;
      data.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  }
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides;
    data.triangles.push_back({k, next, next + sides});
    data.triangles.push_back({k, next + sides, k + sides});
    if (k == 0 || next == 0) continue;
    data.triangles.push_back({0, next, k});
    data.triangles.push_back({sides, k + sides, next + sides});
  }
  return data;
}

MeshData turned(MeshData data, const Mat3 &rotation, const Vec3 &shift) {
  for (Vec3 &p : data.vertices) p = rotation * p + shift;
  return data;
}

// As files of single precision hold it.
MeshData in_single_precision(MeshData data) {
  for (Vec3 &p : data.vertices) {
    for (int axis = 0; axis < 3; ++axis) p.set(axis, static_cast<float>(p[axis]));
  }
  return data;
}

TEST(ConvexMesh, IsAHull) {
  Random random(1);
  for (const std::uint32_t cells : {1u, 4u, 8u}) EXPECT_EQ(kind_of(box_mesh({1, 0.8, 0.6}, cells)), ShapeKind::hull) << cells;
  EXPECT_EQ(kind_of(box_mesh({1, 1, 1e-4}, 4)), ShapeKind::hull);
  for (int k = 0; k < 20; ++k) {
    const MeshData data = turned(unevenly_cut(box_mesh({1, 0.8, 0.6}), 60, random), random_rotation(random), random.direction());
    ASSERT_EQ(kind_of(data), ShapeKind::hull) << k;
    ASSERT_EQ(kind_of(in_single_precision(data)), ShapeKind::hull) << k;
  }
  for (const int levels : {0, 2, 3}) {
    EXPECT_EQ(kind_of(sphere_mesh(0.5, levels)), ShapeKind::hull) << levels;
    EXPECT_EQ(kind_of(in_single_precision(sphere_mesh(0.5, levels))), ShapeKind::hull) << levels;
  }
  for (const std::uint32_t sides : {3u, 24u, 200u}) {
    for (int k = 0; k < 5; ++k) {
      const MeshData data = turned(disc_mesh(sides, 0.5, 0.015), random_rotation(random), {});
      EXPECT_EQ(kind_of(data), ShapeKind::hull) << sides;
      EXPECT_EQ(kind_of(in_single_precision(data)), ShapeKind::hull) << sides;
    }
  }
}

// Corners of a flat face are left out.
TEST(ConvexMesh, HasTheCornersOfItsHull) {
  const auto shape = cmb::parse_descriptor(mesh_text(box_mesh({1, 0.8, 0.6}, 8))).front();
  EXPECT_EQ(shape.polytope->geometry().vertices().size(), 8u);
  EXPECT_EQ(shape.polytope->geometry().faces().size(), 6u);
  Random random(2);
  for (int k = 0; k < 20; ++k) {
    const Mat3 rotation = random_rotation(random);
    const MeshData box = in_single_precision(turned(unevenly_cut(box_mesh({1, 0.8, 0.6}, 2), 30, random), rotation, {}));
    EXPECT_EQ(cmb::parse_descriptor(mesh_text(box)).front().polytope->geometry().faces().size(), 6u) << k;
    const MeshData disc = in_single_precision(turned(disc_mesh(24, 0.5, 0.015), rotation, {}));
    EXPECT_EQ(cmb::parse_descriptor(mesh_text(disc)).front().polytope->geometry().faces().size(), 26u) << k;
  }
}

TEST(ConvexMesh, IsNoOtherMesh) {
  // A vertex in the middle of a face, pushed inwards by 1 % and by far less.
  for (const double part : {1e-2, 1e-4, 1e-5, 2e-6}) {
    MeshData dented = box_mesh({1, 1, 1}, 2);
    for (Vec3 &p : dented.vertices) {
      if (norm(p - Vec3{0, 0, 0.5}) < 1e-9) p.z -= part;
    }
    EXPECT_EQ(kind_of(dented), ShapeKind::mesh) << part;
  }
  // One of a ball.
  MeshData ball = sphere_mesh(0.5, 2);
  ball.vertices[40] = 0.9 * ball.vertices[40];
  EXPECT_EQ(kind_of(ball), ShapeKind::mesh);
  // All corners on the hull, one edge inside of it.
  MeshData creased = box_mesh({1, 1, 1});
  for (Vec3 &p : creased.vertices) {
    if (p.z > 0 && p.x * p.y > 0) p.z += 0.1;
  }
  MeshData other = creased;
  for (Vec3 &p : other.vertices) {
    if (p.z > 0) p.z = p.x * p.y > 0 ? 0.5 : 0.6;
  }
  EXPECT_NE(kind_of(creased), kind_of(other));  // the one diagonal is a ridge, the other one a valley
  // A hole, a bend, two bodies, a cavity.
  MeshData open = box_mesh({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_EQ(kind_of(open), ShapeKind::mesh);
  EXPECT_EQ(kind_of(angle_prism({-1, 1, 1, 0, 0, -1}, {-1, -1, 0, 0, 1, 1}, -1, 1)), ShapeKind::mesh);
  EXPECT_EQ(kind_of(with_speck(box_mesh({1, 1, 1}))), ShapeKind::mesh);
  MeshData hollow = box_mesh({1, 1, 1});
  const MeshData cavity = box_mesh({0.5, 0.5, 0.5});
  const auto first = static_cast<std::uint32_t>(hollow.vertices.size());
  hollow.vertices.insert(hollow.vertices.end(), cavity.vertices.begin(), cavity.vertices.end());
  for (const auto &t : cavity.triangles) hollow.triangles.push_back({first + t[0], first + t[2], first + t[1]});
  EXPECT_EQ(kind_of(hollow), ShapeKind::mesh);
}

// The same load, energy and distance as of the hull of the same corners, and of the box.
struct Cut {
  const char *name;
  MeshData data;
  const char *same;
};

std::string hull_of(const MeshData &data) {
  const std::string text = mesh_text(data);
  return "cmb/1 hull" + text.substr(10, text.find(" triangles") - 10);
}

TEST(ConvexMesh, TouchesAsItsHullHoweverItIsCut) {
  Random random(3);
  const char *const box = "cmb/1 box size=1,0.8,0.6";
  const MeshData uneven = unevenly_cut(box_mesh({1, 0.8, 0.6}), 90, random);
  const Cut cuts[] = {{"12", box_mesh({1, 0.8, 0.6}), box},  {"192", box_mesh({1, 0.8, 0.6}, 4), box}, {"uneven", uneven, box},
                      {"ball", sphere_mesh(0.5, 2), nullptr}, {"disc", disc_mesh(24, 0.5, 0.15), nullptr}};
  const std::string bodies[] = {"cmb/1 sphere radius=0.3", "cmb/1 capsule radius=0.1 length=0.5", "cmb/1 box size=0.5,0.6,0.4",
                                "cmb/1 ellipsoid size=0.4,0.5,0.7", hull_of(sphere_mesh(0.3, 0)), "cmb/1 halfspace",
                                mesh_text(sphere_mesh(0.3, 1)), "cmb/1 cylinder radius=0.2 length=0.5",
                                "cmb/1 cone radius=0.3 length=0.5"};
  for (const Cut &cut : cuts) {
    for (const std::string &body : bodies) {
      // On a box discs rest by the outline of the common area, on hulls by polygons.
      const bool disc = body.find("cylinder") != std::string::npos || body.find("cone") != std::string::npos;
      const std::string same = cut.same != nullptr && !disc ? cut.same : hull_of(cut.data);
      const PairScene mesh(mesh_text(cut.data), body), reference(same, body);
      int touching = 0;
      for (int k = 0; k < 60; ++k) {
        const BodyPose pose{random.uniform(0.3, 0.9) * random.direction(), random_rotation(random)};
        const Contact is = mesh.query(pose, {}), should = reference.query(pose, {});
        touching += should.distance < 0.0;
        ASSERT_NEAR(is.distance, should.distance, 1e-9) << cut.name << ' ' << body.substr(0, 20) << ' ' << k;
        ASSERT_LT(norm(is.load() - should.load()), 1e-9) << cut.name << ' ' << body.substr(0, 20) << ' ' << k;
        ASSERT_LT(norm(is.moment(pose.position) - should.moment(pose.position)), 1e-9) << cut.name << ' ' << body.substr(0, 20);
        ASSERT_NEAR(is.energy(), should.energy(), 1e-9) << cut.name << ' ' << body.substr(0, 20) << ' ' << k;
      }
      EXPECT_GT(touching, 10) << cut.name << ' ' << body.substr(0, 20);
    }
  }
}

// On a mesh that is no hull a box mesh is the box, and of a fine one its triangles touch.
TEST(ConvexMesh, OnOtherMeshes) {
  const MeshData angle_data = angle_prism({-1, 1, 1, 0, 0, -1}, {-1, -1, 0, 0, 1, 1}, -1, 1);
  const std::string angle = mesh_text(angle_data);
  const PairScene cut(mesh_text(box_mesh({0.5, 0.6, 0.4}, 3)), angle), box("cmb/1 box size=0.5,0.6,0.4", angle);
  const PairScene fine(mesh_text(sphere_mesh(0.3, 2)), angle);
  const mesh_samples::TriangleMesh ball = mesh_samples::mesh(sphere_mesh(0.3, 2)), ground = mesh_samples::mesh(angle_data);
  cmb::MeshQueryScratch scratch;
  Random random(4);
  for (int k = 0; k < 60; ++k) {
    const BodyPose pose{{random.uniform(-1, 1), random.uniform(-1, 1), 1.0 + random.uniform(0.1, 0.4)}, random_rotation(random)};
    const Contact is = cut.query(pose, {}), should = box.query(pose, {});
    ASSERT_NEAR(is.distance, should.distance, 1e-9) << k;
    ASSERT_LT(norm(is.load() - should.load()), 1e-9) << k;
    cmb::ContactSet triangles;
    cmb::mesh::mesh_pair_contact(ball, {pose.rotation, pose.position}, ground, {}, scratch, triangles);
    Vec3 load;
    for (const auto &p : triangles.points) load = load + (p.weight * p.depth) * p.normal;
    const Contact contact = fine.query(pose, {});
    ASSERT_NEAR(contact.distance, triangles.distance, 1e-12) << k;
    ASSERT_LT(norm(contact.load() - load), 1e-12) << k;
  }
}

// Flat faces that single precision bends are flat again.
TEST(ConvexMesh, RoundedOnesTouchAsExactOnes) {
  Random random(5);
  const Mat3 rotation = random_rotation(random);
  const MeshData exact = turned(box_mesh({1, 0.8, 0.6}, 3), rotation, {});
  for (const char *body : {"cmb/1 sphere radius=0.3", "cmb/1 box size=0.5,0.6,0.4", "cmb/1 capsule radius=0.1 length=0.5"}) {
    const PairScene rounded(mesh_text(in_single_precision(exact)), body), reference(mesh_text(exact), body);
    for (int k = 0; k < 60; ++k) {
      const BodyPose pose{random.uniform(0.3, 0.9) * random.direction(), random_rotation(random)};
      const Contact is = rounded.query(pose, {}), should = reference.query(pose, {});
      ASSERT_NEAR(is.distance, should.distance, 1e-6) << body << ' ' << k;
      ASSERT_LT(norm(is.load() - should.load()), 2e-6 + 1e-4 * norm(should.load())) << body << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace test_convex_mesh
