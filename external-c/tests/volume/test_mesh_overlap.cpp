// Overlaps of closed meshes: of boxes as meshes against those of boxes, and of a bent body against its two boxes.
#include <random>

#include "support/engine_calls.hpp"
#include "support/mesh_text.hpp"
#include "support/overlap_of.hpp"

namespace test_mesh_overlap {
namespace {

using namespace cmb::test;
using mesh_samples::box_mesh;
using mesh_samples::mesh_text;
using mesh_samples::with_speck;
using mesh_samples::MeshData;
using mesh_samples::sphere_mesh;

constexpr double pi = 3.14159265358979323846;

BodyPose random_pose(std::mt19937 &generator, double reach) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  BodyPose pose;
  pose.position = {reach * unit(generator), reach * unit(generator), reach * unit(generator)};
  const Vec3 axis = normalized(Vec3{unit(generator), unit(generator), unit(generator)});
  pose.rotation = rotation_about(axis, pi * unit(generator));
  return pose;
}

const std::vector<std::string> others = {
    "cmb/1 box size=0.7,0.5,0.6",
    "cmb/1 hull vertices=0.4,0.1,0.1,-0.3,0.4,0.2,0,-0.5,0.1,0.1,0.2,0.6,-0.2,-0.1,-0.6,0.35,-0.3,-0.2",
    "cmb/1 sphere radius=0.4",
    "cmb/1 capsule radius=0.2 length=0.7",
    "cmb/1 cylinder radius=0.3 length=0.8",
    "cmb/1 cone radius=0.4 length=0.9",
    "cmb/1 ellipsoid size=0.5,0.7,1",
    "cmb/1 halfspace"};

void expect_same(const cmb_overlap &overlap, const cmb_overlap &reference, bool patch, const std::string &what) {
  EXPECT_NEAR(overlap.volume, reference.volume, 1e-7 * reference.volume + 1e-13) << what;
  if (reference.volume < 1e-6) return;
  EXPECT_NEAR(norm(vector_of(overlap.centroid) - vector_of(reference.centroid)), 0.0, 1e-6) << what;
  if (!patch) return;
  EXPECT_NEAR(overlap.patch_area, reference.patch_area, 1e-6 * reference.patch_area) << what;
  EXPECT_NEAR(norm(vector_of(overlap.patch_centroid) - vector_of(reference.patch_centroid)), 0.0, 1e-5) << what;
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(overlap.patch_moment[i], reference.patch_moment[i], 1e-6) << what << " " << i;
}

TEST(MeshOverlap, OfABoxIsThatOfTheBox) {
  std::mt19937 generator(1);
  const std::string box = "cmb/1 box size=0.8,0.6,0.9", cube = mesh_text(box_mesh({0.8, 0.6, 0.9}, 2)),
                    with_other = mesh_text(with_speck(box_mesh({0.8, 0.6, 0.9}, 2)));
  for (const std::string &other : others) {
    const std::string &mesh = other == "cmb/1 halfspace" ? cube : with_other;  // would hold the speck
    const PairScene with_mesh(other, mesh), with_box(other, box), exchanged(mesh, other);
    for (int k = 0; k < 12; ++k) {
      const BodyPose a = random_pose(generator, 0.35), b = random_pose(generator, 0.35);
      const cmb_overlap reference = overlap_of(with_box, a, b);
      const bool same_normal = norm(normal_of(with_mesh, a, b) - normal_of(with_box, a, b)) < 1e-9;
      expect_same(overlap_of(with_mesh, a, b), reference, same_normal, other);
      expect_same(overlap_of(exchanged, b, a), reference, same_normal, other + ", exchanged");
    }
  }
}

TEST(MeshOverlap, OfTwoBoxesAsMeshes) {
  std::mt19937 generator(2);
  const PairScene meshes(mesh_text(with_speck(box_mesh({0.5, 0.6, 0.7}, 3))),
                         mesh_text(with_speck(box_mesh({0.8, 0.6, 0.9}, 2), {0, 40, 0})));
  const PairScene boxes("cmb/1 box size=0.5,0.6,0.7", "cmb/1 box size=0.8,0.6,0.9");
  for (int k = 0; k < 60; ++k) {
    const BodyPose a = random_pose(generator, 0.35), b = random_pose(generator, 0.35);
    expect_same(overlap_of(meshes, a, b), overlap_of(boxes, a, b),
                norm(normal_of(meshes, a, b) - normal_of(boxes, a, b)) < 1e-9, "meshes " + std::to_string(k));
  }
  // Faces in one plane, edges on each other.
  for (const double shift : {0.0, 0.1, 0.25, 0.4}) {
    const BodyPose a{{shift, 0, 0.7}, {}};
    expect_same(overlap_of(meshes, a, {}), overlap_of(boxes, a, {}), true, "in one plane " + std::to_string(shift));
  }
}

TEST(MeshOverlap, ShallowAsAMillionth) {
  const std::string mesh = mesh_text(with_speck(box_mesh({2, 2, 2}, 3)));
  for (const double depth : {1e-3, 1e-6}) {
    const double cap = pi * depth * depth * (3.0 - depth) / 3.0, relative = std::fmax(1e-7, 1e-13 / depth);
    EXPECT_NEAR(overlap_of(PairScene("cmb/1 ellipsoid size=2,2,2", mesh), {{0.1, 0.2, 2.0 - depth}, {}}, {}).volume, cap,
                relative * cap);
    EXPECT_NEAR(overlap_of(PairScene("cmb/1 box size=1,1,1", mesh), {{0.1, 0.2, 1.5 - depth}, {}}, {}).volume, depth,
                relative * depth);
  }
}

// A prism over an L of two squares and a corner square, of unit sides and height.
MeshData bent_body() {
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  MeshData data;
  for (const double z : {0.0, 1.0}) {
    for (const auto &p : outline) data.vertices.push_back({p[0], p[1], z});
  }
  // Fans about the inner corner, which sees all others; sides.
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t p = (4 + k) % 6, q = (5 + k) % 6;
    data.triangles.push_back({3, q, p});
    data.triangles.push_back({9, 6 + p, 6 + q});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    data.triangles.push_back({k, next, 6 + next});
    data.triangles.push_back({k, 6 + next, 6 + k});
  }
  return data;
}

