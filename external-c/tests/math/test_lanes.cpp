// Two numbers at once give the bits that each gives by itself; sums over nodes leave none out.
#include <gtest/gtest.h>

#include "manifold/surface/overlap_surface.hpp"
#include "math/lanes.hpp"
#include "support/random_bodies.hpp"

namespace test_lanes {
namespace {

using cmb::OverlapSurface;
using cmb::convex::Lanes;
using cmb::convex::LaneVec3;
using cmb::convex::SymmetricMatrix;
using cmb::convex::Vec3;
using random_bodies::Random;

void expect_same(const LaneVec3 &found, const Vec3 (&wanted)[2]) {
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(found.x[k], wanted[k].x);
    EXPECT_EQ(found.y[k], wanted[k].y);
    EXPECT_EQ(found.z[k], wanted[k].z);
  }
}

TEST(Lanes, AreTheBitsOfSingleNumbers) {
  Random random(1);
  for (int sample = 0; sample < 1000; ++sample) {
    Vec3 p[2], q[2];
    for (int k = 0; k < 2; ++k) p[k] = random.uniform(0.1, 2.0) * random.direction(), q[k] = random.uniform(0.1, 2.0) * random.direction();
    SymmetricMatrix matrix;
    matrix.add_square(random.uniform(-1.0, 1.0), p[0]);
    matrix.add_square(random.uniform(-1.0, 1.0), q[0]);
    const LaneVec3 both_p(p[0], p[1]), both_q(q[0], q[1]);
    expect_same(both_p + both_q, {p[0] + q[0], p[1] + q[1]});
    expect_same(both_p - both_q, {p[0] - q[0], p[1] - q[1]});
    expect_same(cross(both_p, both_q), {cross(p[0], q[0]), cross(p[1], q[1])});
    expect_same(times(matrix, both_p), {times(matrix, p[0]), times(matrix, p[1])});
    const Lanes product = dot(both_p, both_q), length = cmb::convex::square_root(norm2(both_p));
    for (int k = 0; k < 2; ++k) {
      EXPECT_EQ(product[k], dot(p[k], q[k]));
      EXPECT_EQ(length[k], norm(p[k]));
    }
    expect_same(product * both_q, {dot(p[0], q[0]) * q[0], dot(p[1], q[1]) * q[1]});
    EXPECT_EQ(cmb::convex::sum_of(product), dot(p[0], q[0]) + dot(p[1], q[1]));
  }
}

TEST(SurfaceNodes, AreAllVisitedAndShortened) {
  Random random(2);
  const Vec3 shift = random.direction();
  for (std::size_t count = 0; count < 8; ++count) {
    for (std::size_t left = 0; left <= count; ++left) {
      OverlapSurface::Nodes nodes;
      std::vector<Vec3> places, areas;
      for (std::size_t k = 0; k < count; ++k) {
        places.push_back(random.direction()), areas.push_back(random.direction());
        nodes.add(places.back(), areas.back());
      }
      nodes.shorten(left);
      ASSERT_EQ(nodes.size(), left);
      nodes.change_pairs([&](OverlapSurface::Nodes::Pair &pair) { pair.at = pair.at - LaneVec3(shift), pair.cone = pair.cone + 1.0; });
      Vec3 sum;
      std::size_t visited = 0;
      for (const OverlapSurface::Node &node : nodes) {
        const Vec3 at = places[visited] - shift;
        EXPECT_TRUE(node.at.x == at.x && node.at.y == at.y && node.at.z == at.z);
        EXPECT_EQ(node.cone, 1.0);
        sum = sum + areas[visited++];
      }
      EXPECT_EQ(visited, left);
      LaneVec3 area_sum;
      Lanes cones{};
      nodes.visit_pairs([&](const OverlapSurface::Nodes::Pair &pair) { area_sum = area_sum + pair.area, cones += pair.cone; });
      EXPECT_LE(norm(sum_of(area_sum) - sum), 1e-14);
      EXPECT_EQ(cmb::convex::sum_of(cones), static_cast<double>(left));
    }
  }
}

}  // namespace
}  // namespace test_lanes
