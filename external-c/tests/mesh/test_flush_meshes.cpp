// Closed meshes that lie in each other with faces or rows of vertices exactly in each other's surface: no triangles cross, and none
// of one lies behind the other's.
#include <cmath>
#include <string>
#include <vector>

#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_flush_meshes {
namespace {

using namespace cmb::test;
using mesh_samples::angle_prism;
using mesh_samples::box_mesh;
using mesh_samples::mesh_text;
using mesh_samples::with_speck;
using mesh_samples::MeshData;
using random_bodies::Random;
using random_bodies::random_rotation;

// An L: a square of half size a without a quarter, from -h to h.
MeshData angle_mesh(double a, double h) {
  return angle_prism({-a, a, a, -a / 3, -a / 3, -a}, {-a, -a, -a / 3, -a / 3, a, a}, -h, h);
}

struct Flush {
  const char *what;
  MeshData body, ground;
  Vec3 place;    // of the body's frame in the ground's; the axes are the same
  double depth;  // the smallest translation that takes them apart
};

std::vector<Flush> flush_poses() {
  const MeshData angle = angle_mesh(0.75, 0.25), large_angle = angle_mesh(1.5, 0.5);
  const Vec3 block{0.4, 0.5, 0.6};
  return {
      {"a bar whose ends are flush with an arm's sides", with_speck(box_mesh({1, 0.2, 0.2})), large_angle, {-1, 0.5, 0}, 0.6},
      {"a bar of many triangles", with_speck(box_mesh({1, 0.2, 0.2}, 3)), large_angle, {-1, 0.5, 0}, 0.6},
      {"a block flush with a foot's sides", with_speck(box_mesh({0.26, 0.5, 0.43}, 2)), angle, {0.33, -0.5, 0}, 0.465},
      {"a block half out, rows in the surface", with_speck(box_mesh({0.5, 0.2, 0.84}, 2)), angle, {0, -0.43, -0.25}, 0.28},
      {"a bar through a foot, rows in both surfaces", with_speck(box_mesh({0.4, 0.2, 1.5}, 3)), angle, {0.1, -0.43, 0}, 0.28},
      {"a plug that fills a block", with_speck(box_mesh(block, 2)), with_speck(box_mesh(block, 2), {0, 40, 0}), {0, 0, 0}, 0.4},
      {"a plug of other triangles", with_speck(box_mesh(block, 2)), with_speck(box_mesh(block, 3), {0, 40, 0}), {0, 0, 0}, 0.4},
      {"a bar most of the way in its sheath", with_speck(box_mesh({0.2, 0.2, 2}, 2)),
       with_speck(box_mesh({0.2, 0.2, 2}, 3), {0, 40, 0}), {0, 0, 0.4}, 0.2},
  };
}

double total_load(const Contact &contact) {
  double load = 0.0;
  for (const Point &p : contact.points) load += p.depth * p.weight;
  return load;
}

// In both orders, anywhere in the world, hardly moved and hardly turned.
TEST(FlushMeshes, TouchAndPush) {
  Random random(3);
  for (const Flush &flush : flush_poses()) {
    const std::string body = mesh_text(flush.body), ground = mesh_text(flush.ground);
    const PairScene scene(body, ground), exchanged(ground, body);
    for (int k = 0; k < 60; ++k) {
      BodyPose a{flush.place, {}}, b{};
      if (k > 0 && k % 3 != 0) a.position = a.position + random.log_uniform(1e-16, 1e-9) * random.direction();
      if (k > 0 && k % 3 != 1) a.rotation = rotation_about(random.direction(), random.log_uniform(1e-16, 1e-9));
      if (k % 2 != 0) {
        b = {random.direction(), random_rotation(random)};
        a = {b.position + b.rotation * a.position, product(b.rotation, a.rotation)};
      }
      for (const bool reversed : {false, true}) {
        const Contact contact = reversed ? exchanged.query(b, a) : scene.query(a, b);
        EXPECT_LT(contact.distance, -0.05 * flush.depth) << flush.what << ' ' << k << ' ' << reversed;
        EXPECT_GT(contact.distance, -flush.depth - 1e-8) << flush.what << ' ' << k << ' ' << reversed;
        EXPECT_GT(total_load(contact), 0.005 * flush.depth) << flush.what << ' ' << k << ' ' << reversed;
      }
    }
  }
}

// Through the flush pose along a line, the depth changes no more than a few times the motion.
TEST(FlushMeshes, DepthIsContinuous) {
  Random random(4);
  for (const Flush &flush : flush_poses()) {
    const std::string body = mesh_text(flush.body), ground = mesh_text(flush.ground);
    const PairScene scene(body, ground), exchanged(ground, body);
    const double depth = scene.query({flush.place, {}}, {}).distance, other = exchanged.query({}, {flush.place, {}}).distance;
    for (int k = 0; k < 40; ++k) {
      Vec3 step = random.direction();
      if (k < 6) {
        step = {};
        step.set(k % 3, k < 3 ? 1.0 : -1.0);
      }
      for (const double length : {1e-9, 1e-6, 1e-4}) {
        const BodyPose near{flush.place + length * step, {}};
        EXPECT_NEAR(scene.query(near, {}).distance, depth, 4.0 * length) << flush.what << ' ' << k;
        EXPECT_NEAR(exchanged.query({}, near).distance, other, 4.0 * length) << flush.what << ' ' << k;
      }
    }
  }
}

}  // namespace
}  // namespace test_flush_meshes
