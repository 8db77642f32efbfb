// Points beyond planes: found in boxes as they are one by one.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "shape/point_groups.hpp"
#include "support/random_bodies.hpp"

namespace test_point_groups {
namespace {

using cmb::PointGroups;
using namespace random_bodies;

double farthest(const std::vector<Vec3> &points, const Vec3 &normal) {
  double height = -HUGE_VAL;
  for (const Vec3 &p : points) height = std::max(height, dot(normal, p));
  return height;
}

class Counts : public testing::TestWithParam<int> {};

TEST_P(Counts, APlaneIsSurpassedBelowTheFarthestPointAlone) {
  Random random(static_cast<std::uint64_t>(GetParam()));
  for (int shape = 0; shape < 3; ++shape) {  // a ball's surface, a flat cloud, a few places many times
    std::vector<Vec3> points;
    for (int k = 0; k < GetParam(); ++k) {
      const Vec3 d = random.direction();
      points.push_back(shape == 0   ? d
                       : shape == 1 ? Vec3{d.x, 1e-9 * d.y, d.z}
                                    : Vec3{std::round(d.x), std::round(d.y), std::round(d.z)});
    }
    const PointGroups groups(points);
    for (int k = 0; k < 300; ++k) {
      const Vec3 normal = random.direction();
      const double height = farthest(points, normal);
      EXPECT_TRUE(groups.any_beyond(normal, height - 1e-12));
      EXPECT_FALSE(groups.any_beyond(normal, height + 1e-12));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Points, Counts, testing::Values(1, 2, 15, 16, 17, 100, 3000));

TEST(PointGroups, NoPointsSurpassNothing) { EXPECT_FALSE(PointGroups({}).any_beyond({1, 0, 0}, -1e300)); }

}  // namespace
}  // namespace test_point_groups
