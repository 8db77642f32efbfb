// Contacts of polytopes and round bodies with meshes are elastic: force and torque are the gradient of the energy that the points store.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "math/pi.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "shape/convex_hull.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_wedge_overlap {
namespace {

using cmb::ContactPoint;
using cmb::ContactSet;
using cmb::convex::ConvexBody;
using cmb::convex::Mat3;
using cmb::convex::Polytope;
using cmb::convex::Pose;
using cmb::convex::Vec3;
using cmb::mesh::TriangleMesh;
using random_bodies::Random;

ContactSet contact(const Polytope &body, const Pose &pose, const TriangleMesh &mesh) {
  static cmb::mesh::MeshContactScratch scratch;
  ContactSet set;
  polytope_contact(body, pose, mesh, {}, scratch, set);
  return set;
}

ContactSet contact(const ConvexBody &body, const Pose &pose, const TriangleMesh &mesh) {
  static cmb::mesh::MeshContactScratch scratch;
  ContactSet set;
  smooth_contact(body, pose, mesh, {}, scratch, set);
  return set;
}

double energy(const ContactSet &set) {
  double sum = 0.0;
  for (const ContactPoint &p : set.points) sum += 0.5 * p.weight * p.depth * p.depth;
  return sum;
}

Vec3 force(const ContactSet &set) {
  Vec3 sum;
  for (const ContactPoint &p : set.points) sum = sum + (p.weight * p.depth) * p.normal;
  return sum;
}

Vec3 torque(const ContactSet &set, const Vec3 &about) {
  Vec3 sum;
  for (const ContactPoint &p : set.points) sum = sum + cross(p.position - about, (p.weight * p.depth) * p.normal);
  return sum;
}

TriangleMesh sheet() {
  return mesh_samples::mesh(mesh_samples::sheet_mesh(4.0, 7, [](double, double) { return 0.0; }));
}

TriangleMesh hills() {
  return mesh_samples::mesh(mesh_samples::sheet_mesh(
      4.0, 17, [](double x, double y) { return 0.1 * std::sin(2.1 * x) * std::cos(1.7 * y) + 0.02 * std::sin(5.0 * y); }));
}

// A cube of 1 m that stands on a corner or an edge, lowest place at the origin.
Mat3 on_corner() {
  return random_bodies::rotation_about(cmb::convex::normalized({1, -1, 0}), std::acos(1.0 / std::sqrt(3.0)));
}
Mat3 on_edge() { return random_bodies::rotation_about({1, 0, 0}, std::atan(1.0)); }

double lowest(const Polytope &body, const Mat3 &rotation) {
  double least = HUGE_VAL;
  for (const Vec3 &v : body.vertices()) least = std::fmin(least, (rotation * v).z);
  return least;
}

TEST(ElasticPolytope, FaceEdgeAndCornerStoreTheirPartOfTheSquareOfDepth) {
  const TriangleMesh level = sheet();
  const Polytope cube = Polytope::box({1, 1, 1});
  const struct {
    Mat3 rotation;
    double part;
  } cases[] = {{{}, 0.5}, {on_edge(), 0.3}, {on_corner(), 0.2}};
  for (const double depth : {1e-9, 1e-6, 1e-3, 0.1}) {
    for (const auto &c : cases) {
      const ContactSet set = contact(cube, {c.rotation, {0.07, 0.11, -depth - lowest(cube, c.rotation)}}, level);
      // Vertices of 1 m are known to 1e-16 m.
      const double rounding = 1e-12 + 4e-15 / depth;
      EXPECT_NEAR(energy(set) / (depth * depth), c.part, rounding) << depth;
      EXPECT_NEAR(force(set).z / depth, 2.0 * c.part, 4.0 * rounding) << depth;
    }
  }
}

// The force of a tilted face acts at its lowest edge: no torque about it while the face is partly lifted.
TEST(ElasticPolytope, TiltedFacePushesAtItsLowestEdge) {
  const TriangleMesh level = sheet();
  const Polytope cube = Polytope::box({1, 1, 1});
  for (const double angle : {0.01, 0.05, 0.3}) {
    const Mat3 rotation = random_bodies::rotation_about({0, 1, 0}, angle);
    const double depth = 0.4 * std::sin(angle);
    const Vec3 place{0.07, 0.11, -depth - lowest(cube, rotation)};
    const ContactSet set = contact(cube, {rotation, place}, level);
    const Vec3 edge = place + rotation * Vec3{0.5, 0.0, -0.5};
    EXPECT_NEAR(torque(set, edge).y, 0.0, 1e-12);
    EXPECT_NEAR(force(set).z, 0.6 * depth, 1e-12);
  }
}

struct Ground {
  const char *name;
  TriangleMesh mesh;
  bool sheet;
};

std::vector<Ground> grounds() {
  return {{"cube", mesh_samples::mesh(mesh_samples::with_speck(mesh_samples::box_mesh({1.0, 0.8, 0.6}, 1))), false},
          {"divided cube", mesh_samples::mesh(mesh_samples::with_speck(mesh_samples::box_mesh({1.0, 0.8, 0.6}, 3))), false},
          {"ball", mesh_samples::mesh(mesh_samples::with_speck(mesh_samples::sphere_mesh(0.5, 2))), false},
          {"hills", hills(), true}};
}

// Central differences, whose steps are that part of the depth, of the energy in all six degrees of freedom; `touch(pose)` is the contact.
template <typename Touch>
void expect_gradient(const Ground &ground, Random &random, double least_deep, double step_part, double energy_rounding, Touch &&touch) {
  int touching = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 from = ground.sheet ? Vec3{0, 0, 1} : random.direction();
    const double deep = random.log_uniform(least_deep, 0.05);
    Pose pose{random_bodies::random_rotation(random), 2.0 * from};
    if (ground.sheet) pose.translation = pose.translation + Vec3{random.uniform(-1, 1), random.uniform(-1, 1), 0.0};
    for (int step = 0; step < 40; ++step) {
      pose.translation = pose.translation - (touch(pose, i).distance + deep) * from;
    }
    const ContactSet here = touch(pose, i);
    // The overlap's points come in fours; more is what passes through the body, which is no gradient.
    if (!(here.distance < 0.0) || here.points.size() % 4 != 0) continue;
    ++touching;
    const double step = step_part * deep, load = total_load(here.points);
    Vec3 slope, turning;
    for (int k = 0; k < 3; ++k) {
      Vec3 axis;
      axis.set(k, 1.0);
      const auto moved = [&](double by) { return energy(touch({pose.rotation, pose.translation + by * axis}, i)); };
      const auto turned = [&](double by) {
        const Mat3 by_angle = random_bodies::rotation_about(axis, by);
        const Mat3 columns{{by_angle * pose.rotation.column(0), by_angle * pose.rotation.column(1), by_angle * pose.rotation.column(2)}};
        return energy(touch({transposed(columns), pose.translation}, i));
      };
      slope.set(k, -(moved(step) - moved(-step)) / (2.0 * step));
      turning.set(k, -(turned(step) - turned(-step)) / (2.0 * step));
    }
    // The curve between steps counts by the square of their part.
    const double tolerance = load * (1e-6 + 30.0 * step_part * step_part) + energy_rounding / step;
    EXPECT_NEAR(norm(force(here) - slope), 0.0, tolerance) << ground.name << " " << i << " deep " << deep;
    EXPECT_NEAR(norm(torque(here, pose.translation) - turning), 0.0, tolerance) << ground.name << " " << i << " deep " << deep;
  }
  EXPECT_GT(touching, 25) << ground.name;
}

