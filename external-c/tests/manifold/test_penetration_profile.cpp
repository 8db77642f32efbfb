// The depth of one hull in another over the contact plane: its corners against all pairs of edges and vertices, for hulls of
// so many edges that those which may cross are found by a sweep.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "manifold/polytope/penetration_profile.hpp"
#include "shape/contact_polytope.hpp"
#include "shape/convex_hull.hpp"
#include "support/random_bodies.hpp"

namespace {

using namespace cmb;
using random_bodies::Random;

std::unique_ptr<ContactPolytope> hull(const std::vector<Vec3> &vertices) {
  convex::Polytope polytope;
  EXPECT_TRUE(convex::build_convex_hull(vertices, polytope, nullptr, nullptr));
  return std::make_unique<ContactPolytope>(std::move(polytope));
}

std::unique_ptr<ContactPolytope> random_hull(Random &random, int points, const Vec3 &half) {
  return hull(random_bodies::random_points(random, points, half, false));
}

// A body in the contact's axes; `up`: whether it looks at the other one along z.
struct Placed {
  const convex::Polytope &body;
  Pose pose;
  double up;

  // How far its surface reaches towards the other body over (x, y): the least height of its faces that look there.
  double height(double x, double y) const {
    double least = HUGE_VAL;
    for (const auto &face : body.faces()) {
      const Vec3 n = pose.rotation * face.normal;
      if (!(up * n.z > 0.0)) continue;
      const double z = (face.offset + dot(n, pose.translation) - n.x * x - n.y * y) / n.z;
      least = std::min(least, up * z);
    }
    return least;
  }
  bool looks_there(std::int32_t face) const {
    return up * (pose.rotation * body.faces()[static_cast<std::size_t>(face)].normal).z > 1e-6;
  }
  // Inside the body's outline, by some way.
  bool holds(double x, double y) const {
    double low = -HUGE_VAL;
    for (const auto &face : body.faces()) {
      const Vec3 n = pose.rotation * face.normal;
      if (up * n.z < 0.0) low = std::max(low, up * (face.offset + dot(n, pose.translation) - n.x * x - n.y * y) / n.z);
    }
    return height(x, y) > low + 1e-6;
  }
};

struct Expected {
  double x, y, depth;
};

// Corners that are there without doubt: between faces that look at the other body, deeper than `level` by some way.
std::vector<Expected> sure_corners(const Placed &a, const Placed &b, double level) {
  constexpr double clearly = 1e-6;
  std::vector<Expected> corners;
  for (const auto &[own, other] : {std::pair<const Placed &, const Placed &>{a, b}, {b, a}}) {
    for (const Vec3 &vertex : own.body.vertices()) {
      const Vec3 p = own.pose(vertex);
      if (std::fabs(own.up * p.z - own.height(p.x, p.y)) > 1e-9 || !other.holds(p.x, p.y)) continue;
      const double depth = own.up * p.z + other.height(p.x, p.y);
      if (depth > level + clearly) corners.push_back({p.x, p.y, depth});
    }
  }
  for (const auto &e : a.body.edges()) {
    if (!a.looks_there(e.face[0]) || !a.looks_there(e.face[1])) continue;
    const Vec3 from = a.pose(a.body.vertices()[static_cast<std::size_t>(e.vertex[0])]);
    const Vec3 along = a.pose(a.body.vertices()[static_cast<std::size_t>(e.vertex[1])]) - from;
    for (const auto &f : b.body.edges()) {
      if (!b.looks_there(f.face[0]) || !b.looks_there(f.face[1])) continue;
      const Vec3 start = b.pose(b.body.vertices()[static_cast<std::size_t>(f.vertex[0])]);
      const Vec3 way = b.pose(b.body.vertices()[static_cast<std::size_t>(f.vertex[1])]) - start, between = start - from;
      const double product = along.x * way.y - along.y * way.x;
      const double t = (between.x * way.y - between.y * way.x) / product;
      const double s = (between.x * along.y - between.y * along.x) / product;
      if (!(t > clearly && t < 1.0 - clearly && s > clearly && s < 1.0 - clearly)) continue;
      const Vec3 on_a = from + t * along, on_b = start + s * way;
      const double depth = on_b.z - on_a.z;
      if (depth > level + clearly) corners.push_back({on_a.x, on_a.y, depth});
    }
  }
  return corners;
}

TEST(PenetrationProfile, OfLargeHullsHasAllCornersAndNoOthers) {
  Random random(11);
  std::size_t most = 0;
  for (int sample = 0; sample < 12; ++sample) {
    const Vec3 half_above{1.0, random.uniform(0.5, 2.0), random.uniform(0.3, 1.0)};
    const Vec3 half_below{random.uniform(0.5, 2.0), 1.0, random.uniform(0.3, 1.0)};
    const auto above = random_hull(random, random.integer(60, 400), half_above);
    const auto below = random_hull(random, random.integer(60, 400), half_below);
    Pose pose_a{random_bodies::random_rotation(random), {}}, pose_b{random_bodies::random_rotation(random), {}};
    Placed a{above->geometry(), pose_a, -1.0}, b{below->geometry(), pose_b, 1.0};
    // Half a unit deep at most, and beside each other by some of it.
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Vec3 &vertex : a.body.vertices()) low = std::min(low, pose_a(vertex).z);
    for (const Vec3 &vertex : b.body.vertices()) high = std::max(high, pose_b(vertex).z);
    pose_a.translation = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), high - low - 0.5};
    a.pose = pose_a;
    PenetrationProfile graph;
    graph.place(*above, pose_a, *below, pose_b);
    for (const double level : {0.0, 0.05, 0.15}) {
      graph.find_corners(level);
      const std::vector<Expected> expected = sure_corners(a, b, level);
      most = std::max(most, expected.size());
      for (const Expected &wanted : expected) {
        const auto is_wanted = [&](const PenetrationProfile::Corner &corner) {
          return std::hypot(corner.middle.x - wanted.x, corner.middle.y - wanted.y) < 1e-7 &&
                 std::fabs(corner.depth - wanted.depth) < 1e-7;
        };
        EXPECT_TRUE(std::any_of(graph.corners().begin(), graph.corners().end(), is_wanted))
            << wanted.x << " " << wanted.y << " depth " << wanted.depth << " level " << level;
      }
      // What there is besides lies on outlines: all of it is on both surfaces.
      for (const PenetrationProfile::Corner &corner : graph.corners()) {
        EXPECT_GT(corner.depth, level);
        const double x = corner.middle.x, y = corner.middle.y;
        if (!a.holds(x, y) || !b.holds(x, y)) continue;
        EXPECT_NEAR(corner.depth, a.height(x, y) + b.height(x, y), 1e-7);
        EXPECT_NEAR(corner.middle.z, 0.5 * (b.height(x, y) - a.height(x, y)), 1e-7);
      }
      EXPECT_GE(graph.corners().size(), expected.size());
    }
  }
  EXPECT_GT(most, 200u);
}

