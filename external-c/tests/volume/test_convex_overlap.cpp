// Overlaps of polytopes: closed forms, an independent reference and properties.
#include <gtest/gtest.h>

#include "support/random_bodies.hpp"
#include "support/reference_overlap.hpp"
#include "volume/convex_overlap.hpp"

namespace test_convex_overlap {
namespace {

using namespace cmb::convex;
using namespace random_bodies;
using reference::Real;

void expect_near(const Vec3 &v, const Vec3 &expected, double tolerance) {
  EXPECT_NEAR(v.x, expected.x, tolerance);
  EXPECT_NEAR(v.y, expected.y, tolerance);
  EXPECT_NEAR(v.z, expected.z, tolerance);
}

TEST(ClosedForm, AlignedBoxes) {
  OverlapScratch scratch;
  const Polytope a = Polytope::box({2, 3, 4}), b = Polytope::box({1, 1, 1});
  for (double depth : {1e-7, 1e-3, 0.3}) {
    const Overlap o = convex_overlap(a, b, {Mat3{}, {0.7, 0.2, 2.5 - depth}}, {0, 0, -1}, scratch);
    EXPECT_NEAR(o.volume, 0.8 * depth, 1e-15);  // rounding of the pose
    EXPECT_NEAR(o.patch_area, 0.8, 1e-12);
    expect_near(o.centroid, {0.6, 0.2, 2 - depth / 2}, 1e-9);
    expect_near(o.patch_centroid, {0.6, 0.2, 2 - depth / 2}, 1e-12);
    EXPECT_NEAR(o.patch_moment.row[0].x, 0.8 * 0.8 * 0.8 / 12, 1e-12);
    EXPECT_NEAR(o.patch_moment.row[1].y, 0.8 / 12, 1e-12);
    EXPECT_NEAR(o.patch_moment.row[0].y, 0, 1e-12);
    EXPECT_NEAR(o.patch_moment.row[2].z, 0, 1e-12);
  }
}

TEST(ClosedForm, CoincidentCubes) {
  OverlapScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  const Overlap o = convex_overlap(cube, cube, Pose{}, {0, 0, 1}, scratch);
  EXPECT_NEAR(o.volume, 1, 1e-15);
  EXPECT_NEAR(o.patch_area, 1, 1e-15);
  expect_near(o.centroid, {0, 0, 0}, 1e-15);
}

TEST(ClosedForm, CubeTurnedByAnEighthOfATurnHasAnOctagonInCommon) {
  OverlapScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  const Pose pose{rotation_about({0, 0, 1}, std::atan(1.0)), {0, 0, 0.9}};
  const Overlap o = convex_overlap(cube, cube, pose, {0, 0, -1}, scratch);
  const double octagon = 2 * (std::sqrt(2.0) - 1);
  EXPECT_NEAR(o.volume, 0.1 * octagon, 1e-14);
  EXPECT_NEAR(o.patch_area, octagon, 1e-14);
  expect_near(o.patch_centroid, {0, 0, 0.45}, 1e-14);
}

TEST(ClosedForm, CornerInAFaceIsATetrahedron) {
  OverlapScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  const double depth = 1e-3;
  const Mat3 on_corner = rotation_about(normalized({1, -1, 0}), std::acos(1 / std::sqrt(3.0)));
  const Pose pose{on_corner, {0, 0, 0.5 + std::sqrt(0.75) - depth}};
  const Overlap o = convex_overlap(cube, cube, pose, {0, 0, -1}, scratch);
  // A right corner cut at height h: volume h^3 sqrt(3) / 2, base 3 sqrt(3) / 2 h^2.
  EXPECT_NEAR(o.volume, std::sqrt(3.0) / 2 * depth * depth * depth, 1e-9 * depth * depth * depth);
  EXPECT_NEAR(o.patch_area, 1.5 * std::sqrt(3.0) * depth * depth, 1e-9 * depth * depth);
  expect_near(o.centroid, {0, 0, 0.5 - depth / 4}, 1e-12);
}

TEST(ClosedForm, ApartIsEmpty) {
  OverlapScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  for (const Vec3 &t : {Vec3{1.5, 0, 0}, Vec3{0.9, 0.9, 1.1}, Vec3{1, 0, 0}}) {
    const Overlap o = convex_overlap(cube, cube, {Mat3{}, t}, {1, 0, 0}, scratch);
    EXPECT_EQ(o.volume, 0);
    EXPECT_EQ(o.patch_area, 0);
  }
}

// Planes of both bodies in long double, about a point near the overlap.
void expect_as_reference(const Polytope &a, const Polytope &b, const Pose &pose, const Vec3 &normal,
                         const Vec3 &near, double size, OverlapScratch &scratch, double &worst) {
  const reference::Polyhedron ra = reference_of(a), rb = moved(reference_of(b), pose);
  std::vector<reference::Point> normals = ra.normals;
  std::vector<Real> offsets = ra.offsets;
  normals.insert(normals.end(), rb.normals.begin(), rb.normals.end());
  offsets.insert(offsets.end(), rb.offsets.begin(), rb.offsets.end());
  const Overlap o = convex_overlap(a, b, pose, normal, scratch);
  const reference::OverlapValues r =
      reference::overlap(normals, offsets, reference::to_point(near), 8 * size, reference::to_point(normal));
  const auto relative = [](Real value, Real expected) { return std::fabs(value - expected) / expected; };
  if (r.volume < 1e-18 * size * size * size) return;
  Real error = std::max(relative(o.volume, r.volume), relative(o.patch_area, r.patch_area));
  error = std::max(error, norm(reference::to_point(o.centroid) - r.centroid) / size);
  error = std::max(error, norm(reference::to_point(o.patch_centroid) - r.patch_centroid) / size);
  Real moment = 0;
  for (int i = 0; i < 3; ++i) moment += r.patch_moment[i][i];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      error = std::max(error, std::fabs(o.patch_moment.row[i][j] - r.patch_moment[i][j]) / moment);
    }
  }
  EXPECT_LT(error, 1e-6) << "volume " << o.volume << " reference " << static_cast<double>(r.volume);
  worst = std::max(worst, static_cast<double>(error));
  // Exchanged bodies: the same overlap, seen from B.
  const Overlap e = convex_overlap(b, a, pose.inverse(), transposed_times(pose.rotation, normal), scratch);
  EXPECT_NEAR(e.volume, o.volume, 1e-8 * o.volume);
  expect_near((1 / size) * pose(e.centroid), (1 / size) * o.centroid, 1e-8);
  expect_near((1 / size) * pose(e.patch_centroid), (1 / size) * o.patch_centroid, 1e-8);
}

