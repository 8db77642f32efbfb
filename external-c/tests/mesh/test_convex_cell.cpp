// Cubes that planes cut.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/elastic/convex_cell.hpp"
#include "support/random_bodies.hpp"

namespace test_convex_cell {
namespace {

using cmb::convex::PolytopeView;
using cmb::convex::Vec3;
using cmb::mesh::ConvexCell;
using random_bodies::Random;

double volume_of(const PolytopeView &surface) {
  double volume = 0.0;
  for (const auto &face : surface.faces) {
    const auto corner = [&](std::int32_t k) {
      return surface.vertices[static_cast<std::size_t>(surface.face_vertices[static_cast<std::size_t>(face.first + k)])];
    };
    for (std::int32_t k = 1; k + 1 < face.count; ++k) volume += dot(corner(0), cross(corner(k), corner(k + 1))) / 6.0;
  }
  return volume;
}

// Each edge is a side of two faces, once in each sense, and joins the vertices that those say; Euler's formula holds.
void expect_closed(const PolytopeView &surface) {
  std::multiset<std::pair<std::int32_t, bool>> sides;
  for (const auto &face : surface.faces) {
    for (std::int32_t k = 0; k < face.count; ++k) {
      const auto at = static_cast<std::size_t>(face.first + k), next = static_cast<std::size_t>(face.first + (k + 1) % face.count);
      const std::int32_t edge = surface.face_edges[at], from = surface.face_vertices[at], to = surface.face_vertices[next];
      const auto *const vertex = surface.edges[static_cast<std::size_t>(edge)].vertex;
      const bool forward = vertex[0] == from;
      EXPECT_EQ(vertex[forward ? 0 : 1], from);
      EXPECT_EQ(vertex[forward ? 1 : 0], to);
      sides.insert({edge, forward});
      const Vec3 &p = surface.vertices[static_cast<std::size_t>(from)];
      EXPECT_NEAR(dot(face.normal, p), face.offset, 1e-13);
    }
  }
  EXPECT_EQ(sides.size(), 2 * surface.edges.size());
  for (std::size_t edge = 0; edge < surface.edges.size(); ++edge) {
    EXPECT_EQ(sides.count({static_cast<std::int32_t>(edge), true}), 1u);
    EXPECT_EQ(sides.count({static_cast<std::int32_t>(edge), false}), 1u);
  }
  EXPECT_EQ(surface.vertices.size() + surface.faces.size(), surface.edges.size() + 2);
}

TEST(ConvexCell, BeginsAsACube) {
  ConvexCell cell;
  cell.start({1, 2, 3}, 0.5);
  expect_closed(cell.surface());
  EXPECT_NEAR(volume_of(cell.surface()), 1.0, 1e-14);
}

// Both sides of a cut add up to what was cut, and stay closed.
TEST(ConvexCell, PartsAddUp) {
  Random random(5);
  int cuts = 0;
  for (int k = 0; k < 300; ++k) {
    ConvexCell cell;
    cell.start({}, 1.0);
    for (int plane = 0; plane < 8; ++plane) {
      const Vec3 normal = random.direction();
      const double offset = random.uniform(-0.6, 0.3);
      ConvexCell rest = cell;
      const double before = volume_of(cell.surface());
      const ConvexCell::Cut done = cell.keep_before(normal, offset);
      if (done == ConvexCell::Cut::none) {
        EXPECT_EQ(rest.keep_before(-normal, -offset), ConvexCell::Cut::all);
        break;
      }
      ASSERT_NE(done, ConvexCell::Cut::failed);
      expect_closed(cell.surface());
      if (done == ConvexCell::Cut::all) continue;
      ++cuts;
      ASSERT_EQ(rest.keep_before(-normal, -offset), ConvexCell::Cut::part);
      EXPECT_NEAR(volume_of(cell.surface()) + volume_of(rest.surface()), before, 1e-13);
    }
  }
  EXPECT_GT(cuts, 500);
}

// A plane through vertices of the cell, to rounding: what is cut is closed, or the cell is as it was.
TEST(ConvexCell, PlanesThroughCornersLeaveAClosedCell) {
  Random random(6);
  for (int k = 0; k < 2000; ++k) {
    ConvexCell cell;
    cell.start({}, 1.0);
    for (int plane = 0; plane < 6; ++plane) {
      const auto &vertices = cell.surface().vertices;
      const auto any = [&] { return vertices[static_cast<std::size_t>(random.integer(0, static_cast<int>(vertices.size()) - 1))]; };
      const Vec3 p = any(), across = cross(any() - p, any() - p);
      if (!(norm(across) > 1e-6)) continue;
      const Vec3 normal = normalized(across);
      if (cell.keep_before(normal, dot(normal, p)) == ConvexCell::Cut::none) break;
      expect_closed(cell.surface());
    }
  }
}

}  // namespace
}  // namespace test_convex_cell
