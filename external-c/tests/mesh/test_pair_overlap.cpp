// What of a closed mesh lies behind the triangles of another one: as of a polytope of the same surface, and the gradient of its energy.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mesh/elastic/pair_overlap.hpp"
#include "mesh/elastic/wedge_energy.hpp"
#include "mesh/elastic/wedge_overlap.hpp"
#include "shape/convex_hull.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_pair_overlap {
namespace {

using cmb::convex::Polytope;
using cmb::convex::Pose;
using cmb::convex::Vec3;
using cmb::mesh::MeshData;
using cmb::mesh::PairOverlap;
using cmb::mesh::PlacedVertices;
using cmb::mesh::TriangleMesh;
using cmb::mesh::WedgeOverlap;
using cmb::mesh::Wrench;
using random_bodies::Random;

struct Overlap {
  bool touches = false;
  double energy = 0.0, deepest = 0.0;
  Wrench wrench;  // torque about the mesh's origin
  std::size_t places = 0;
};

Overlap result_of(const cmb::mesh::WedgeIntegrals &overlap) {
  Overlap result;
  static cmb::mesh::WedgeEnergyScratch scratch;
  const cmb::mesh::WedgeEnergy stored(overlap, scratch);
  result.touches = stored.touches();
  if (!result.touches) return result;
  result.energy = stored.energy();
  result.deepest = overlap.deepest();
  result.wrench = stored.wrench();
  result.wrench.torque = result.wrench.torque + cross(overlap.origin(), result.wrench.force);
  return result;
}

Overlap of_mesh(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place) {
  static cmb::mesh::PlacedVertexScratch placed;
  static cmb::mesh::PairOverlapScratch scratch;
  PairOverlap overlap(mesh, body, place, PlacedVertices(body, place, placed), scratch);
  overlap.add_all();
  return result_of(overlap);
}

Overlap of_polytope(const TriangleMesh &mesh, const Polytope &body, const Pose &place) {
  static cmb::mesh::OverlapScratch scratch;
  std::vector<Vec3> vertices, normals;
  for (const Vec3 &v : body.vertices()) vertices.push_back(place(v));
  for (const auto &face : body.faces()) normals.push_back(place.rotation * face.normal);
  const cmb::mesh::Bounds box = cmb::mesh::bounds_of(vertices);
  WedgeOverlap overlap(body, place, vertices, normals, mesh, 0.5 * (box.low + box.high), 0.5 * norm(box.high - box.low), scratch);
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) overlap.add(t);
  return result_of(overlap);
}

Polytope hull_of(const std::vector<Vec3> &points) {
  Polytope hull;
  EXPECT_TRUE(cmb::convex::build_convex_hull(points, hull, nullptr, nullptr));
  return hull;
}

struct Ground {
  const char *name;
  TriangleMesh mesh;
};

std::vector<Ground> grounds() {
  return {{"cube", mesh_samples::mesh(mesh_samples::box_mesh({1.0, 0.8, 0.6}, 1))},
          {"divided cube", mesh_samples::mesh(mesh_samples::box_mesh({1.0, 0.8, 0.6}, 3))},
          {"ball", mesh_samples::mesh(mesh_samples::sphere_mesh(0.5, 2))},
          {"angle", mesh_samples::mesh(mesh_samples::angle_prism({-0.5, 0.5, 0.5, -0.1, -0.1, -0.5}, {-0.5, -0.5, -0.1, -0.1, 0.5, 0.5}, -0.3, 0.3))},
          {"hills", mesh_samples::mesh(mesh_samples::sheet_mesh(4.0, 17, [](double x, double y) {
             return 0.1 * std::sin(2.1 * x) * std::cos(1.7 * y) + 0.02 * std::sin(5.0 * y);
           }))}};
}

// A pose that touches, up to `deep` deep.
Pose touching(const Ground &ground, const TriangleMesh &body, Random &random, double deep) {
  const Vec3 from = ground.mesh.closed() ? random.direction() : Vec3{0, 0, 1};
  Pose pose{random_bodies::random_rotation(random), 3.0 * from};
  if (!ground.mesh.closed()) pose.translation = pose.translation + Vec3{random.uniform(-1, 1), random.uniform(-1, 1), 0.0};
  double apart = 0.0, in = 3.0;
  const Vec3 far = pose.translation;
  const auto deepest = [&](double way) {
    pose.translation = far - way * from;
    const Overlap overlap = of_mesh(ground.mesh, body, pose);
    return overlap.touches ? overlap.deepest : 0.0;
  };
  for (double way = 0.0; way < 3.0; way += 0.02) {
    if (deepest(way) > deep) {
      in = way;
      break;
    }
    apart = way;
  }
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (apart + in);
    (deepest(middle) > deep ? in : apart) = middle;
  }
  deepest(in);
  return pose;
}

