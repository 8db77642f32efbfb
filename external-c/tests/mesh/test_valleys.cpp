// Bodies over the bottom of a valley with a flat side in the plane that halves its angle: as little as rounding is beyond it or not, which changes
// neither load nor energy.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/mesh_text.hpp"
#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_valleys {
namespace {

using namespace cmb::test;
using namespace mesh_samples;
using random_bodies::Random;

// Along y through the origin, its sides risen by `rise` a metre to either side of the plane x = 0: a sheet, or a block of which the valley is cut out.
MeshData valley(double rise, bool closed, std::uint32_t cells) {
  if (!closed) return sheet_mesh(2.0, 2 * cells, [rise](double x, double) { return rise * std::fabs(x); });
  const double high = rise, xs[6] = {-1, 1, 1, 0, -1, -1.2}, ys[6] = {-3, -3, high, 0, high, 0};
  MeshData data = angle_prism(xs, ys, -1, 1);
  for (Vec3 &p : data.vertices) p = {p.x, -p.z, p.y};
  return data;
}

// Its flat side in x = 0, the body behind that, its lowest place the origin. From there it rises at least as the valley does.
std::string body(const std::string &kind, double rise, Random &random) {
  const double length = random.uniform(0.1, 0.4), high = length * rise * (random.integer(0, 2) == 0 ? 1.0 : random.uniform(1.0, 2.0));
  if (kind == "cone") return "cmb/1 cone radius=" + digits(high) + " length=" + digits(length) + " position=" + digits(-0.5 * length) + ",0," + digits(high) + " rotation=0,0,1,0,1,0,-1,0,0";
  const double wide = random.uniform(0.05, 0.3), top = high + random.uniform(0.1, 0.3);
  MeshData ramp;
  for (const double y : {-wide, wide}) ramp.vertices.insert(ramp.vertices.end(), {{0, y, 0}, {0, y, top}, {-length, y, top}, {-length, y, high}});
  if (kind == "hull") {
    std::string text = "cmb/1 hull vertices=";
    for (const Vec3 &p : ramp.vertices) text += digits(p.x) + "," + digits(p.y) + "," + digits(p.z) + ",";
    text.pop_back();
    return text;
  }
  ramp.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 6, 5}, {4, 7, 6}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    ramp.triangles.push_back({k, k + 4, next + 4});
    ramp.triangles.push_back({k, next + 4, next});
  }
  return mesh_text(with_speck(ramp, {-0.5 * length, 0, 20}));
}

class Valleys : public testing::TestWithParam<const char *> {};

TEST_P(Valleys, SideInThePlaneBetweenTheSlopesMakesNoContactOfItsOwn) {
  Random random(4);
  for (int trial = 0; trial < 24; ++trial) {
    const double rise = random.integer(0, 2) == 0 ? 1.0 : random.uniform(0.7, 2.5), deep = random.log_uniform(1e-4, 1e-2);
    const Mat3 turn = trial % 2 == 0 ? Mat3{} : random_bodies::random_rotation(random);
    MeshData data = valley(rise, random.integer(0, 1) == 1, static_cast<std::uint32_t>(random.integer(1, 4)));
    for (Vec3 &p : data.vertices) p = turn * p;
    const PairScene scene(body(GetParam(), rise, random), mesh_text(data));
    const double along = random.uniform(-0.3, 0.3);
    const auto beside = [&](double aside) { return scene.query({turn * Vec3{aside, along, -deep}, turn}, {}, 128); };
    const Contact at_rest = beside(0.0);
    ASSERT_GT(norm(at_rest.load()), 0.01 * deep) << trial;
    for (const double aside : {-1e-7, -1e-9, -1e-12, 1e-15, 1e-12, 1e-9, 1e-7}) {
      const Contact there = beside(aside);
      const double tolerance = 1e-8 + 20.0 * std::fabs(aside) / deep;
      EXPECT_LT(norm(there.load() - at_rest.load()), tolerance * norm(at_rest.load())) << trial << ", " << aside << " aside";
      EXPECT_NEAR(there.energy(), at_rest.energy(), tolerance * at_rest.energy()) << trial << ", " << aside << " aside";
    }
    for (int k = 0; k < 4; ++k) {
      const BodyPose frame{random.direction(), random_bodies::random_rotation(random)};
      const BodyPose moved{frame.rotation * (turn * Vec3{0, along, -deep}) + frame.position, product(frame.rotation, turn)};
      const Vec3 load = transposed_times(frame.rotation, scene.query(moved, frame, 128).load());
      EXPECT_LT(norm(load - at_rest.load()), 1e-8 * norm(at_rest.load())) << trial << ", frame " << k;
    }
    cmb_release_scene(scene.handle());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Valleys, testing::Values("cone", "hull", "mesh"));

// Across the ridge x = 0 and one or two further ones, with a flat side in x = 0, the plane that halves the ridge's angle. The lowest place there is the
// origin. Of the four slopes the first is one contact with the second, which it shares the ridge with, and with the third, which it is parallel to; these
// two are none.
std::string body_across_ridges(const std::string &kind, Random &random) {
  const double length = random.uniform(0.52, 0.9), wide = random.uniform(0.1, 0.3);
  if (kind == "cylinder") return "cmb/1 cylinder radius=0.4 length=" + digits(length) + " position=" + digits(0.5 * length) + ",0,0.4 rotation=0,0,-1,0,1,0,1,0,0";
  // From its lower side it falls or rises towards the other end.
  const double low = random.uniform(-0.01, 0.005);
  MeshData block;
  for (const double y : {-wide, wide}) block.vertices.insert(block.vertices.end(), {{0, y, 0}, {0, y, 0.5}, {length, y, 0.5}, {length, y, low}});
  if (kind == "hull") {
    std::string text = "cmb/1 hull vertices=";
    for (const Vec3 &p : block.vertices) text += digits(p.x) + "," + digits(p.y) + "," + digits(p.z) + ",";
    text.pop_back();
    return text;
  }
  block.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t next = (k + 1) % 4;
    block.triangles.push_back({k, next + 4, k + 4});
    block.triangles.push_back({k, next, next + 4});
  }
  return mesh_text(with_speck(block, {0.5 * length, 0, 20}));
}

