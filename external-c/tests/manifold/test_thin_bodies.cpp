// Thin bodies that touch with their borders: much softer than faces.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_thin_bodies {
namespace {

using namespace cmb::test;
using random_bodies::Random;

// A lens of six corners and two tips, twice `half` thick.
std::string lens(double half) {
  std::string text = "cmb/1 hull vertices=0,0," + digits(half) + ",0,0," + digits(-half);
  for (int k = 0; k < 6; ++k) text += "," + digits(0.5 * std::cos(k * 1.0471975511965976)) + "," + digits(0.5 * std::sin(k * 1.0471975511965976)) + ",0";
  return text;
}

// Borders across each other: whatever carries the load stores the work that it does.
void expect_work_stored(const std::string &a, const std::string &b, double half) {
  const PairScene scene(a, b);
  Random random(5);
  int touching = 0;
  for (int k = 0; k < 40; ++k) {
    const double deep = random.log_uniform(5e-3, 0.05) * half;
    const Mat3 rotation = product(rotation_about({1, 0, 0}, random.uniform(0.8, 2.3)), rotation_about({0, 0, 1}, random.uniform(0, 6.28)));
    BodyPose pose{{1.5, random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)}, rotation};
    for (int step = 0; step < 60; ++step) pose.position.x -= scene.query(pose, {}).distance + deep;
    const Contact here = scene.query(pose, {});
    if (!(here.distance < -0.5 * deep)) continue;
    ++touching;
    const double step = 1e-3 * deep;
    for (int axis = 0; axis < 3; ++axis) {
      BodyPose before = pose, after = pose;
      before.position.set(axis, pose.position[axis] - step), after.position.set(axis, pose.position[axis] + step);
      const double slope = (scene.query(after, {}).energy() - scene.query(before, {}).energy()) / (2.0 * step);
      EXPECT_NEAR(-slope, here.load()[axis], 1e-4 * norm(here.load())) << a << " on " << b << ", pose " << k;
    }
  }
  EXPECT_GT(touching, 20);
}

TEST(ThinBodies, BordersAcrossEachOtherStoreTheirWork) {
  for (const double half : {0.1, 0.01, 0.001}) {
    expect_work_stored(lens(half), lens(half), half);
    expect_work_stored("cmb/1 cone radius=0.5 length=" + digits(half), lens(half), half);
  }
}

}  // namespace
}  // namespace test_thin_bodies