TEST(PairOverlap, IsThatOfThePolytopeWithTheSameSurface) {
  Random random(5);
  std::vector<Vec3> corners;
  const MeshData ball = mesh_samples::sphere_mesh(0.3, 1);
  const MeshData box = mesh_samples::box_mesh({0.5, 0.3, 0.4}, 2);
  const struct {
    TriangleMesh mesh;
    Polytope polytope;
  } bodies[] = {{mesh_samples::mesh(box), Polytope::box({0.5, 0.3, 0.4})},
                {mesh_samples::mesh(ball), hull_of(ball.vertices)}};
  for (const Ground &ground : grounds()) {
    for (const auto &body : bodies) {
      for (int i = 0; i < 30; ++i) {
        const double deep = random.log_uniform(1e-6, 0.1);
        const Pose pose = touching(ground, body.mesh, random, deep);
        const Overlap here = of_mesh(ground.mesh, body.mesh, pose), there = of_polytope(ground.mesh, body.polytope, pose);
        ASSERT_EQ(here.touches, there.touches);
        if (!here.touches) continue;
        const double rounding = 1e-9 + 1e-13 / deep;
        EXPECT_NEAR(here.energy, there.energy, rounding * there.energy) << ground.name << " " << i << " " << deep;
        EXPECT_LT(norm(here.wrench.force - there.wrench.force), rounding * deep) << ground.name << " " << i << " " << deep;
        EXPECT_LT(norm(here.wrench.torque - there.wrench.torque), rounding * deep) << ground.name << " " << i << " " << deep;
      }
    }
  }
}

// Bodies that hold some of the mesh's wedges whole, of which none of their surface tells.
TEST(PairOverlap, IsThatOfThePolytopeInAnyPose) {
  Random random(6);
  const MeshData ball = mesh_samples::sphere_mesh(0.45, 1);
  const TriangleMesh body = mesh_samples::mesh(ball);
  const Polytope polytope = hull_of(ball.vertices);
  int touching = 0;
  for (const Ground &ground : grounds()) {
    for (int i = 0; i < 60; ++i) {
      const Pose pose{random_bodies::random_rotation(random), random.uniform(0.0, 0.6) * random.direction()};
      const Overlap here = of_mesh(ground.mesh, body, pose), there = of_polytope(ground.mesh, polytope, pose);
      ASSERT_EQ(here.touches, there.touches);
      if (!here.touches) continue;
      ++touching;
      EXPECT_NEAR(here.energy, there.energy, 1e-10 * there.energy) << ground.name << " " << i;
      EXPECT_LT(norm(here.wrench.force - there.wrench.force), 1e-9) << ground.name << " " << i;
      EXPECT_LT(norm(here.wrench.torque - there.wrench.torque), 1e-9) << ground.name << " " << i;
    }
  }
  EXPECT_GT(touching, 150);
}

// The edges of two castings that are no more than touched, while what is below them holds other sides of the body: the depth's powers there
// are 1e10 times as great.
TEST(PairOverlap, ShallowContactsAreKnownToRounding) {
  const TriangleMesh casting =
      mesh_samples::mesh(mesh_samples::angle_prism({-0.15, 0.15, 0.15, -0.02, -0.02, -0.15}, {-0.15, -0.15, -0.02, -0.02, 0.15, 0.15}, -0.05, 0.05));
  const cmb::convex::Mat3 rotation{{{-0.6415836871760477, -0.5023026241658443, 0.579708932228661}, {-0.49861218154342657, -0.30119969097996635, -0.812812794295266}, {0.5828861507756833, -0.810537364906566, -0.057209398915106374}}};
  const Vec3 place{0.05213899710257607, 0.0690238454105817, 0.04921847301063768}, way{-0.8311092728031405, -0.5444780374337452, 0.11314169617312668};
  double last = 0.0;
  int touching = 0;
  for (int k = 0; k < 400; ++k) {
    const Overlap here = of_mesh(casting, casting, {rotation, place + (1e-6 * k - 1e-4) * way});
    if (!here.touches) continue;
    ++touching;
    // Two edges that cross.
    EXPECT_NEAR(here.energy / (here.deepest * here.deepest), 0.2, 0.01) << k << " " << here.deepest;
    EXPECT_GT(here.energy, last) << k;
    EXPECT_LT(dot(here.wrench.force, way), 0.0) << k;
    last = here.energy;
  }
  EXPECT_GT(touching, 100);
}

// Central differences of the energy in all six degrees of freedom.
TEST(PairOverlap, ItsWrenchIsTheGradientOfItsEnergy) {
  Random random(7);
  const TriangleMesh bodies[] = {
      mesh_samples::mesh(mesh_samples::angle_prism({-0.5, 0.5, 0.5, -0.1, -0.1, -0.5}, {-0.5, -0.5, -0.1, -0.1, 0.5, 0.5}, -0.2, 0.2)),
      mesh_samples::mesh(mesh_samples::sphere_mesh(0.3, 1))};
  for (const Ground &ground : grounds()) {
    for (const TriangleMesh &body : bodies) {
      for (int i = 0; i < 20; ++i) {
        const double deep = random.log_uniform(1e-4, 0.2), step = 1e-5 * deep;
        const Pose pose = touching(ground, body, random, deep);
        const Overlap here = of_mesh(ground.mesh, body, pose);
        if (!here.touches) continue;
        const Vec3 torque = here.wrench.torque - cross(pose.translation, here.wrench.force);
        for (int k = 0; k < 3; ++k) {
          Vec3 axis;
          axis.set(k, 1.0);
          const auto energy = [&](double shift, double turn) {
            const Pose turned = cmb::compose({random_bodies::rotation_about(axis, turn), {}}, {pose.rotation, {}});
            const Pose moved{turned.rotation, pose.translation + shift * axis};
            return of_mesh(ground.mesh, body, moved).energy;
          };
          EXPECT_NEAR((energy(-step, 0.0) - energy(step, 0.0)) / (2.0 * step), here.wrench.force[k], 1e-5 * deep) << ground.name << " " << i;
          EXPECT_NEAR((energy(0.0, -step) - energy(0.0, step)) / (2.0 * step), torque[k], 1e-5 * deep) << ground.name << " " << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace test_pair_overlap
