// Faces that a plane cuts: all of them, by every face's corners as the reference, and hardly any other.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shape/convex_hull.hpp"
#include "shape/plane_section.hpp"
#include "support/random_bodies.hpp"

namespace test_plane_section {
namespace {

using namespace cmb::convex;
using namespace random_bodies;

Polytope hull_of(const std::vector<Vec3> &points) {
  Polytope hull;
  std::string problem;
  EXPECT_TRUE(build_convex_hull(points, hull, nullptr, &problem)) << problem;
  return hull;
}

double height(const Polytope &p, std::int32_t corner, const Vec3 &point, const Vec3 &across) {
  return dot(p.vertices()[static_cast<std::size_t>(corner)] - point, across);
}

// The faces with corners clearly on both sides, and those with none clearly on one of them.
struct Reference {
  std::set<std::int32_t> cut, beside;

  Reference(const Polytope &p, const Vec3 &point, const Vec3 &across, double clear) {
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(p.faces().size()); ++f) {
      const Polytope::Face &face = p.faces()[static_cast<std::size_t>(f)];
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (std::int32_t k = 0; k < face.count; ++k) {
        const double here = height(p, p.face_vertices()[static_cast<std::size_t>(face.first + k)], point, across);
        least = std::min(least, here), most = std::max(most, here);
      }
      if (least < -clear && most > clear) cut.insert(f);
      if (least > clear || most < -clear) beside.insert(f);
    }
  }
};

void expect_section(const Polytope &p, const Vec3 &point, const Vec3 &across, const Vec3 &start) {
  std::vector<std::int32_t> faces;
  ASSERT_TRUE(append_section_faces(p, point, across, start, faces));
  const std::set<std::int32_t> found(faces.begin(), faces.end());
  const Reference expected(p, point, across, 1e-12 * p.radius());
  for (const std::int32_t face : expected.cut) EXPECT_TRUE(found.count(face)) << "face " << face << " is missing";
  // Faces beside the plane are there for a corner that is hardly beside it, or not at all.
  for (const std::int32_t face : found) {
    if (!expected.beside.count(face)) continue;
    const Polytope::Face &f = p.faces()[static_cast<std::size_t>(face)];
    bool near = false;
    for (std::int32_t k = 0; k < f.count; ++k) {
      const std::int32_t corner = p.face_vertices()[static_cast<std::size_t>(f.first + k)];
      near = near || std::fabs(height(p, corner, point, across)) <= 1e-9 * p.radius();
    }
    EXPECT_TRUE(near) << "face " << face << " is not cut";
  }
}

TEST(PlaneSection, HasAllFacesThatArbitraryPlanesCut) {
  Random random(7);
  for (const int corners : {4, 8, 20, 100, 700}) {
    for (const Vec3 &axes : {Vec3{1, 1, 1}, Vec3{1, 1, 1e-3}, Vec3{1e3, 1, 1}}) {
      const Polytope p = hull_of(random_points(random, corners, axes, false));
      for (int k = 0; k < 40; ++k) {
        const Mat3 r = random_rotation(random);
        expect_section(p, p.center(), r.column(0), r.column(1));
      }
    }
  }
}

TEST(PlaneSection, HasAllFacesAboutCornersInThePlane) {
  Random random(8);
  const Polytope p = hull_of(random_points(random, 200, {1, 1, 1}, false));
  for (int k = 0; k < 200; ++k) {
    // Through two corners and the middle: many faces have one of them.
    const auto corner = [&] { return p.vertices()[static_cast<std::size_t>(random.integer(0, 199))]; };
    const Vec3 a = corner(), b = corner();
    const Vec3 across = cross(a - p.center(), b - p.center());
    if (!(norm(across) > 1e-3)) continue;
    expect_section(p, a, (1.0 / norm(across)) * across, b - p.center());
  }
}

TEST(PlaneSection, PlaneThroughFacesOfABox) {
  const Polytope box = Polytope::box({2, 4, 6});
  std::vector<std::int32_t> faces;
  ASSERT_TRUE(append_section_faces(box, {0, 0, 0.5}, {0, 0, 1}, {1, 0, 0}, faces));
  EXPECT_EQ(std::set<std::int32_t>(faces.begin(), faces.end()), (std::set<std::int32_t>{0, 1, 2, 3}));
}

TEST(PlaneSection, PlanesBesideThePolytopeCutNothing) {
  const Polytope box = Polytope::box({2, 4, 6});
  std::vector<std::int32_t> faces;
  EXPECT_FALSE(append_section_faces(box, {0, 0, 3.1}, {0, 0, 1}, {1, 0, 0}, faces));
  EXPECT_FALSE(append_section_faces(box, {0, 0, -3.1}, {0, 0, 1}, {1, 0, 0}, faces));
}

}  // namespace
}  // namespace test_plane_section
