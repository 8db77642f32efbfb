// Independent reference for the overlap of two polyhedra, in long double: every face of the
// intersection is a large square in the face's plane, cut by all other planes; no adjacency is used.
#pragma once

#include "reference_distance.hpp"

namespace reference {

struct OverlapValues {
  Real volume = 0, patch_area = 0;
  Point centroid, patch_centroid;
  Real patch_moment[3][3] = {};
  int faces = 0;
};

// Planes that two bodies share (same normal, same offset to 1e-12 of the size) must be removed by the
// caller: pass each plane once.
inline OverlapValues overlap(const std::vector<Point> &normals, const std::vector<Real> &offsets, const Point &center,
                             Real size, const Point &direction) {
  OverlapValues result;
  Real volume_part = 0;
  Point moment;
  Real side_area[2] = {0, 0}, side_height[2] = {0, 0};
  std::vector<std::pair<Real, Real>> outline;
  const Point helper = std::fabs(direction.x) < Real(0.6) ? Point{1, 0, 0} : Point{0, 1, 0};
  Point e1 = cross(direction, helper);
  e1 = (1 / norm(e1)) * e1;
  const Point e2 = cross(direction, e1);
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const Point &n = normals[f];
    const Real height = offsets[f] - dot(n, center);
    const Point h = std::fabs(n.x) < Real(0.6) ? Point{1, 0, 0} : Point{0, 1, 0};
    Point u = cross(n, h);
    u = (1 / norm(u)) * u;
    const Point v = cross(n, u);
    // Coordinates about `center`.
    std::vector<Point> polygon = {height * n + (-size) * u + (-size) * v, height * n + size * u + (-size) * v,
                                  height * n + size * u + size * v, height * n + (-size) * u + size * v};
    for (std::size_t g = 0; g < normals.size() && !polygon.empty(); ++g) {
      if (g == f) continue;
      const Real limit = offsets[g] - dot(normals[g], center);
      std::vector<Point> kept;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const Real hp = dot(normals[g], p) - limit, hq = dot(normals[g], q) - limit;
        if (hp <= 0) kept.push_back(p);
        if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) kept.push_back(p + (hp / (hp - hq)) * (q - p));
      }
      polygon = kept;
    }
    if (polygon.size() < 3) continue;
    ++result.faces;
    for (const Point &p : polygon) outline.push_back({dot(p, e1), dot(p, e2)});
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const Point &a = polygon[0], &b = polygon[k], &c = polygon[k + 1];
      const Real area = dot(cross(b - a, c - a), n) / 2;
      const Real cone = area * height / 3;
      volume_part += cone;
      moment = moment + (cone / 4) * (a + b + c);
      const Real projected = area * dot(n, direction);
      const int side = projected < 0 ? 0 : 1;
      side_area[side] += std::fabs(projected);
      side_height[side] += std::fabs(projected) * dot(direction, a + b + c) / 3;
    }
  }
  if (!(volume_part > 0)) return result;
  result.volume = volume_part;
  result.centroid = center + (1 / volume_part) * moment;
  // The projection: convex hull of the projected corners (monotone chain), its moments by triangles.
  std::sort(outline.begin(), outline.end());
  std::vector<std::pair<Real, Real>> hull(2 * outline.size());
  std::size_t count = 0;
  const auto turn = [](const auto &o, const auto &a, const auto &b) {
    return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
  };
  for (std::size_t k = 0; k < outline.size(); ++k) {
    while (count >= 2 && turn(hull[count - 2], hull[count - 1], outline[k]) <= 0) --count;
    hull[count++] = outline[k];
  }
  const std::size_t lower = count + 1;
  for (std::size_t k = outline.size() - 1; k-- > 0;) {
    while (count >= lower && turn(hull[count - 2], hull[count - 1], outline[k]) <= 0) --count;
    hull[count++] = outline[k];
  }
  hull.resize(count - 1);
  // About one of the corners: the patch may be small and far from `center`.
  const Real x_origin = hull[0].first, y_origin = hull[0].second;
  for (auto &[px, py] : hull) px -= x_origin, py -= y_origin;
  Real x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const auto &[x0, y0] = hull[k];
    const auto &[x1, y1] = hull[(k + 1) % hull.size()];
    const Real c = x0 * y1 - x1 * y0;
    result.patch_area += c / 2;
    x += c * (x0 + x1) / 6;
    y += c * (y0 + y1) / 6;
    xx += c * (x0 * x0 + x0 * x1 + x1 * x1) / 12;
    yy += c * (y0 * y0 + y0 * y1 + y1 * y1) / 12;
    xy += c * (x0 * y1 + 2 * x0 * y0 + 2 * x1 * y1 + x1 * y0) / 24;
  }
  const Real area = result.patch_area;
  x /= area, y /= area;
  xx -= area * x * x, yy -= area * y * y, xy -= area * x * y;
  const Real z = (side_height[0] / side_area[0] + side_height[1] / side_area[1]) / 2;
  result.patch_centroid = center + (x + x_origin) * e1 + (y + y_origin) * e2 + z * direction;
  const Real a[3] = {e1.x, e1.y, e1.z}, b[3] = {e2.x, e2.y, e2.z};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      result.patch_moment[i][j] = xx * a[i] * a[j] + yy * b[i] * b[j] + xy * (a[i] * b[j] + a[j] * b[i]);
    }
  }
  return result;
}

}  // namespace reference
