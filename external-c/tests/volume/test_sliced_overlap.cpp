// Integrals by slices: closed forms, whatever guess is given, and nothing where there is nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scene/descriptor.hpp"
#include "support/mesh_text.hpp"
#include "support/poses.hpp"
#include "volume/curved_overlap.hpp"
#include "volume/mesh_overlap.hpp"
#include "volume/slices/sliced_overlap.hpp"

namespace test_sliced_overlap {
namespace {

using namespace cmb;
using namespace cmb::overlap;
using cmb::test::rotation_about;

constexpr double pi = 3.14159265358979323846;

Shape shape(const std::string &text) { return parse_descriptor("cmb/1 " + text).front(); }

RoundSolid ball(double radius, const Vec3 &center) {
  return RoundSolid(shape("sphere radius=" + cmb::test::digits(radius)), {Mat3{}, center});
}

double cap(double radius, double height) { return pi * height * height * (3.0 * radius - height) / 3.0; }

// The common part of a box and round solids, for all guesses: none, good ones, ones outside.
class FromAnyGuess {
 public:
  FromAnyGuess(const Vec3 &low, const Vec3 &high, std::vector<RoundSolid> rounds) : rounds_(std::move(rounds)) {
    flat_.start_box(low, high);
  }
  void cut(const Vec3 &normal, double offset) { flat_.cut(normal, offset, 5, false); }

  // `rounding`: how far off the volume is by where planes lie, to rounding.
  void expect_volume(double volume, const std::vector<double> &good, const char *what, double rounding = 0.0) {
    std::vector<std::vector<double>> guesses = {{}, {-1e3, 1e3}, {low(), high()}};
    for (const double y : good) guesses.push_back({y});
    for (const auto &guess : guesses) {
      const SlicedSums sums = slices_.measure({&flat_, rounds_.data(), static_cast<int>(rounds_.size()), 5}, guess.data(),
                                              static_cast<int>(guess.size()), 3e-11);
      EXPECT_NEAR(sums.solid.volume, volume, 1e-9 * volume + rounding) << what << ", " << guess.size() << " guesses";
      EXPECT_NEAR(sums.solid.upper.area, sums.solid.lower.area, 1e-8 * sums.solid.upper.area) << what;
      marked = sums.marked;
    }
  }

  SideSums marked;

 private:
  double low() const { return flat_.vertices().front().y; }
  double high() const { return flat_.vertices().back().y; }

  convex::OverlapScratch flat_;
  std::vector<RoundSolid> rounds_;
  SlicedOverlap slices_;
};

TEST(SlicedOverlap, OneBallNeedsNoGuess) {
  const Vec3 low{-3, -3, -3}, high{3, 3, 3};
  FromAnyGuess(low, high, {ball(1.0, {0.5, 0.4, 0.3})}).expect_volume(4.0 / 3.0 * pi, {0.4}, "inside");
  FromAnyGuess(low, high, {ball(1.0, {3.4, 0.2, 0.1})}).expect_volume(cap(1.0, 0.6), {0.2}, "through a face");
  FromAnyGuess(low, high, {ball(1.0, {0.2, 3.4, 0.1})}).expect_volume(cap(1.0, 0.6), {2.9}, "through the face at the end");
  FromAnyGuess(low, high, {ball(1.0, {3.0, 0.1, 3.0})}).expect_volume(pi / 3.0, {0.1}, "an edge in its middle");
  FromAnyGuess(low, high, {ball(1.0, {0.1, -3.0, 3.0})}).expect_volume(pi / 3.0, {-2.5}, "an edge across");
  FromAnyGuess(low, high, {ball(1.0, {3.0, 3.0, 3.0})}).expect_volume(pi / 6.0, {2.9}, "a corner in its middle");
  FromAnyGuess(low, high, {ball(9.0, {1.0, 0.5, 0.3})}).expect_volume(216.0, {0.0}, "around the box");
  FromAnyGuess(low, high, {ball(1.0, {3.0, 4.01, 0.1})}).expect_volume(0.0, {2.99}, "beside");
}

TEST(SlicedOverlap, TwoBallsNeedNoGuess) {
  const Vec3 low{-3, -3, -3}, high{3, 3, 3};
  for (const Vec3 &way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.36, 0.48, 0.8}}) {
    for (const double apart : {0.3, 1.2, 1.9}) {
      FromAnyGuess(low, high, {ball(1.0, {0.1, 0.2, 0.3}), ball(1.0, Vec3{0.1, 0.2, 0.3} + apart * way)})
          .expect_volume(2.0 * cap(1.0, 1.0 - 0.5 * apart), {0.2 + 0.5 * apart * way.y}, "a lens");
    }
    FromAnyGuess(low, high, {ball(1.0, {0.1, 0.2, 0.3}), ball(0.4, Vec3{0.1, 0.2, 0.3} + 0.5 * way)})
        .expect_volume(4.0 / 3.0 * pi * 0.064, {0.2 + 0.5 * way.y}, "one in the other");
    FromAnyGuess(low, high, {ball(1.0, {0.1, 0.2, 0.3}), ball(1.0, Vec3{0.1, 0.2, 0.3} + 2.1 * way)})
        .expect_volume(0.0, {0.2}, "side by side");
  }
  // Half a lens, half of half of it, and one ball beyond the box.
  FromAnyGuess(low, high, {ball(1.0, {3, 0.2, -0.6}), ball(1.0, {3, 0.2, 0.6})}).expect_volume(cap(1.0, 0.4), {0.2}, "half");
  FromAnyGuess(low, high, {ball(1.0, {3, 3, -0.6}), ball(1.0, {3, 3, 0.6})})
      .expect_volume(0.5 * cap(1.0, 0.4), {2.9}, "edge");
  FromAnyGuess(low, high, {ball(1.0, {0, 2.5, 0}), ball(1.0, {0, 4.2, 0})}).expect_volume(0.0, {2.6}, "beyond the box");
}

