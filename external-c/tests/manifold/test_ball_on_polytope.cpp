// The surface of what ellipsoids and polytopes have in common.
#include <gtest/gtest.h>

#include <cmath>

#include "manifold/revolved/ball_on_polytope.hpp"
#include "math/pi.hpp"
#include "support/overlap_of.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_ball_on_polytope {
namespace {

using namespace cmb::test;
using cmb::convex::Polytope;
using random_bodies::Random;

// Sums of a surface that has to be closed.
struct Sums {
  Vec3 areas, moments;
  double whole = 0.0, size = 0.0;

  explicit Sums(const cmb::OverlapSurface &surface) {
    for (const auto *side : {&surface.of_a(), &surface.of_b()}) {
      for (const cmb::OverlapSurface::Node &node : *side) {
        areas = areas + node.area;
        moments = moments + cross(node.at, node.area);
        whole += norm(node.area);
        size = std::fmax(size, norm(node.at));
      }
    }
  }
};

// A cap of height h of the unit ball: pi h^2 (1 - h / 3), its middle 3 (2 - h)^2 / (4 (3 - h)) from the ball's.
TEST(BallOnPolytope, CapsAreThoseOfTheClosedForm) {
  const Polytope box = Polytope::box({4, 4, 4});
  cmb::BallOnPolytope finder;
  cmb::OverlapSurface surface;
  for (const double h : {1e-9, 1e-6, 1e-3, 0.1, 0.5, 1.0, 1.5, 1.9, 1.999}) {
    ASSERT_TRUE(finder.find({1, 1, 1}, box, {{}, {0.0, 0.0, -3.0 + h}}, {0, 0, -1.0 + 0.5 * h}, surface)) << h;
    const double rounding = 1e-11 + 1e-15 / h;
    EXPECT_NEAR(surface.volume() / (cmb::pi * h * h * (1.0 - h / 3.0)), 1.0, rounding) << h;
    const double middle = (surface.place() + surface.middle()).z;
    EXPECT_NEAR((middle + 3.0 * (2.0 - h) * (2.0 - h) / (4.0 * (3.0 - h))) / h, 0.0, rounding) << h;
  }
}

// Closed, with the volume of slices (src/volume/), which share no code with it.
TEST(BallOnPolytope, SurfacesAreClosedAndHoldTheVolume) {
  Random random(7);
  int compared = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 semi{random.uniform(0.1, 0.6), random.uniform(0.1, 0.6), random.uniform(0.1, 0.6)};
    const Vec3 size{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    const Polytope box = Polytope::box(size);
    Vec3 place;  // in both
    do {
      place = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    } while (norm2(place) >= 1.0);
    place = {semi.x * place.x, semi.y * place.y, semi.z * place.z};
    const Vec3 in_box{random.uniform(-0.5, 0.5) * size.x, random.uniform(-0.5, 0.5) * size.y, random.uniform(-0.5, 0.5) * size.z};
    const Mat3 rotation = k % 8 == 0 ? Mat3{} : random_bodies::random_rotation(random);
    cmb::BallOnPolytope finder;
    cmb::OverlapSurface surface;
    ASSERT_TRUE(finder.find(semi, box, {rotation, place - rotation * in_box}, place, surface)) << k;
    const Sums sums(surface);
    EXPECT_LT(norm(sums.areas), 1e-10 * sums.whole) << k;
    EXPECT_LT(norm(sums.moments), 1e-10 * sums.whole * sums.size) << k;
    if (k % 20 != 0) continue;
    ++compared;
    const auto text = [](const Vec3 &v) { return digits(v.x) + "," + digits(v.y) + "," + digits(v.z); };
    const PairScene scene("cmb/1 ellipsoid size=" + text(2.0 * semi), "cmb/1 box size=" + text(size));
    const double volume = overlap_of(scene, {}, {place - rotation * in_box, rotation}).volume;
    EXPECT_NEAR(surface.volume(), volume, 1e-8 * volume) << k;
  }
  EXPECT_EQ(compared, 100);
}

// What a wall leaves of a shallow cap, which is a lens as narrow as 1:20: seen from below a segment of the cap's circle.
TEST(BallOnPolytope, CutCapsAreThoseOfTheClosedForm) {
  const Polytope box = Polytope::box({4, 4, 4});
  for (const double h : {1e-4, 1e-3, 1e-2}) {
    const double rim = std::sqrt(h * (2.0 - h));
    for (const double u : {0.0, 0.5, 0.8, 0.88, 0.9, 0.93, 0.96, 0.99}) {
      const cmb::convex::Pose pose{{}, {u * rim + 2.0, 0.0, -3.0 + h}};
      cmb::BallOnPolytope finder;
      cmb::OverlapSurface surface;
      ASSERT_TRUE(finder.find({1, 1, 1}, box, pose, {0.5 * (1.0 + u) * rim, 0.0, -1.0 + h - 0.1 * h * (1.0 - u * u)}, surface)) << h << " " << u;
      ASSERT_TRUE(finder.find({1, 1, 1}, box, pose, surface.place() + surface.middle(), surface)) << h << " " << u;
      const double segment = rim * rim * (std::acos(u) - u * std::sqrt(1.0 - u * u));
      double below = 0.0;
      for (const cmb::OverlapSurface::Node &node : surface.of_a()) below -= node.area.z;
      EXPECT_NEAR(below / segment, 1.0, 1e-9) << h << " " << u;
      EXPECT_LT(norm(Sums(surface).areas), 1e-9 * segment) << h << " " << u;
    }
  }
}

// Of a needle that an edge cuts into from the side: planes that are as good as one by its own measure.
TEST(BallOnPolytope, SurfaceOfSliversStaysWithinThem) {
  Random random(3);
  for (int k = 0; k < 500; ++k) {
    const double thin = random.log_uniform(3e-4, 0.1), deep = random.log_uniform(1e-5, 0.3) * thin;
    const Vec3 semi{thin, random.uniform(0.5, 1.0) * thin, 1.0};
    const Polytope box = Polytope::box({1, 1, 1});
    const double height = random.uniform(-0.8, 0.8), inside = (1.0 - deep / thin) * std::sqrt(1.0 - height * height);
    const Vec3 edge{inside * thin, 0.0, height};
    // The box's edge along the needle's y, its diagonal along x, then about x and y.
    const double eighth = 0.25 * cmb::pi;
    const Mat3 rotation = product(product(rotation_about({1, 0, 0}, random.uniform(-1, 1)), rotation_about({0, 1, 0}, random.uniform(-0.5, 0.5))),
                                  rotation_about({0, 1, 0}, eighth));
    const Vec3 to_edge = rotation * Vec3{-0.5, 0.0, -0.5}, out = rotation * Vec3{-std::sqrt(0.5), 0.0, -std::sqrt(0.5)};
    const cmb::convex::Pose pose{rotation, edge - to_edge};
    cmb::BallOnPolytope finder;
    cmb::OverlapSurface surface;
    if (!finder.find(semi, box, pose, edge - 0.3 * deep * out, surface)) continue;
    ASSERT_TRUE(finder.find(semi, box, pose, surface.place() + surface.middle(), surface)) << k;
    double beyond = 0.0, thick = 0.0;
    for (const cmb::OverlapSurface::Node &node : surface.of_a()) {
      const Vec3 in_box = pose.inverse()(surface.place() + node.at);
      beyond = std::fmax(beyond, std::fmax(-0.5 - in_box.x, -0.5 - in_box.z));
      thick = std::fmax(thick, std::fmin(0.5 + in_box.x, 0.5 + in_box.z));
    }
    EXPECT_LT(beyond, 2.0 * thick) << k << ": " << thin << " thin, " << deep << " deep";
    const Sums sums(surface);
    // Rounding moves the edge by 1e-16, which is a part of the depth.
    EXPECT_LT(norm(sums.areas), (1e-10 + 1e-13 / deep) * sums.whole) << k;
  }
}

}  // namespace
}  // namespace test_ball_on_polytope