// Turned about the contact normal the bodies are swept over in another direction.
TEST(PenetrationProfile, TurnedBodiesCarryTheSame) {
  Random random(12);
  const auto above = random_hull(random, 300, {1.0, 0.8, 0.5}), below = random_hull(random, 300, {1.2, 0.9, 0.4});
  const Pose pose_a{random_bodies::random_rotation(random), {0.1, -0.2, 0.55}};
  const Pose pose_b{random_bodies::random_rotation(random), {}};
  double first_sum = 0.0, first_load = 0.0;
  for (int turn = 0; turn < 8; ++turn) {
    const Pose about{random_bodies::rotation_about({0, 0, 1}, 0.77 * turn), {0.3 * turn, 0.1, 0.0}};
    const auto placed = [&](const Pose &pose) {
      Pose result = pose;
      for (int row = 0; row < 3; ++row) {
        Vec3 sum;
        for (int k = 0; k < 3; ++k) sum = sum + about.rotation.row[row][k] * pose.rotation.row[k];
        result.rotation.row[row] = sum;
      }
      result.translation = about(pose.translation);
      return result;
    };
    PenetrationProfile graph;
    graph.place(*above, placed(pose_a), *below, placed(pose_b));
    graph.find_corners(0.0);
    double sum = 0.0, load = 0.0;
    for (const PenetrationProfile::Corner &corner : graph.corners()) sum += corner.weight, load += corner.weight * corner.depth;
    if (turn == 0) first_sum = sum, first_load = load;
    EXPECT_NEAR(sum, first_sum, 1e-7 * first_sum);
    EXPECT_NEAR(load, first_load, 1e-7 * first_load);
  }
  EXPECT_GT(first_load, 0.0);
}

// The tip of a cone of so many sides that not all of them are looked at carries what a coarser one's does, upright and
// leaning until it looks at the other body with a part of its sides only.
TEST(PenetrationProfile, TipsOfManySidesCarryAsThoseOfFew) {
  const ContactPolytope ground(convex::Polytope::box({10, 10, 1}));
  const auto tip_of = [&](int sides, double lean, double slenderness) {
    std::vector<Vec3> vertices{{0, 0, 0}};
    for (int k = 0; k < sides; ++k) {
      const double angle = 6.283185307179586 * (k + 0.3) / sides;
      vertices.push_back({std::cos(angle), std::sin(angle), slenderness});
    }
    const auto cone = hull(vertices);
    PenetrationProfile graph;
    graph.place(*cone, {random_bodies::rotation_about({0, 1, 0}, lean), {0.1, 0.2, 0.45}}, ground, {});
    graph.find_corners(0.0);
    double weight = 0.0;
    for (const PenetrationProfile::Corner &corner : graph.corners()) {
      if (std::hypot(corner.middle.x - 0.1, corner.middle.y - 0.2) > 1e-9) continue;
      EXPECT_NEAR(corner.depth, 0.05, 1e-9);
      weight += corner.weight;
    }
    return weight;
  };
  for (const double slenderness : {0.5, 2.0, 6.0}) {
    for (const double lean : {0.0, 0.2, 0.4, 0.9, 1.3}) {
      // A tip's share tends to its limit as the length of its sides at the base.
      const double few = tip_of(60, lean, slenderness), limit = 2.0 * few - tip_of(30, lean, slenderness);
      EXPECT_NEAR(tip_of(600, lean, slenderness), limit + 0.1 * (few - limit), 2e-3 * limit)
          << "slenderness " << slenderness << " lean " << lean;
    }
  }
}

}  // namespace