// Where neighbouring numbers lie farther apart than the slices' precision. Centres are rounded likewise.
TEST(SlicedOverlap, EndsFarFromTheOrigin) {
  for (const double radius : {1e-5, 1e-7, 1e-9}) {
    const Vec3 center{0.0, 1.0, 0.0}, reach{2 * radius, 2 * radius, 2 * radius};
    FromAnyGuess corner(center - reach, center + reach, {ball(radius, center)});
    corner.cut({0.6, 0.8, 0.0}, 0.8);
    corner.cut({-0.6, 0.8, 0.0}, 0.8);
    // What is left of the ball within the wedge.
    const double angle = pi - 2.0 * std::acos(0.8), volume = angle / (2.0 * pi) * 4.0 / 3.0 * pi * radius * radius * radius;
    corner.expect_volume(volume, {1.0 - 0.5 * radius}, "a wedge of a ball", 1e-15 * radius * radius);
  }
}

TEST(SlicedOverlap, MarkedFacesAreTakenApart) {
  // A ball cut level above its middle: the face is the circle.
  FromAnyGuess half({-3, -3, -3}, {3, 3, 3}, {ball(1.0, {0.2, 0.1, 0.0})});
  half.cut({0, 0, 1}, 0.6);
  half.expect_volume(4.0 / 3.0 * pi - cap(1.0, 0.4), {0.1}, "cut");
  EXPECT_NEAR(half.marked.area, 0.64 * pi, 1e-8);
  EXPECT_NEAR(half.marked.x, 0.2 * 0.64 * pi, 1e-8);
  EXPECT_NEAR(half.marked.height, 0.6 * 0.64 * pi, 1e-8);
}

// A cone whose mantle lines are at 45 degrees to its axis, the slices along one of them: parabolas.
TEST(SlicedOverlap, ConesInParabolas) {
  for (const double side : {1.0, -1.0}) {
    const Pose pose{rotation_about({1, 0, 0}, side * 0.25 * pi), {0.1, 0.2, 0.3}};
    const RoundSolid cone(shape("cone radius=0.8 length=0.8"), pose);
    FromAnyGuess whole({-3, -3, -3}, {3, 3, 3}, {cone}), right(whole), left(whole);
    for (FromAnyGuess *part : {&whole, &right, &left}) {
      cone.visit_flat_ends([&](const Vec3 &normal, double offset) { part->cut(normal, offset); });
    }
    const double volume = pi / 3.0 * 0.64 * 0.8;
    whole.expect_volume(volume, {0.2}, "a cone");
    right.cut({-1, 0, 0}, -0.1), left.cut({1, 0, 0}, 0.1);
    right.expect_volume(0.5 * volume, {0.2}, "its right half");
    left.expect_volume(0.5 * volume, {0.2}, "its left half");
  }
}

