// The features nearest to the points of lines, against the distance of each point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/index.hpp"
#include "narrowphase/polytope/nearest_features.hpp"
#include "support/random_bodies.hpp"

namespace test_nearest_features {
namespace {

using namespace cmb::convex;
using cmb::index;
using random_bodies::Random;

// The signed distance of p from the feature: where it is a face, from its plane.
double distance_to(const Polytope &polytope, const Feature &feature, const Vec3 &p) {
  if (feature.kind == FeatureKind::face) {
    const Polytope::Face &face = polytope.faces()[index(feature.index)];
    return dot(face.normal, p) - face.offset;
  }
  if (feature.kind == FeatureKind::vertex) return norm(p - polytope.vertices()[index(feature.index)]);
  const Vec3 &along = polytope.edge_directions()[index(feature.index)];
  const Vec3 arm = p - polytope.vertices()[index(polytope.edges()[index(feature.index)].vertex[0])];
  return norm(arm - dot(arm, along) * along);
}

struct Walked {
  int pieces = 0, inside = 0;
  double error = 0.0;
};

// Follows the line from `place` and compares the middle of each stretch.
void follow(const Polytope &polytope, const Vec3 &place, const Vec3 &way, const Feature &near, Walked &walked) {
  constexpr double length = 3.0;
  static DistanceScratch scratch;
  FacesAlongLine room;
  NearestFeatures nearest(polytope, place, way, near, room);
  ASSERT_TRUE(nearest.found());
  nearest.start(1.0, length);
  const ConvexBody body = make_polytope(polytope), point = make_sphere(0.0);
  double from = 0.0;
  for (std::size_t step = 0;; nearest.next()) {
    ASSERT_LT(++step, 4 * polytope.edges().size());
    const double to = std::min(nearest.end(), length);
    const Vec3 p = place + 0.5 * (from + to) * way;
    const double expected = signed_distance(body, point, {{}, p}, scratch).distance;
    walked.error = std::max(walked.error, std::fabs(distance_to(polytope, nearest.feature(), p) - expected));
    ++walked.pieces;
    if (expected < 0.0) ++walked.inside;
    if (to >= length) return;
    from = to;
  }
}

TEST(NearestFeatures, AreThoseOfThePointsOfRandomLines) {
  Random random(5);
  Walked walked;
  for (int sample = 0; sample < 300; ++sample) {
    Polytope polytope = Polytope::box({random.uniform(0.2, 2), random.uniform(0.2, 2), random.uniform(0.2, 2)});
    if (sample % 3 != 0) {
      ASSERT_TRUE(build_convex_hull(random_bodies::random_points(random, sample % 3 == 1 ? 12 : 80, {1, 0.8, 0.6}, false), polytope,
                                    nullptr, nullptr));
    }
    for (int line = 0; line < 10; ++line) {
      const Vec3 place = random.uniform(0, 2) * random.direction(), way = random.direction();
      follow(polytope, place, way, {}, walked);
      follow(polytope, place, -way, {}, walked);
      follow(polytope, place + 4.0 * random.direction(), way, {FeatureKind::vertex, 0}, walked);
    }
  }
  EXPECT_LT(walked.error, 1e-12);
  EXPECT_GT(walked.pieces, 20000);
  EXPECT_GT(walked.inside, 2000);
}

// Through corners, along edges and in the planes of faces, where several features are equally near.
TEST(NearestFeatures, AreFoundWhereSeveralAreEquallyNear) {
  const Polytope box = Polytope::box({1, 1, 1});
  Walked walked;
  for (int code = 0; code < 27 * 27; ++code) {
    const auto of = [](int k) { return Vec3{k % 3 - 1.0, k / 3 % 3 - 1.0, k / 9 % 3 - 1.0}; };
    if (norm2(of(code / 27)) == 0.0) continue;
    const Vec3 way = normalized(of(code / 27));
    for (const double far : {0.25, 0.5, 1.0}) follow(box, far * of(code % 27), way, {}, walked);
  }
  EXPECT_LT(walked.error, 1e-15);
  EXPECT_GT(walked.inside, 1000);
}

}  // namespace
}  // namespace test_nearest_features
