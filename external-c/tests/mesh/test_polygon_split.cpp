// Polygons of files as triangles: they cover the polygon, once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/mesh_refusals.hpp"
#include "support/mesh_samples.hpp"
#include "support/random_bodies.hpp"

namespace test_polygon_split {
namespace {

using namespace mesh_refusals;
using namespace mesh_samples;

struct Point {
  double x, y;
};
using Border = std::vector<Point>;

double shoelace(const Border &border) {
  double twice = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Point &p = border[i], &q = border[(i + 1) % border.size()];
    twice += p.x * q.y - p.y * q.x;
  }
  return 0.5 * twice;
}

// By the number of edges that a ray crosses.
bool lies_inside(const Border &border, const Point &p) {
  bool inside = false;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Point &a = border[i], &b = border[(i + 1) % border.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

Border begun_at(const Border &border, std::size_t first) {
  Border result;
  for (std::size_t i = 0; i < border.size(); ++i) result.push_back(border[(first + i) % border.size()]);
  return result;
}

std::string obj_of(const Border &border) {
  std::string vertices, face = "f";
  for (std::size_t i = 0; i < border.size(); ++i) {
    vertices += "v " + std::to_string(border[i].x) + " " + std::to_string(border[i].y) + " 3\n";
    face += " " + std::to_string(i + 1);
  }
  return vertices + face + "\n";
}

// Areas of the triangles as signed, which add up to the polygon's for folded triangles too; none may be negative.
void expect_covered(const Border &border, const MeshData &read) {
  ASSERT_EQ(read.triangles.size(), border.size() - 2);
  double sum = 0.0;
  for (const Triangle &t : read.triangles) {
    const Vec3 &a = read.vertices[t[0]], &b = read.vertices[t[1]], &c = read.vertices[t[2]];
    const Vec3 twice = cross(b - a, c - a);
    EXPECT_GT(twice.z, 0.0);
    sum += 0.5 * twice.z;
  }
  EXPECT_NEAR(sum, shoelace(border), 1e-5 * sum);  // to_string writes six digits
}

const Border l_shape{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
const Border u_shape{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
const Border arrow{{0, 0}, {2, 1}, {0, 2}, {0.5, 1}};
// A square with a square hole, reached over a seam that is there twice.
const Border frame{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
// Corners within its edges.
const Border strip{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {0, 1}};

TEST(PolygonSplit, CoversConcavePolygonsWhicheverCornerComesFirst) {
  for (const Border &border : {l_shape, u_shape, arrow, frame, strip}) {
    for (std::size_t first = 0; first < border.size(); ++first) {
      SCOPED_TRACE(first);
      expect_covered(border, read_obj(obj_of(begun_at(border, first)), "a.obj"));
    }
  }
}

TEST(PolygonSplit, CombsAndSpiralsAreCovered) {
  Border comb{{0, 0}, {64, 0}};
  for (int tooth = 31; tooth >= 0; --tooth) {
    comb.push_back({2.0 * tooth + 2.0, 9});
    comb.push_back({2.0 * tooth + 1.0, 1});
  }
  comb.push_back({0, 9});
  Border spiral;
  for (int i = 0; i < 60; ++i) spiral.push_back({(1.0 + i) * std::cos(0.3 * i), (1.0 + i) * std::sin(0.3 * i)});
  for (int i = 59; i >= 0; --i) spiral.push_back({(0.5 + i) * std::cos(0.3 * i), (0.5 + i) * std::sin(0.3 * i)});
  std::reverse(spiral.begin(), spiral.end());
  if (shoelace(spiral) < 0.0) std::reverse(spiral.begin(), spiral.end());
  for (const Border &border : {comb, spiral}) {
    for (std::size_t first = 0; first < border.size(); first += 7) {
      expect_covered(border, read_obj(obj_of(begun_at(border, first)), "a.obj"));
    }
  }
}

TEST(PolygonSplit, EachPointInsideIsInOneTriangle) {
  random_bodies::Random random(3);
  for (int sample = 0; sample < 200; ++sample) {
    Border border;
    const int corners = random.integer(4, 24);
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * i / corners, radius = random.uniform(0.2, 3.0);
      border.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    MeshData read = read_obj(obj_of(border), "a.obj");
    expect_covered(border, read);
    for (int k = 0; k < 50; ++k) {
      const Point p{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
      int within = 0;
      for (const Triangle &t : read.triangles) {
        Border triangle;
        for (const std::uint32_t v : t) triangle.push_back({read.vertices[v].x, read.vertices[v].y});
        within += lies_inside(triangle, p) ? 1 : 0;
      }
      for (std::size_t i = 0; i < border.size(); ++i) border[i] = {read.vertices[i].x, read.vertices[i].y};
      EXPECT_EQ(within, lies_inside(border, p) ? 1 : 0);
    }
  }
}

// An L as a prism, its faces given as polygons: what is in the notch is outside.
TEST(PolygonSplit, NotchesStayOpen) {
  const std::size_t n = l_shape.size();
  for (std::size_t first = 0; first < n; ++first) {
    const Border border = begun_at(l_shape, first);
    std::string text;
    for (const double z : {0.0, 1.0}) {
      for (const Point &p : border) {
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(z) + "\n";
      }
    }
    std::string bottom = "f", top = "f";
    for (std::size_t i = 0; i < n; ++i) {
      bottom += " " + std::to_string(n - i);
      top += " " + std::to_string(n + i + 1);
      const std::size_t next = (i + 1) % n;
      text += "f " + std::to_string(i + 1) + " " + std::to_string(next + 1) + " " + std::to_string(n + next + 1) + " " +
              std::to_string(n + i + 1) + "\n";
    }
    MeshData data = read_obj(text + bottom + "\n" + top + "\n", "a.obj");
    cmb::mesh::weld_vertices(data, "a.obj");
    const TriangleMesh mesh(std::move(data), MeshUse::solid, "a.obj");
    EXPECT_NEAR(mesh.mass_properties().volume, 3.0, 1e-12);
    EXPECT_NEAR(mesh.area(), 2 * 3.0 + 8.0, 1e-12);
    EXPECT_NEAR(mesh.nearest({1.5, 1.5, 0.5}).distance, 0.5, 1e-12);
    EXPECT_NEAR(mesh.nearest({1.2, 1.25, 0.9}).distance, 0.2, 1e-12);
  }
}

TEST(PolygonSplit, PlyFacesMayComeBeforeTheirVertices) {
  std::string text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 4\n"
                     "property float x\nproperty float y\nproperty float z\nend_header\n4 0 1 2 3\n";
  for (const Point &p : arrow) text += std::to_string(p.x) + " " + std::to_string(p.y) + " 0\n";
  expect_covered(arrow, read_ply(text, "a.ply"));
}

TEST(PolygonSplit, ConvexPolygonsStayFans) {
  const MeshData read = read_obj(obj_of({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}}), "a.obj");
  const std::vector<Triangle> fan{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_EQ(read.triangles, fan);
}

TEST(PolygonSplit, BordersThatCrossThemselvesAreRefused) {
  const Border bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, uneven_bow{{0, 0}, {3, 3}, {3, 0}, {0, 1}};
  for (const Border &border : {bow, uneven_bow}) {
    for (std::size_t first = 0; first < 4; ++first) {
      expect_refusal(read_obj, obj_of(begun_at(border, first)), "line 5: a face whose border crosses itself");
    }
  }
  expect_refusal(read_ply,
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                 "0 0 0\n1 1 0\n1 0 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n",
                 "face 2: a face whose border crosses itself");
}

TEST(PolygonSplit, LargeConcavePolygonsAreRefused) {
  Border star;
  for (int i = 0; i < 5000; ++i) {
    const double angle = 6.283185307179586 * i / 5000, radius = i % 2 == 0 ? 1000.0 : 900.0;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  expect_refusal(read_obj, obj_of(star), "more than 4096 corners; export it as triangles");
  for (Point &p : star) p = {1000.0 / std::hypot(p.x, p.y) * p.x, 1000.0 / std::hypot(p.x, p.y) * p.y};
  EXPECT_EQ(read_obj(obj_of(star), "a.obj").triangles.size(), 4998u);
}

// Too far away to be a polygon: refused for that, by the check of meshes.
TEST(PolygonSplit, HugeCoordinatesAreLeftToTheCheck) {
  MeshData read = read_obj("v 0 0 0\nv 1e300 0 0\nv 1e299 1e299 0\nv 0 1e300 0\nf 2 3 4 1\n", "a.obj");
  EXPECT_THROW(cmb::mesh::weld_vertices(read, "a.obj"), MeshError);
}

}  // namespace
}  // namespace test_polygon_split
