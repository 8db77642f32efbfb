// Nearest points of a mesh's edges and others.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/distance/segment_distance.hpp"
#include "support/random_bodies.hpp"
#include "support/reference_segments.hpp"

namespace test_segment_distance {
namespace {

using namespace cmb::mesh;
using cmb::convex::Vec3;
using random_bodies::Random;

// Any angle, and 1e-12 to 1e-4 with gaps of 1e-10 to 1 in the plane of the tilt, across it and anyhow.
TEST(SegmentDistance, IsThatOfLongDouble) {
  Random random(23);
  for (int k = 0; k < 6000; ++k) {
    const Vec3 along = random.direction(), aside = normalized(cross(along, random.direction())), third = cross(along, aside);
    const double angle = k % 3 == 0 ? random.log_uniform(1e-4, 1e2) : random.log_uniform(1e-12, 1e-4);
    const double gap = random.log_uniform(1e-10, 1.0);
    const Vec3 half_a = random.log_uniform(1e-1, 2.0) * along;
    const Vec3 half_b = random.log_uniform(1e-1, 2.0) * normalized(along + angle * aside);
    const Vec3 away[] = {gap * aside, gap * third, gap * random.direction(), {}};
    const Vec3 t = random.uniform(-1.0, 1.0) * half_a + away[k % 4] - random.uniform(-1.0, 1.0) * half_b;
    const SegmentPoints found = nearest_of_segments(-half_a, 2.0 * half_a, t - half_b, 2.0 * half_b);
    ASSERT_LE(norm(found.first + half_a - (2.0 * found.s) * half_a), 1e-14) << k;
    ASSERT_LE(norm(found.second - t + half_b - (2.0 * found.t) * half_b), 1e-14) << k;
    ASSERT_NEAR(norm(found.first - found.second), cmb::test::least_distance(half_a, half_b, t), 1e-14)
        << "sample " << k << ", angle " << angle << ", gap " << gap;
  }
}

}  // namespace
}  // namespace test_segment_distance