class Ridges : public testing::TestWithParam<const char *> {};

TEST_P(Ridges, SideInThePlaneBetweenTheSlopesTakesNoLoadAtOnce) {
  Random random(6);
  for (int trial = 0; trial < 24; ++trial) {
    const double rise = trial % 3 == 0 ? 1.0 : random.uniform(0.8, 2.0), deep = random.log_uniform(1e-3, 5e-2);
    const Mat3 turn = trial % 2 == 0 ? Mat3{} : random_bodies::random_rotation(random);
    MeshData data = sheet_mesh(2.0, 16, [rise](double x, double) { return rise * (std::fabs(x - 0.25 - 0.5 * std::floor(2.0 * x)) - 0.25); });
    for (Vec3 &p : data.vertices) p = turn * p;
    const PairScene scene(body_across_ridges(GetParam(), random), mesh_text(data));
    const double along = random.uniform(-0.3, 0.3);
    const auto beside = [&](double aside) { return scene.query({turn * Vec3{aside, along, -deep}, turn}, {}, 128); };
    const Contact at_rest = beside(0.0);
    ASSERT_GT(norm(at_rest.load()), 0.01 * deep) << trial;
    for (const double aside : {-1e-6, -1e-9, -1e-12, 1e-15, 1e-12, 1e-9, 1e-6}) {
      const Contact there = beside(aside);
      const double tolerance = 1e-8 + 20.0 * std::fabs(aside) / deep;
      EXPECT_LT(norm(there.load() - at_rest.load()), tolerance * norm(at_rest.load())) << trial << ", " << aside << " aside";
      EXPECT_NEAR(there.energy(), at_rest.energy(), tolerance * at_rest.energy()) << trial << ", " << aside << " aside";
    }
    // Where the side crosses the ridge the slope before it comes to count by itself: the force is the energy's gradient all the way. (Of a cylinder what
    // passes through its rim pushes beside that at some poses.)
    for (int k = 0; k < 10 && GetParam() != std::string("cylinder"); ++k) {
      const double aside = random.uniform(-1.5, 0.5) * deep, step = 1e-4 * deep;
      const double slope = (beside(aside + step).energy() - beside(aside - step).energy()) / (2.0 * step);
      EXPECT_NEAR(dot(turn * Vec3{1, 0, 0}, beside(aside).load()), -slope, 1e-5 * norm(at_rest.load())) << trial << ", " << aside / deep << " aside";
    }
    cmb_release_scene(scene.handle());
  }
}

INSTANTIATE_TEST_SUITE_P(All, Ridges, testing::Values("cylinder", "hull", "mesh"));

}  // namespace
}  // namespace test_valleys
