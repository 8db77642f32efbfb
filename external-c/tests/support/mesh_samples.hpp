// Meshes that the tests use.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mesh/core/triangle_mesh.hpp"

namespace mesh_samples {

using cmb::convex::Mat3;
using cmb::convex::Pose;
using cmb::convex::Vec3;
using cmb::mesh::MeshData;
using cmb::mesh::MeshUse;
using cmb::mesh::Triangle;
using cmb::mesh::TriangleMesh;

// The box of full lengths `size`, centred, each side cut into n x n squares of two triangles.
inline MeshData box_mesh(const Vec3 &size, std::uint32_t n = 1) {
  MeshData data;
  for (int axis = 0; axis < 3; ++axis) {
    for (int sign = -1; sign <= 1; sign += 2) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto first = static_cast<std::uint32_t>(data.vertices.size());
      for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
          Vec3 p;
          p.set(axis, 0.5 * sign * size[axis]);
          p.set(u, size[u] * (static_cast<double>(i) / n - 0.5));
          p.set(v, size[v] * (static_cast<double>(j) / n - 0.5));
          data.vertices.push_back(p);
        }
      }
      for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
          const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
          if (sign > 0) {
            data.triangles.push_back({a, b, c});
            data.triangles.push_back({a, c, d});
          } else {
            data.triangles.push_back({a, c, b});
            data.triangles.push_back({a, d, c});
          }
        }
      }
    }
  }
  cmb::mesh::weld_vertices(data, "box");
  return data;
}

// An icosahedron whose triangles are cut into four `levels` times, vertices on the sphere.
inline MeshData sphere_mesh(double radius, int levels) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  MeshData data;
  data.vertices = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  data.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8}, {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, added] = middles.try_emplace({std::min(a, b), std::max(a, b)}, 0u);
      if (added) {
        entry->second = static_cast<std::uint32_t>(data.vertices.size());
        data.vertices.push_back(data.vertices[a] + data.vertices[b]);
      }
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const Triangle &t : data.triangles) {
      const std::uint32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], ab, ca}, {t[1], bc, ab}, {t[2], ca, bc}, {ab, bc, ca}});
    }
    data.triangles = std::move(finer);
    for (Vec3 &p : data.vertices) p = normalized(p);
  }
  for (Vec3 &p : data.vertices) p = radius * normalized(p);
  return data;
}

// A prism on an L whose corners run around it from its outer one, the inner one being the fourth.
inline MeshData angle_prism(const double (&xs)[6], const double (&ys)[6], double bottom, double top) {
  MeshData data;
  for (const double z : {bottom, top}) {
    for (int k = 0; k < 6; ++k) data.vertices.push_back({xs[k], ys[k], z});
  }
  const std::uint32_t cap[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto &t : cap) {
    data.triangles.push_back({t[0], t[2], t[1]});
    data.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    data.triangles.push_back({k, next, next + 6});
    data.triangles.push_back({k, next + 6, k + 6});
  }
  return data;
}

// The same with a speck far off: closed and convex meshes, which are hulls, become meshes like any other.
inline MeshData with_speck(MeshData data, const Vec3 &place = {0, 0, -20}) {
  const auto first = static_cast<std::uint32_t>(data.vertices.size());
  for (const Vec3 &p : {Vec3{0, 0, 0}, Vec3{1e-3, 0, 0}, Vec3{0, 1e-3, 0}, Vec3{0, 0, 1e-3}}) {
    data.vertices.push_back(p + place);
  }
  for (const Triangle &t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}}) {
    data.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return data;
}

// A sheet over [-size/2, size/2]^2, z = height(x, y), n x n squares, diagonals in turn.
template <typename Height>
MeshData sheet_mesh(double size, std::uint32_t n, Height &&height) {
  MeshData data;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = size * (static_cast<double>(i) / n - 0.5), y = size * (static_cast<double>(j) / n - 0.5);
      data.vertices.push_back({x, y, height(x, y)});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      if ((i + j) % 2 == 0) {
        data.triangles.push_back({a, b, c});
        data.triangles.push_back({a, c, d});
      } else {
        data.triangles.push_back({a, b, d});
        data.triangles.push_back({b, c, d});
      }
    }
  }
  return data;
}

inline TriangleMesh mesh(MeshData data) { return TriangleMesh(std::move(data), MeshUse::any, "sample"); }

}  // namespace mesh_samples
