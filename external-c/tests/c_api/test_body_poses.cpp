// Poses are read two bodies at once: as each alone, to the bit, and refused as each alone.
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "c_api/last_error.hpp"
#include "c_api/pose_check.hpp"
#include "support/random_bodies.hpp"

namespace test_body_poses {
namespace {

using cmb::convex::Pose;

struct Bodies {
  std::vector<double> position, rotation;

  cmb_poses poses() const { return {position.size() / 3, position.data(), rotation.data()}; }
  void add(random_bodies::Random &random, double crooked) {
    const auto turned = random_bodies::random_rotation(random);
    for (int i = 0; i < 3; ++i) {
      position.push_back(random.uniform(-5.0, 5.0));
      for (int j = 0; j < 3; ++j) rotation.push_back(turned.row[j][i] + crooked * random.uniform(-1.0, 1.0));
    }
  }
};

// Of one body after the other.
cmb_status read_each(const Bodies &bodies, std::vector<Pose> &read) {
  for (std::size_t body = 0; body < read.size(); ++body) {
    const cmb_status status = cmb::read_body_pose(body, bodies.position.data(), bodies.rotation.data(), read[body]);
    if (status != CMB_OK) return status;
  }
  return CMB_OK;
}

TEST(BodyPoses, AreReadTogetherAsAlone) {
  random_bodies::Random random(11);
  constexpr double wrong[] = {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL, 2e12, 3.0, -1.0};
  int refused = 0;
  for (int sample = 0; sample < 4000; ++sample) {
    Bodies bodies;
    const int count = random.integer(1, 7);
    for (int body = 0; body < count; ++body) bodies.add(random, random.integer(0, 2) == 0 ? 0.0 : std::pow(10.0, random.uniform(-17.0, -1.5)));
    if (random.integer(0, 3) == 0) {
      std::vector<double> &numbers = random.integer(0, 1) == 0 ? bodies.position : bodies.rotation;
      numbers[static_cast<std::size_t>(random.integer(0, static_cast<int>(numbers.size()) - 1))] = wrong[random.integer(0, 5)];
    }
    std::vector<Pose> alone(static_cast<std::size_t>(count)), together = alone;
    const cmb_status expected = read_each(bodies, alone);
    const std::string problem = cmb::last_error();
    ASSERT_EQ(cmb::read_body_poses(bodies.poses(), together.data()), expected) << sample;
    if (expected == CMB_OK) {
      ASSERT_EQ(std::memcmp(alone.data(), together.data(), alone.size() * sizeof alone[0]), 0) << sample;
    } else {
      ASSERT_EQ(cmb::last_error(), problem) << sample;
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace test_body_poses