TEST(ElasticPolytope, ForceAndTorqueAreTheGradientOfTheEnergy) {
  Random random(17);
  std::vector<Polytope> boxes;
  for (int i = 0; i < 40; ++i) {
    boxes.push_back(Polytope::box({random.uniform(0.3, 1.0), random.uniform(0.3, 1.0), random.uniform(0.3, 1.0)}));
  }
  for (const Ground &ground : grounds()) {
    expect_gradient(ground, random, 1e-6, 1e-5, 1e-21,
                    [&](const Pose &pose, int i) { return contact(boxes[static_cast<std::size_t>(i)], pose, ground.mesh); });
  }
}

class ElasticRoundBody : public testing::TestWithParam<const char *> {};

ConvexBody round_body(const std::string &kind, Random &random) {
  const double radius = random.uniform(0.2, 0.5), length = random.uniform(0.3, 1.0);
  if (kind == "cylinder") return cmb::convex::make_cylinder(radius, length);
  if (kind == "cone") return cmb::convex::make_cone(radius, length);
  return cmb::convex::make_ellipsoid({radius, random.uniform(0.2, 0.5), 0.5 * length});
}

TEST_P(ElasticRoundBody, ForceAndTorqueAreTheGradientOfTheEnergy) {
  Random random(19);
  std::vector<ConvexBody> bodies;
  for (int i = 0; i < 40; ++i) bodies.push_back(round_body(GetParam(), random));
  for (const Ground &ground : grounds()) {
    expect_gradient(ground, random, 1e-3, 1e-4, 2e-14,
                    [&](const Pose &pose, int i) { return contact(bodies[static_cast<std::size_t>(i)], pose, ground.mesh); });
  }
}

