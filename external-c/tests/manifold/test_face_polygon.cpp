// Places in polygons some of whose corners are one but for rounding.
#include <gtest/gtest.h>

#include <vector>

#include "manifold/revolved/face_polygon.hpp"
#include "support/random_bodies.hpp"

namespace test_face_polygon {
namespace {

using cmb::convex::Vec3;
using random_bodies::Random;

TEST(FacePolygon, HoldsWhatIsInItWhereverItsShortestSidesLead) {
  Random random(1);
  for (int k = 0; k < 20000; ++k) {
    const Vec3 normal = random.direction(), u = cmb::convex::any_perpendicular(normal), v = cross(normal, u);
    std::vector<Vec3> corners;
    const int count = random.integer(3, 6);
    for (int i = 0; i < count; ++i) {
      const double angle = (i + random.uniform(-0.2, 0.2)) * 2.0 * 3.14159265358979323846 / count;
      const Vec3 corner = std::cos(angle) * u + std::sin(angle) * v;
      for (int twin = random.integer(0, 2); twin >= 0; --twin) corners.push_back(corner + 1e-15 * random.direction());
    }
    // About the middle a circle of this radius is in the polygon; beyond the corners nothing is.
    const double angle = random.uniform(-4, 4), in = 0.05, out = random.uniform(1.01, 3);
    const Vec3 direction = std::cos(angle) * u + std::sin(angle) * v;
    const auto is_in = [&](const Vec3 &at) {
      return cmb::is_in_polygon(static_cast<std::int32_t>(corners.size()), [&](std::int32_t i) { return corners[static_cast<std::size_t>(i)]; },
                                normal, at);
    };
    ASSERT_TRUE(is_in(in * direction)) << k;
    ASSERT_FALSE(is_in(out * direction)) << k;
  }
}

}  // namespace
}  // namespace test_face_polygon