TEST(MeshOverlap, OfABentBodyIsThatOfItsTwoBoxes) {
  std::mt19937 generator(3);
  const std::string mesh = mesh_text(bent_body()),
                    boxes = "cmb/1 box size=2,1,1 position=1,0.5,0.5;cmb/1 box size=1,1,1 position=0.5,1.5,0.5";
  for (const std::string &other : others) {
    const PairScene with_mesh(other, mesh), with_boxes(other, boxes);
    int touching = 0;
    for (int k = 0; k < 12; ++k) {
      const BodyPose a = random_pose(generator, 0.5);
      const BodyPose b = {a.position - a.rotation * Vec3{1, 1, 0.5}, a.rotation};
      const BodyPose at = random_pose(generator, 0.9);
      const cmb_overlap overlap = overlap_of(with_mesh, at, b), reference = overlap_of(with_boxes, at, b);
      if (reference.volume < 1e-9) continue;
      ++touching;
      EXPECT_NEAR(overlap.volume, reference.volume, 1e-7 * reference.volume) << other << " " << k;
      EXPECT_NEAR(norm(vector_of(overlap.centroid) - vector_of(reference.centroid)), 0.0, 1e-6) << other << " " << k;
    }
    EXPECT_GT(touching, 3) << other;
  }
  const PairScene twice(mesh, mesh), both(boxes, boxes);
  for (int k = 0; k < 20; ++k) {
    const BodyPose a = random_pose(generator, 0.5), b = random_pose(generator, 0.5);
    EXPECT_NEAR(overlap_of(twice, a, b).volume, overlap_of(both, a, b).volume, 1e-9) << k;
  }
}

TEST(MeshOverlap, SwallowedBodiesAreWhole) {
  const std::string mesh = mesh_text(with_speck(sphere_mesh(0.2, 2)));
  const PairScene in_box(mesh, "cmb/1 box size=2,2,2"), alone(mesh_text(sphere_mesh(0.2, 2)), "cmb/1 halfspace");
  const double whole = overlap_of(alone, {{0.3, 0.2, -3.0}, {}}, {}).volume;
  EXPECT_LT(whole, 4.0 / 3.0 * pi * 0.008);
  EXPECT_GT(whole, 0.95 * 4.0 / 3.0 * pi * 0.008);
  const BodyPose at{{0.3, 0.2, 0.7}, rotation_about({0.6, 0.8, 0}, 0.4)};
  EXPECT_NEAR(overlap_of(in_box, at, {}).volume, whole, 1e-12);
  EXPECT_NEAR(overlap_of(PairScene(mesh, "cmb/1 ellipsoid size=2,2,2.2"), at, {}).volume, whole, 1e-9);
  EXPECT_NEAR(overlap_of(PairScene(mesh, mesh_text(with_speck(box_mesh({2, 2, 2}, 2), {0, 40, 0}))), at, {}).volume, whole, 1e-12);
}

// Whether an overlap is known; of one that is not, everything is 0.
int known(const PairScene &scene, double height) {
  const PairPoses poses({{0.01, 0.02, height}, {}}, {});
  cmb_overlap overlap;
  EXPECT_EQ(query_overlap(scene.handle(), 1, poses.position, poses.rotation, 2, &overlap), CMB_OK);
  EXPECT_EQ(overlap.volume, 0.0);
  return overlap.known;
}

TEST(MeshOverlap, SheetsHaveNone) {
  // Known to be none where they touch nothing.
  const std::string sheet = mesh_samples::height_field_text(3.0, 5, [](double, double) { return 0.0; }),
                    cube = mesh_text(box_mesh({1, 1, 1}));
  for (const std::string body : {"cmb/1 sphere radius=0.5", "cmb/1 box size=1,1,1"}) {
    EXPECT_EQ(known({body, sheet}, 0.4), 0) << body;
    EXPECT_EQ(known({body, sheet}, 0.6), 1) << body;
    EXPECT_EQ(known({sheet, body}, -0.4), 0) << body;
    EXPECT_EQ(known({sheet, body}, -0.6), 1) << body;
  }
  EXPECT_EQ(known({cube, sheet}, 0.4), 0);
  EXPECT_EQ(known({cube, sheet}, 0.6), 1);
  EXPECT_EQ(known({sheet, cube}, -0.4), 0);
  EXPECT_EQ(known({sheet, "cmb/1 halfspace"}, -0.1), 0);
  EXPECT_EQ(known({sheet, "cmb/1 halfspace"}, 0.1), 1);
}

}  // namespace
}  // namespace test_mesh_overlap
