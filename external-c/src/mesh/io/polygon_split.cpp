#include "mesh/io/polygon_split.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmb::mesh {

namespace {

constexpr double flat_height = 1e-9;  // of a triangle, relative to its longest side

// A polygon seen along the mean of its normals: counter-clockwise.
struct FlatPolygon {
  struct Corner {
    double u = 0.0, v = 0.0;
    std::uint32_t vertex = 0;
    std::size_t before = 0, after = 0;  // those that are left
    double height = 0.0;                // of the triangle that cuts it off, relative to its longest side; 0 where none can
  };
  std::vector<Corner> corners;

  // Twice the area of a triangle, positive where it turns as the polygon does.
  double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Corner &p = corners[a], &q = corners[b], &r = corners[c];
    return (q.u - p.u) * (r.v - p.v) - (q.v - p.v) * (r.u - p.u);
  }
  double squared_side(std::size_t a, std::size_t b) const {
    const double u = corners[b].u - corners[a].u, v = corners[b].v - corners[a].v;
    return u * u + v * v;
  }
  bool coincide(std::size_t a, std::size_t b) const {
    return corners[a].u == corners[b].u && corners[a].v == corners[b].v;
  }

  void find_height(std::size_t i) {
    const std::size_t a = corners[i].before, c = corners[i].after;
    const double area = turn(a, i, c);
    corners[i].height = 0.0;
    if (!(area > 0.0)) return;
    for (std::size_t k = corners[c].after; k != a; k = corners[k].after) {
      // Polygons with holes come back to a corner.
      if (coincide(k, a) || coincide(k, i) || coincide(k, c)) continue;
      if (turn(a, i, k) >= 0.0 && turn(i, c, k) >= 0.0 && turn(c, a, k) >= 0.0) return;
    }
    corners[i].height = area / std::fmax(squared_side(a, i), std::fmax(squared_side(i, c), squared_side(c, a)));
  }
};

Vec3 doubled_area(const MeshData &data, const Triangle &t) {
  const Vec3 &a = data.vertices[t[0]];
  return cross(data.vertices[t[1]] - a, data.vertices[t[2]] - a);
}

bool folds(const PolygonFan &fan, const MeshData &data, const Vec3 &normal) {
  for (std::size_t k = 0; k + 2 < fan.corners; ++k) {
    const Triangle &t = data.triangles[fan.first_triangle + k];
    const Vec3 &a = data.vertices[t[0]], &b = data.vertices[t[1]], &c = data.vertices[t[2]];
    const double longest2 = std::fmax(norm2(b - a), std::fmax(norm2(c - b), norm2(a - c)));
    if (!(dot(doubled_area(data, t), normal) > flat_height * longest2)) return true;
  }
  return false;
}

FlatPolygon flattened(const PolygonFan &fan, const MeshData &data, const Vec3 &normal) {
  const Vec3 u = any_perpendicular(normal), v = cross(normal, u);
  const Triangle *triangles = &data.triangles[fan.first_triangle];
  const Vec3 origin = data.vertices[triangles[0][0]];
  FlatPolygon polygon;
  polygon.corners.resize(fan.corners);
  for (std::size_t i = 0; i < fan.corners; ++i) {
    FlatPolygon::Corner &corner = polygon.corners[i];
    corner.vertex = i < 2 ? triangles[0][i] : triangles[i - 2][2];
    const Vec3 from_origin = data.vertices[corner.vertex] - origin;
    corner.u = dot(u, from_origin);
    corner.v = dot(v, from_origin);
    corner.before = i == 0 ? fan.corners - 1 : i - 1;
    corner.after = i + 1 == fan.corners ? 0 : i + 1;
  }
  return polygon;
}

}  // namespace

bool unfold(const PolygonFan &fan, MeshData &data) {
  Vec3 sum;
  for (std::size_t k = 0; k + 2 < fan.corners; ++k) sum = sum + doubled_area(data, data.triangles[fan.first_triangle + k]);
  const double size = norm(sum);
  if (!std::isfinite(size)) return true;  // too far away, which the check of meshes says
  if (!(size > 0.0)) return false;
  const Vec3 normal = (1.0 / size) * sum;
  if (!folds(fan, data, normal)) return true;
  if (fan.corners > most_folded_corners) return false;
  FlatPolygon polygon = flattened(fan, data, normal);
  for (std::size_t i = 0; i < fan.corners; ++i) polygon.find_height(i);
  std::vector<Triangle> triangles;
  std::size_t some = 0;  // a corner that is left
  while (triangles.size() + 2 < fan.corners) {
    // The best shaped triangle first: slivers stay for the end, and mostly vanish.
    std::size_t best = some;
    for (std::size_t i = polygon.corners[some].after; i != some; i = polygon.corners[i].after) {
      if (polygon.corners[i].height > polygon.corners[best].height) best = i;
    }
    const FlatPolygon::Corner &cut = polygon.corners[best];
    if (!(cut.height > 0.0)) return false;
    const std::size_t before = cut.before, after = cut.after;
    triangles.push_back({polygon.corners[before].vertex, cut.vertex, polygon.corners[after].vertex});
    polygon.corners[before].after = after;
    polygon.corners[after].before = before;
    polygon.find_height(before);
    polygon.find_height(after);
    some = before;
  }
  std::copy(triangles.begin(), triangles.end(), data.triangles.begin() + static_cast<std::ptrdiff_t>(fan.first_triangle));
  return true;
}

}  // namespace cmb::mesh