TEST(Reference, RandomHullsAtManyDepthsAndSizes) {
  Random random(7);
  DistanceScratch distance_scratch;
  OverlapScratch scratch;
  double worst = 0;
  for (int k = 0; k < 1500; ++k) {
    const double size = random.log_uniform(1e-3, 1e3);
    const auto axes = [&] {
      return Vec3{size * random.log_uniform(0.05, 1), size * random.log_uniform(0.05, 1), size};
    };
    Polytope a, b;
    if (!build_convex_hull(random_points(random, random.integer(4, 40), axes(), k % 2 == 0), a, nullptr, nullptr) ||
        !build_convex_hull(random_points(random, random.integer(4, 40), axes(), k % 3 == 0), b, nullptr, nullptr)) {
      continue;
    }
    Pose pose{random_rotation(random), size * random.direction()};
    SignedDistance d = signed_distance(make_polytope(a), make_polytope(b), pose, distance_scratch);
    const double depth = size * random.log_uniform(1e-5, 0.1);
    pose.translation = pose.translation + (d.distance + depth) * d.normal;
    d = signed_distance(make_polytope(a), make_polytope(b), pose, distance_scratch);
    expect_as_reference(a, b, pose, d.normal, d.point_a, size, scratch, worst);
  }
  RecordProperty("largest_relative_error", std::to_string(worst));
  std::printf("largest relative error %.3g\n", worst);
}

TEST(Reference, NearlyAlignedBoxes) {
  Random random(8);
  OverlapScratch scratch;
  double worst = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 size_a{random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
    const Vec3 size_b{random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)};
    const double depth = random.log_uniform(1e-6, 0.1);
    const Pose pose{rotation_about(random.direction(), random.log_uniform(1e-12, 1e-2)),
                    {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0.5 * (size_a.z + size_b.z) - depth}};
    expect_as_reference(Polytope::box(size_a), Polytope::box(size_b), pose, {0, 0, -1}, {0, 0, 0.5 * size_a.z}, 1,
                        scratch, worst);
  }
  std::printf("largest relative error %.3g\n", worst);
}

TEST(Property, VolumeIsContinuousAsFacesPassThroughOnePlane) {
  OverlapScratch scratch;
  const Polytope cube = Polytope::box({1, 1, 1});
  double before = 1;
  for (int k = 0; k <= 2000; ++k) {
    const double shift = k * 1e-17;
    const Overlap o = convex_overlap(cube, cube, {Mat3{}, {shift, -shift, shift}}, {0, 0, 1}, scratch);
    EXPECT_NEAR(o.volume, before, 1e-13);
    before = o.volume;
  }
}

TEST(Property, SurfaceIsClosed) {
  Random random(9);
  OverlapScratch scratch;
  for (int k = 0; k < 500; ++k) {
    Polytope a, b;
    ASSERT_TRUE(build_convex_hull(random_points(random, 30, {1, 1, 1}, false), a, nullptr, nullptr));
    ASSERT_TRUE(build_convex_hull(random_points(random, 30, {1, 1, 1}, false), b, nullptr, nullptr));
    convex_overlap(a, b, {random_rotation(random), 1.2 * random.direction()}, {0, 0, 1}, scratch);
    Vec3 area;
    for (const OverlapScratch::Face &face : scratch.faces()) {
      const auto corner = [&](int c) {
        return scratch.vertices()[static_cast<std::size_t>(
            scratch.corners()[static_cast<std::size_t>(face.first + c % face.count)])];
      };
      for (int c = 0; c < face.count; ++c) area = area + 0.5 * cross(corner(c), corner(c + 1));
    }
    expect_near(area, {0, 0, 0}, 1e-13);
  }
}

}  // namespace
}  // namespace test_convex_overlap