// Standing or lying with ends, axis or rims exactly in the planes between triangles, at every place of a grid.
TEST_P(ElasticRoundBody, PlanesBetweenTrianglesMayHoldEndsAndAxes) {
  const TriangleMesh level = mesh_samples::mesh(mesh_samples::sheet_mesh(4.0, 5, [](double, double) { return 0.0; }));
  const TriangleMesh plain = mesh_samples::mesh(mesh_samples::sheet_mesh(8.0, 2, [](double, double) { return 0.0; }));
  const std::string kind = GetParam();
  for (const double size : {0.25, 0.5, 1.0}) {
    const ConvexBody body = kind == "cylinder" ? cmb::convex::make_cylinder(size, 2.0 * size)
                            : kind == "cone"   ? cmb::convex::make_cone(size, 2.0 * size)
                                               : cmb::convex::make_ellipsoid({size, size, size});
    for (const Mat3 &rotation : {Mat3{}, random_bodies::rotation_about({1, 0, 0}, 0.5 * cmb::pi), random_bodies::rotation_about({0, 1, 0}, 0.5 * cmb::pi)}) {
      for (const double x : {-0.75, -0.5, 0.0, 0.4, 0.5}) {
        for (const double y : {-0.5, 0.0, 0.4}) {
          const Vec3 place{x, y, 0.98 * size};
          const ContactSet set = contact(body, {rotation, place}, level);
          // Aside, where nothing is exact.
          const Vec3 beside{x + 0.0123, y + 0.0071, 0.98 * size};
          const ContactSet same = contact(body, {rotation, beside}, plain);
          const double load = norm(force(same));
          ASSERT_NEAR(energy(set), energy(same), 1e-8 * energy(same)) << size << " " << x << " " << y;
          ASSERT_NEAR(norm(force(set) - force(same)), 0.0, 1e-8 * load) << size << " " << x << " " << y;
          ASSERT_NEAR(norm(torque(set, place) - torque(same, beside)), 0.0, 1e-8 * load) << size << " " << x << " " << y;
        }
      }
    }
  }
}

// The side between two triangles through the axis of a cone that stands on its tip, or beside it by as little as rounding: a cone has a
// mean depth of a quarter of its height, and of the cube a twentieth.
TEST(ElasticCone, TipMayStandWhereTrianglesMeet) {
  const TriangleMesh level = mesh_samples::mesh(mesh_samples::sheet_mesh(4.0, 5, [](double, double) { return 0.0; }));
  const ConvexBody cone = cmb::convex::make_cone(0.08, 0.015);
  const Mat3 upside_down = random_bodies::rotation_about({1, 0, 0}, cmb::pi);
  Random random(23);
  for (int i = 0; i < 1000; ++i) {
    const double depth = random.log_uniform(1e-5, 1e-3);
    const Vec3 beside = random.log_uniform(1e-16, 1e-3) * random.direction();
    const Vec3 place{0.25 + beside.x, 0.25 + beside.y, 0.0075 - depth};
    const ContactSet set = contact(cone, {upside_down, place}, level);
    ASSERT_NEAR(energy(set), 0.2 * depth * depth, 1e-3 * depth * depth) << norm(beside) << " deep " << depth;
    ASSERT_NEAR(norm(force(set) - Vec3{0, 0, 0.4 * depth}), 0.0, 3e-3 * depth) << norm(beside) << " deep " << depth;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ElasticRoundBody, testing::Values("cylinder", "cone", "ellipsoid"));

// Faces, edges and corners of the body exactly in the planes that part the triangles' wedges.
TEST(ElasticPolytope, PlanesBetweenTrianglesMayHoldFacesAndCorners) {
  const TriangleMesh level = mesh_samples::mesh(mesh_samples::sheet_mesh(4.0, 5, [](double, double) { return 0.0; }));
  const double depth = 0.01;
  for (const double size : {0.5, 1.0, 1.6, 2.0}) {
    const Polytope box = Polytope::box({size, size, 0.5});
    for (const double x : {-0.8, -0.5, 0.0, 0.4, 0.5, 0.8}) {
      for (const double y : {-0.8, -0.5, 0.0, 0.4}) {
        const ContactSet set = contact(box, {{}, {x, y, 0.25 - depth}}, level);
        ASSERT_NEAR(energy(set), 0.5 * depth * depth, 1e-15) << size << " " << x << " " << y;
        ASSERT_NEAR(norm(force(set) - Vec3{0, 0, depth}), 0.0, 1e-13) << size << " " << x << " " << y;
        ASSERT_NEAR(norm(torque(set, {x, y, 0.0})), 0.0, 1e-13) << size << " " << x << " " << y;
      }
    }
  }
}

}  // namespace
}  // namespace test_wedge_overlap
