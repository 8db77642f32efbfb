// Meshes on half-spaces: flat sheets, whose vertices carry; meshes with more vertices than a hull may have.
#include <gtest/gtest.h>

#include <algorithm>

#include "query/mesh_query.hpp"
#include "scene/descriptor.hpp"
#include "scene/mesh_hull.hpp"
#include "support/mesh_samples.hpp"
#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_mesh_on_halfspace {
namespace {

using namespace cmb::test;

double farthest(const std::vector<Vec3> &points, const Vec3 &direction) {
  double most = dot(direction, points[0]);
  for (const Vec3 &p : points) most = std::max(most, dot(direction, p));
  return most;
}

const std::string flat_sheet = "cmb/1 mesh vertices=0,0,0,1,0,0,1,1,0,0,1,0 triangles=1,2,3,1,3,4";

// Independent of the engine: the heights of the four corners.
TEST(FlatSheet, CarriesWithItsCornersBelowTheHalfSpace) {
  const PairScene scene(flat_sheet, "cmb/1 halfspace");
  random_bodies::Random random(5);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    const BodyPose sheet{{0.3, -0.2, random.uniform(-0.5, 1.0)}, random_bodies::random_rotation(random)};
    double lowest = 1e9, load = 0.0;
    Vec3 moment;
    for (const Vec3 &corner : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}) {
      const Vec3 p = sheet.position + sheet.rotation * corner;
      lowest = std::min(lowest, p.z);
      const double share = 0.25 * std::max(0.0, -p.z);
      load += share;
      moment = moment + cmb::convex::cross({p.x, p.y, 0.0}, {0, 0, share});
    }
    const Contact contact = scene.query(sheet, {});
    ASSERT_NEAR(contact.distance, lowest, 1e-14);
    ASSERT_NEAR(contact.load().z, load, 1e-14);
    ASSERT_EQ(contact.load().x, 0.0);
    ASSERT_LT(norm(contact.moment({}) - moment), 1e-13);
    touching += lowest < 0.0;
  }
  EXPECT_GT(touching, 100);
  EXPECT_LT(touching, 300);
}

TEST(MeshHull, OfFlatMeshesThereIsNone) {
  const auto sheet = mesh_samples::sheet_mesh(1.0, 4, [](double x, double y) { return 0.5 * x - 0.25 * y; });
  EXPECT_EQ(cmb::make_mesh_hull({sheet, mesh_samples::MeshUse::any, "sheet"}), nullptr);
}

TEST(MeshHull, OfAFineBoxIsTheBox) {
  const Vec3 size{1.0, 0.5, 0.25};
  const mesh_samples::TriangleMesh mesh(mesh_samples::box_mesh(size, 40), mesh_samples::MeshUse::solid, "box");
  ASSERT_GT(mesh.vertices().size(), 8192u);
  const auto hull = cmb::make_mesh_hull(mesh);
  ASSERT_NE(hull, nullptr);
  random_bodies::Random random(6);
  for (int k = 0; k < 500; ++k) {
    const Vec3 n = random.direction();
    const double box = 0.5 * (size.x * std::fabs(n.x) + size.y * std::fabs(n.y) + size.z * std::fabs(n.z));
    ASSERT_NEAR(farthest(hull->geometry().vertices(), n), box, 1e-12);
  }
}

TEST(MeshHull, OfAFineSphereLacksLessThanAThousandthOfItsSize) {
  const mesh_samples::TriangleMesh mesh(mesh_samples::sphere_mesh(0.5, 5), mesh_samples::MeshUse::solid, "sphere");
  ASSERT_GT(mesh.vertices().size(), 8192u);
  const auto hull = cmb::make_mesh_hull(mesh);
  ASSERT_NE(hull, nullptr);
  EXPECT_LE(hull->geometry().vertices().size(), 8192u);
  random_bodies::Random random(7);
  for (int k = 0; k < 500; ++k) {
    const Vec3 n = random.direction();
    const double of_mesh = farthest(mesh.vertices(), n), of_hull = farthest(hull->geometry().vertices(), n);
    ASSERT_LE(of_hull, of_mesh);
    ASSERT_GT(of_hull, of_mesh - 1e-3);
  }
}

TEST(FineMesh, OfABoxRestsAsTheBox) {
  const PairScene mesh(mesh_samples::mesh_text(mesh_samples::box_mesh({1.0, 0.5, 0.25}, 40)), "cmb/1 halfspace");
  const PairScene box("cmb/1 box size=1,0.5,0.25", "cmb/1 halfspace");
  random_bodies::Random random(8);
  for (int k = 0; k < 20; ++k) {
    const BodyPose pose{{0, 0, random.uniform(0.0, 0.6)}, random_bodies::random_rotation(random)};
    const Contact of_mesh = mesh.query(pose, {}), of_box = box.query(pose, {});
    ASSERT_NEAR(of_mesh.distance, of_box.distance, 1e-12);
    ASSERT_LT(norm(of_mesh.load() - of_box.load()), 1e-9);
    ASSERT_LT(norm(of_mesh.moment({}) - of_box.moment({})), 1e-9);
  }
}

// Which half-spaces ask for elsewhere.
TEST(MeshContact, OfAHalfspaceIsNothing) {
  const cmb::Shape mesh = cmb::parse_descriptor(flat_sheet).front(), halfspace = cmb::parse_descriptor("cmb/1 halfspace").front();
  cmb::MeshQueryScratch scratch;
  cmb::ContactSet contact;
  contact.distance = 7.0;
  cmb::mesh_contact(halfspace, {}, mesh, {}, scratch, contact);
  EXPECT_EQ(contact.distance, 7.0);
  EXPECT_TRUE(contact.points.empty());
}

}  // namespace
}  // namespace test_mesh_on_halfspace
