// Overlap queries do not allocate once the thread's scratch has grown.
#include "support/counted_allocations.hpp"
#include "support/engine_calls.hpp"
#include "support/mesh_text.hpp"
#include "support/overlap_of.hpp"

namespace {

using namespace cmb::test;

TEST(Allocations, OfOverlapsStopOnceTheScratchHasGrown) {
  const std::vector<std::string> geometry = {
      "cmb/1 box size=0.6,0.7,0.5",
      "cmb/1 hull vertices=0.4,0.1,0.1,-0.3,0.4,0.2,0,-0.5,0.1,0.1,0.2,0.6,-0.2,-0.1,-0.6,0.35,-0.3,-0.2",
      "cmb/1 sphere radius=0.4;cmb/1 cone radius=0.3 length=0.9",
      "cmb/1 capsule radius=0.3 length=0.5",
      "cmb/1 ellipsoid size=0.6,0.7,0.8",
      mesh_samples::mesh_text(mesh_samples::angle_prism({-0.4, 0.4, 0.4, 0, 0, -0.4}, {-0.4, -0.4, 0, 0, 0.4, 0.4}, -0.2, 0.2)),
      mesh_samples::mesh_text(mesh_samples::box_mesh({0.5, 0.5, 0.5})),
      "cmb/1 halfspace"};
  std::vector<int> pairs;
  for (int a = 1; a <= 8; ++a) {
    for (int b = a + 1; b <= 8; ++b) pairs.insert(pairs.end(), {a, b});
  }
  const cmb_scene scene = intern(geometry, pairs);
  double position[24], rotation[72];
  double total = 0.0;
  const auto query = [&](int k) {
    for (int body = 0; body < 8; ++body) {
      const double phase = 0.3 * k + body;
      const Mat3 r = rotation_about(normalized(Vec3{1, std::sin(phase), 0.3}), phase);
      for (int i = 0; i < 3; ++i) {
        position[3 * body + i] = 0.15 * std::sin(phase + i);
        for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * i + j] = r.row[j][i];
      }
    }
    for (std::size_t pair = 0; pair < pairs.size() / 2; ++pair) {
      cmb_overlap overlap;
      ASSERT_EQ(query_overlap(scene, pair + 1, position, rotation, 8, &overlap), CMB_OK);
      ASSERT_EQ(overlap.known, 1);
      total += overlap.volume;
    }
  };
  // Rooms that change places have to grow both.
  for (int k = 0; k < 8; ++k) query(k % 4);
  const unsigned long before = allocations;
  for (int k = 0; k < 16; ++k) query(k % 4);
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_GT(total, 0.0);
}

}  // namespace
