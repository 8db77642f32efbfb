// Building polytopes and hulls.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/random_bodies.hpp"

namespace test_polytope {
namespace {

using namespace cmb::convex;
using namespace random_bodies;

// Volume by the divergence theorem.
double volume(const Polytope &p) {
  double sum = 0;
  for (const Polytope::Face &f : p.faces()) {
    const auto corner = [&](int k) {
      return p.vertices()[static_cast<std::size_t>(p.face_vertices()[static_cast<std::size_t>(f.first + k)])];
    };
    for (int k = 1; k + 1 < f.count; ++k) sum += dot(corner(0), cross(corner(k), corner(k + 1))) / 6;
  }
  return sum;
}

TEST(Box, HasTheNumbersItPromises) {
  const Polytope box = Polytope::box({2, 4, 6});
  ASSERT_EQ(box.vertices().size(), 8u);
  ASSERT_EQ(box.faces().size(), 6u);
  ASSERT_EQ(box.edges().size(), 12u);
  EXPECT_DOUBLE_EQ(volume(box), 48);
  for (int v = 0; v < 8; ++v) {
    const Vec3 &p = box.vertices()[static_cast<std::size_t>(v)];
    EXPECT_EQ(p.x, v & 1 ? 1 : -1);
    EXPECT_EQ(p.y, v & 2 ? 2 : -2);
    EXPECT_EQ(p.z, v & 4 ? 3 : -3);
  }
  for (int f = 0; f < 6; ++f) {
    EXPECT_DOUBLE_EQ(box.faces()[static_cast<std::size_t>(f)].normal[f / 2], f % 2 ? 1 : -1);
    EXPECT_DOUBLE_EQ(box.faces()[static_cast<std::size_t>(f)].offset, f / 2 + 1);
  }
}

TEST(Box, SupportVertexIsTheSignsOfTheDirection) {
  const Polytope box = Polytope::box({2, 4, 6});
  EXPECT_EQ(box.support_vertex({1, -1, 1}), 5);
  EXPECT_EQ(box.support_vertex({-1e-9, 1e-9, -1e3}), 2);
}

TEST(Build, RefusesWhatIsNoConvexSolid) {
  const std::vector<Vec3> corner{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<std::int32_t>> good{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  Polytope p;
  std::string problem;
  EXPECT_TRUE(Polytope::build(corner, good, p, &problem));
  const auto refused = [&](auto vertices, auto faces, const char *expected) {
    problem.clear();
    EXPECT_FALSE(Polytope::build(vertices, faces, p, &problem));
    EXPECT_NE(problem.find(expected), std::string::npos) << problem;
    EXPECT_EQ(p.vertices().size(), 4u) << "the result must stay as it was";
  };
  auto faces = good;
  faces.pop_back();
  refused(corner, faces, "at least 4");
  faces = good;
  faces[3] = {0, 2, 3};
  refused(corner, faces, "not those of a convex solid");
  faces = good;
  faces[3] = {0, 2, 4};
  refused(corner, faces, "does not exist");
  faces = good;
  faces[1] = {0, 1};
  refused(corner, faces, "fewer than 3");
  faces = good;
  faces[1] = {0, 2, 1};
  refused(corner, faces, "twice in the same sense");
  auto vertices = corner;
  vertices[3].z = NAN;
  refused(vertices, good, "not finite");
  vertices = corner;
  vertices[3] = {0.2, 0.2, -1};
  refused(vertices, good, "convex");
  vertices = corner;
  vertices.push_back({0.1, 0.1, 0.1});
  refused(vertices, good, "Euler");
}

TEST(Hull, OfACubeWithPointsOnItIsTheCube) {
  Random random(3);
  std::vector<Vec3> points;
  for (int k = 0; k < 400; ++k) {
    Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (k % 2) p.set(random.integer(0, 2), random.integer(0, 1) ? 1 : -1);  // on a face
    if (k % 8 == 1) p.set(random.integer(0, 2), 1);                         // perhaps on an edge
    points.push_back(p);
  }
  for (int v = 0; v < 8; ++v) points.push_back({v & 1 ? 1. : -1., v & 2 ? 1. : -1., v & 4 ? 1. : -1.});
  Polytope hull;
  std::vector<std::int32_t> kept;
  std::string problem;
  ASSERT_TRUE(build_convex_hull(points, hull, &kept, &problem)) << problem;
  EXPECT_EQ(hull.vertices().size(), 8u);
  EXPECT_EQ(hull.faces().size(), 6u);
  EXPECT_NEAR(volume(hull), 8, 1e-14);
  for (std::size_t v = 0; v < kept.size(); ++v) {
    EXPECT_EQ(norm(points[static_cast<std::size_t>(kept[v])] - hull.vertices()[v]), 0);
  }
}

TEST(Hull, HoldsAllPointsAndKeepsOnlySome) {
  Random random(4);
  for (int k = 0; k < 300; ++k) {
    const double size = random.log_uniform(1e-3, 1e3);
    const auto points = random_points(random, random.integer(4, 200), {size, size * 0.3, size * 0.01}, k % 2 == 0);
    Polytope hull;
    std::string problem;
    ASSERT_TRUE(build_convex_hull(points, hull, nullptr, &problem)) << problem;
    for (const Vec3 &p : points) {
      for (const Polytope::Face &f : hull.faces()) ASSERT_LT(dot(f.normal, p) - f.offset, 1e-10 * size);
    }
    EXPECT_LE(hull.vertices().size(), points.size());
    EXPECT_EQ(hull.vertices().size() + hull.faces().size(), hull.edges().size() + 2);
  }
}

TEST(Hull, PointsNearlyInPlanesAreNoObstacle) {
  Random random(6);
  for (int k = 0; k < 5000; ++k) {
    const double noise = k % 4 ? random.log_uniform(1e-14, 1e-6) : 0;
    std::vector<Vec3> points;
    for (int n = random.integer(8, 40); n > 0; --n) {
      points.push_back({random.integer(0, 2) + noise * random.normal(), random.integer(0, 2) + noise * random.normal(),
                        random.integer(0, 2) + noise * random.normal()});
    }
    for (int v = 0; v < 4; ++v) points.push_back({v & 1 ? 2. : 0., v & 2 ? 2. : 0., v == 0 || v == 3 ? 2. : 0.});
    Polytope hull;
    std::string problem;
    ASSERT_TRUE(build_convex_hull(points, hull, nullptr, &problem)) << problem << " noise " << noise;
    for (const Vec3 &p : points) {
      for (const Polytope::Face &f : hull.faces()) ASSERT_LT(dot(f.normal, p) - f.offset, 1e-6);
    }
  }
}

// Of few vertices all are compared, without a table.
TEST(Hull, FarthestOfFewVertices) {
  Random random(6);
  for (int count = 4; count <= 10; ++count) {
    Polytope hull;
    ASSERT_TRUE(build_convex_hull(random_points(random, count, {1, 1, 1}, false), hull, nullptr, nullptr));
    ASSERT_EQ(hull.vertices().size(), static_cast<std::size_t>(count));
    for (int k = 0; k < 300; ++k) {
      const Vec3 d = random.direction();
      double best = -1;
      for (const Vec3 &v : hull.vertices()) best = std::max(best, dot(d, v));
      EXPECT_EQ(dot(d, hull.vertices()[static_cast<std::size_t>(hull.support_vertex(d))]), best) << count;
    }
  }
}

TEST(Hull, PointsOnASphereAreAllKept) {
  Random random(5);
  Polytope hull;
  ASSERT_TRUE(build_convex_hull(random_points(random, 1000, {1, 1, 1}, false), hull, nullptr, nullptr));
  EXPECT_EQ(hull.vertices().size(), 1000u);
  EXPECT_EQ(hull.faces().size(), 1996u);
  for (int k = 0; k < 2000; ++k) {  // the table against all vertices
    const Vec3 d = random.direction();
    double best = -1;
    for (const Vec3 &v : hull.vertices()) best = std::max(best, dot(d, v));
    EXPECT_EQ(dot(d, hull.vertices()[static_cast<std::size_t>(hull.support_vertex(d))]), best);
  }
}

// The vertex of a look into the table is farthest along a direction not farther off than a cell's corner is from its middle.
TEST(Hull, OuterVerticesAreFarthestAlongDirectionsLikeTheOneAsked) {
  Random random(6);
  for (const int count : {20, 100, 1000}) {
    Polytope hull;
    ASSERT_TRUE(build_convex_hull(random_points(random, count, {1, 1, 1}, false), hull, nullptr, nullptr));
    const double cells = std::ceil(std::sqrt(count * 4.0 / 3.0)), off = std::sqrt(2.0) / cells;
    for (int k = 0; k < 2000; ++k) {
      const Vec3 d = random.direction();
      double best = -1;
      for (const Vec3 &v : hull.vertices()) best = std::max(best, dot(d, v));
      const double height = dot(d, hull.vertices()[static_cast<std::size_t>(hull.outer_vertex(d))]);
      // Along a direction that is off by an angle, the farthest vertex is at most so much lower.
      EXPECT_GE(height, best - 2.0 * off * hull.radius());
    }
  }
}

TEST(Hull, RefusesPointsWithoutVolume) {
  Polytope hull;
  std::string problem;
  EXPECT_FALSE(build_convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, hull, nullptr, &problem));
  EXPECT_NE(problem.find("at least 4"), std::string::npos);
  EXPECT_FALSE(build_convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, hull, nullptr, &problem));
  EXPECT_NE(problem.find("no volume"), std::string::npos);
  EXPECT_FALSE(build_convex_hull(std::vector<Vec3>(9, Vec3{1, 2, 3}), hull, nullptr, &problem));
  EXPECT_FALSE(build_convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, INFINITY}}, hull, nullptr, &problem));
  EXPECT_NE(problem.find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace test_polytope
