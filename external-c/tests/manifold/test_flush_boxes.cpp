// Boxes flush on each other: the corners of what their faces have in common, against a polygon clipped for the purpose, and
// against the depth's graph of boxes that are all but flush.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "manifold/polytope/flush_boxes.hpp"
#include "manifold/polytope/penetration_profile.hpp"
#include "shape/contact_polytope.hpp"
#include "support/poses.hpp"
#include "support/random_bodies.hpp"

namespace {

using namespace cmb;
using random_bodies::Random;
using random_bodies::rotation_about;

constexpr double pi = 3.14159265358979323846;

// A face in the plane z = 0, its corners counter-clockwise.
std::vector<Vec3> face_corners(const Vec3 &half, const Pose &pose) {
  std::vector<Vec3> corners;
  for (const auto &[s, t] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
    corners.push_back(pose.translation + pose.rotation * Vec3{s * half.x, t * half.y, 0.0});
  }
  return corners;
}

// What `polygon` and the convex `window` have in common, both counter-clockwise (Sutherland and Hodgman 1974).
std::vector<Vec3> clipped(std::vector<Vec3> polygon, const std::vector<Vec3> &window) {
  for (std::size_t k = 0; k < window.size(); ++k) {
    const Vec3 &from = window[k], along = window[(k + 1) % window.size()] - from;
    const auto left = [&](const Vec3 &p) { return along.x * (p.y - from.y) - along.y * (p.x - from.x); };
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      if (left(p) >= 0.0) kept.push_back(p);
      if ((left(p) >= 0.0) != (left(q) >= 0.0)) kept.push_back(p + (left(p) / (left(p) - left(q))) * (q - p));
    }
    polygon = kept;
  }
  return polygon;
}

struct Sums {
  double part = 0.0;
  Vec3 place;

  void add(double weight, double x, double y) { part += weight, place = place + weight * Vec3{x, y, 0.0}; }
};

Sums of_exterior_angles(const std::vector<Vec3> &polygon) {
  Sums sums;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &p = polygon[k], in = p - polygon[(k + polygon.size() - 1) % polygon.size()];
    const Vec3 out = polygon[(k + 1) % polygon.size()] - p;
    sums.add(std::atan2(norm(cross(in, out)), dot(in, out)) / (2.0 * pi), p.x, p.y);
  }
  return sums;
}

Sums sums_of(const FlushBoxes &boxes) {
  Sums sums;
  for (const FlushBoxes::Corner &corner : boxes) sums.add(corner.part, corner.x, corner.y);
  return sums;
}

Sums sums_of(const PenetrationProfile &graph) {
  Sums sums;
  for (const PenetrationProfile::Corner &corner : graph.corners()) sums.add(corner.weight, corner.middle.x, corner.middle.y);
  return sums;
}

void expect_near(const Sums &found, const Sums &expected, double tolerance, const char *what, int sample) {
  EXPECT_NEAR(found.part, expected.part, tolerance) << what << " " << sample;
  EXPECT_NEAR(found.place.x, expected.place.x, tolerance) << what << " " << sample;
  EXPECT_NEAR(found.place.y, expected.place.y, tolerance) << what << " " << sample;
}

Vec3 random_half(Random &random) { return {random.uniform(0.2, 1.0), random.uniform(0.2, 1.0), 0.5}; }

// Turned about the vertical and moved along the plane z = 0.
Pose random_pose(Random &random) {
  return {rotation_about({0, 0, 1}, random.uniform(-pi, pi)), {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), 0.0}};
}

TEST(FlushBoxes, CarryByTheExteriorAnglesOfWhatTheirFacesHaveInCommon) {
  Random random(1);
  FlushBoxes boxes;
  for (int sample = 0; sample < 2000; ++sample) {
    const Vec3 half_a = random_half(random), half_b = random_half(random);
    const Pose a = random_pose(random), b = random_pose(random);
    const std::vector<Vec3> common = clipped(face_corners(half_a, a), face_corners(half_b, b));
    ASSERT_TRUE(boxes.find(half_a, a, half_b, b, {}));
    ASSERT_EQ(boxes.end() - boxes.begin(), static_cast<std::ptrdiff_t>(common.size())) << sample;
    expect_near(sums_of(boxes), of_exterior_angles(common), 1e-12, "sample", sample);
  }
}

// Two boxes, A `depth` deep on B, seen with the contact's axes.
class TwoBoxes {
 public:
  TwoBoxes(const Vec3 &half_a, const Pose &a, const Vec3 &half_b, const Pose &b)
      : box_a_(convex::Polytope::box(2.0 * half_a)), box_b_(convex::Polytope::box(2.0 * half_b)), a_(a), b_(b) {
    a_.translation.z = half_a.z - 0.5 * depth, b_.translation.z = -half_b.z + 0.5 * depth;
  }
  // A tilted by that angle.
  Sums at(double tilt) {
    Pose tilted = a_;
    tilted.rotation = test::product(rotation_about({0.6, 0.8, 0}, tilt), a_.rotation);
    graph_.place(box_a_, tilted, box_b_, b_);
    graph_.find_corners(0.0);
    for (const PenetrationProfile::Corner &corner : graph_.corners()) EXPECT_NEAR(corner.depth, depth, 2.0 * tilt + 1e-15);
    return sums_of(graph_);
  }

 private:
  static constexpr double depth = 0.01;
  ContactPolytope box_a_, box_b_;
  Pose a_, b_;
  PenetrationProfile graph_;
};

TEST(FlushBoxes, AreTheLimitOfTiltedOnes) {
  Random random(2);
  FlushBoxes boxes;
  for (int sample = 0; sample < 500; ++sample) {
    const Vec3 half_a = random_half(random), half_b = random_half(random);
    const Pose a = random_pose(random), b = random_pose(random);
    TwoBoxes both(half_a, a, half_b, b);
    const Sums flush = both.at(0.0);
    ASSERT_TRUE(boxes.find(half_a, a, half_b, b, {}));
    expect_near(flush, sums_of(boxes), 1e-9, "flush", sample);
    for (const double tilt : {1e-12, 1e-9, 1e-6}) {
      ASSERT_FALSE(boxes.find(half_a, {rotation_about({1, 0, 0}, tilt), {}}, half_b, b, {}));
      expect_near(both.at(tilt), flush, 100.0 * tilt + 1e-9, "tilted", sample);
    }
  }
}

TEST(FlushBoxes, AreTheLimitWhereSidesAndCornersAreFlushToo) {
  // Equal boxes on quarters of each other, turned by right angles and by half of them.
  const Vec3 half{0.5, 0.5, 0.5};
  int sample = 0, wholly = 0;
  for (int turn = 0; turn < 8; ++turn) {
    for (int x = -3; x <= 3; ++x) {
      for (int y = -3; y <= 3; ++y, ++sample) {
        TwoBoxes both(half, {rotation_about({0, 0, 1}, 0.25 * pi * turn), {0.25 * x, 0.25 * y, 0.0}}, half, {});
        const Sums flush = both.at(0.0);
        expect_near(both.at(1e-12), flush, 1e-9, "sample", sample);
        if (turn % 2 == 0) {
          EXPECT_NEAR(flush.part, 1.0, 1e-12) << sample;
        }
        wholly += std::fabs(flush.part - 1.0) < 1e-9 ? 1 : 0;
      }
    }
  }
  EXPECT_GE(wholly, sample - 16);  // half turned, a corner may be beside a corner
}

}  // namespace