TEST(SlicedOverlap, CutsAddUp) {
  // Of a cone and a capsule that cross: what lies on both sides of a plane, whatever the plane.
  const RoundSolid cone(shape("cone radius=0.8 length=2"), {rotation_about({1, 0, 0}, 0.7), {0.1, 0.2, -0.1}});
  const RoundSolid capsule(shape("capsule radius=0.4 length=1.5"), {rotation_about({0, 1, 0}, 1.9), {-0.1, 0.1, 0.2}});
  const auto volume = [&](const Vec3 &normal, double offset) {
    convex::OverlapScratch flat;
    flat.start_box({-3, -3, -3}, {3, 3, 3});
    cone.visit_flat_ends([&](const Vec3 &n, double at) { flat.cut(n, at, -1, false); });
    if (norm(normal) > 0.0) flat.cut(normal, offset, 0, false);
    const RoundSolid rounds[2] = {cone, capsule};
    SlicedOverlap slices;
    return slices.measure({&flat, rounds, 2}, nullptr, 0, 3e-11).solid.volume;
  };
  const double whole = volume({}, 0.0);
  EXPECT_GT(whole, 0.1);
  int both = 0;
  for (int k = 0; k < 20; ++k) {
    const Vec3 normal = normalized(Vec3{std::cos(2.0 * k), std::sin(2.0 * k), std::cos(5.0 * k)});
    const double offset = 0.05 * (k % 5 - 2);
    const double below = volume(normal, offset), above = volume(-normal, -offset);
    EXPECT_NEAR(below + above, whole, 1e-9 * whole) << k;
    both += below > 0.01 * whole && above > 0.01 * whole;
  }
  EXPECT_GT(both, 10);
}

TEST(SlicedOverlap, SliversOfPolytopesHoldTheirShare) {
  // A prism a billionth wide through a ball, at a right angle to the slices and along them: the chord's length.
  for (const double width : {1e-3, 1e-6, 1e-9}) {
    for (const double turn : {0.0, 0.5 * pi, 0.3}) {
      FromAnyGuess sliver({-3, -3, -3}, {3, 3, 3}, {ball(1.0, {0.2, 0.1, 0.3})});
      const Vec3 across{std::cos(turn), std::sin(turn), 0.0};
      const double middle = dot(across, {0.2, 0.1, 0.3});
      sliver.cut(across, middle + 0.5 * width), sliver.cut(-across, 0.5 * width - middle);
      const double half = 0.5 * width;
      sliver.expect_volume(2.0 * pi * (half - half * half * half / 3.0), {0.1}, "a sliver", 2.0 * pi * 1e-15);
    }
  }
}

// What only a wrong hint leads to: the answer is that there is nothing.
TEST(CurvedOverlap, OfBodiesApartIsNothing) {
  CurvedScratch scratch;
  const DeepestPoints hint{{0, 0, 1}, {0, 0, -0.1}, {0, 0, -0.2}};
  const std::vector<Shape> shapes = {shape("sphere radius=1"), shape("cylinder radius=1 length=2"),
                                     shape("cone radius=1 length=2"), shape("box size=2,2,2"),
                                     shape("capsule radius=1 length=1")};
  for (const Shape &a : shapes) {
    for (const Shape &b : shapes) {
      if (a.polytope && b.polytope) continue;
      for (const Vec3 &place : {Vec3{9, 0, 0}, Vec3{0, 9, 0}, Vec3{0, 0, -9}, Vec3{1.75, 1.75, 1.75}}) {
        if (place.x == 1.75 && (a.polytope || b.polytope)) continue;  // corners reach as far
        const Pose turned{rotation_about({0, 0, 1}, 0.25 * pi), {}};
        const ShapeOverlap overlap = curved_overlap(a, {Mat3{}, place}, b, turned, hint, scratch);
        EXPECT_EQ(overlap.volume, 0.0);
        EXPECT_EQ(overlap.patch_area, 0.0);
      }
    }
  }
}

TEST(MeshOverlap, OfBodiesApartIsNothing) {
  MeshOverlapScratch scratch;
  const Shape cube = parse_descriptor(mesh_samples::mesh_text(mesh_samples::with_speck(mesh_samples::box_mesh({2, 2, 2}), {0, 40, 0}))).front();
  for (const Shape &a : {shape("sphere radius=1"), shape("box size=2,2,2"), cube}) {
    for (const Vec3 &place : {Vec3{9, 0, 0}, Vec3{0, 9, 0}, Vec3{0, 0, 9}, Vec3{0, 0, -9}, Vec3{2.01, 0, 0}}) {
      EXPECT_EQ(mesh_overlap(a, {Mat3{}, place}, cube, {}, {0, 0, 1}, {}, scratch).volume, 0.0);
    }
  }
  EXPECT_EQ(mesh_and_halfspace(cube, {Mat3{}, {0, 0, 1.5}}, {}, scratch).volume, 0.0);
}

TEST(RoundSolid, OfAnotherKindHasNoSurface) {
  const RoundSolid box(shape("box size=1,1,1"), {});
  EXPECT_EQ(box.pieces(), 0);
  EXPECT_FALSE(RoundSolid::is_round(shape("box size=1,1,1")));
  EXPECT_TRUE(RoundSolid::is_round(shape("cone radius=1 length=1")));
}

}  // namespace
}  // namespace test_sliced_overlap
