// Independent references for signed distances, in long double and by exhaustion.
//
// Inside: the minimum of the Minkowski difference's support function over every face normal and every
// product of two edges. Outside: a certificate from duality; the witness points bound the distance
// from above, the support function along the normal bounds it from below. None of it uses the
// library's algorithms.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "narrowphase/convex_distance.hpp"

namespace reference {

using Real = long double;

struct Point {
  Real x = 0, y = 0, z = 0;
};
inline Point operator+(const Point &a, const Point &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(const Point &a, const Point &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(Real s, const Point &a) { return {s * a.x, s * a.y, s * a.z}; }
inline Real dot(const Point &a, const Point &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(const Point &a, const Point &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm(const Point &a) { return std::sqrt(dot(a, a)); }
inline Point to_point(const cmb::convex::Vec3 &v) { return {v.x, v.y, v.z}; }
inline Point apply(const cmb::convex::Mat3 &m, const Point &v) {
  return {dot(to_point(m.row[0]), v), dot(to_point(m.row[1]), v), dot(to_point(m.row[2]), v)};
}
inline Point apply(const cmb::convex::Pose &pose, const Point &v) {
  return apply(pose.rotation, v) + to_point(pose.translation);
}
inline Point apply_transposed(const cmb::convex::Mat3 &m, const Point &v) {
  return v.x * to_point(m.row[0]) + v.y * to_point(m.row[1]) + v.z * to_point(m.row[2]);
}

// A polyhedron that knows its corners, edges and face planes; faces as corner cycles.
struct Polyhedron {
  std::vector<Point> vertices;
  std::vector<std::vector<int>> faces;
  std::vector<std::pair<int, int>> edges;
  std::vector<Point> normals;
  std::vector<Real> offsets;

  void finish() {
    edges.clear(), normals.clear(), offsets.clear();
    for (const auto &face : faces) {
      Point area, middle;
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Point &p = vertices[face[k]], &q = vertices[face[(k + 1) % face.size()]];
        if (face[k] < face[(k + 1) % face.size()]) edges.push_back({face[k], face[(k + 1) % face.size()]});
        area = area + cross(p - vertices[face[0]], q - vertices[face[0]]);
        middle = middle + (Real(1) / face.size()) * p;
      }
      normals.push_back((1 / norm(area)) * area);
      offsets.push_back(dot(normals.back(), middle));
    }
  }
  Real support(const Point &d) const {
    Real best = -INFINITY;
    for (const Point &p : vertices) best = std::max(best, dot(p, d));
    return best;
  }
  // How far p lies outside (<= 0 inside), measured by the face planes.
  Real outside(const Point &p) const {
    Real worst = -INFINITY;
    for (std::size_t f = 0; f < normals.size(); ++f) worst = std::max(worst, dot(normals[f], p) - offsets[f]);
    return worst;
  }
};

inline Polyhedron moved(Polyhedron body, const cmb::convex::Pose &pose) {
  for (Point &p : body.vertices) p = apply(pose, p);
  body.finish();
  return body;
}

// min over m of the support function of A - B, over all candidates; negative where apart (then it is
// only an upper bound of the negative distance). A product of edges is evaluated in full only if the
// edges' own height, a lower bound, is below the best so far.
inline Real lowest_support(const Polyhedron &a, const Polyhedron &b) {
  Real lowest = INFINITY;
  const auto attempt = [&](const Point &m) {
    lowest = std::min(lowest, a.support(m) + b.support(Real(-1) * m));
  };
  for (const Point &n : a.normals) attempt(n);
  for (const Point &n : b.normals) attempt(Real(-1) * n);
  for (const auto &[a0, a1] : a.edges) {
    const Point u = a.vertices[a1] - a.vertices[a0];
    for (const auto &[b0, b1] : b.edges) {
      const Point v = b.vertices[b1] - b.vertices[b0];
      const Point n = cross(u, v);
      const Real length2 = dot(n, n);
      if (!(length2 > Real(1e-30) * dot(u, u) * dot(v, v))) continue;
      const Real height = dot(n, a.vertices[a0] - b.vertices[b0]);
      if (lowest > 0 && height * height >= lowest * lowest * length2) continue;
      const Point m = (1 / std::sqrt(length2)) * n;
      attempt(m);
      attempt(Real(-1) * m);
    }
  }
  return lowest;
}

// Errors of an answer, all in metres; zero for an exact one.
struct Errors {
  Real distance = 0;  // of the distance
  Real normal = 0;    // by how much the normal misses the answer: support function along it against the distance
  Real witness = 0;   // witness points off their surfaces, off each other by distance * normal
};

inline Errors check(const Polyhedron &a, const Polyhedron &b_moved, Real radius_a, Real radius_b,
                    const cmb::convex::SignedDistance &answer) {
  Errors e;
  const Point n = to_point(answer.normal), pa = to_point(answer.point_a), pb = to_point(answer.point_b);
  const Real radii = radius_a + radius_b;
  const Real core = Real(answer.distance) + radii;
  const Real height = a.support(Real(-1) * n) + b_moved.support(n);  // support function along m = -n
  e.normal = std::max(std::fabs(height + core), std::fabs(norm(n) - 1) * (1 + radii));
  // Witness points on the cores: pushed back by the radii.
  const Point ca = pa + radius_a * n, cb = pb - radius_b * n;
  e.witness = norm(pa - pb - Real(answer.distance) * n);
  e.witness = std::max({e.witness, a.outside(ca), b_moved.outside(cb)});
  if (core > 0) {
    // lower bound: -height (n unit); upper bound: distance of the witnesses plus what they are outside.
    e.distance = std::max(std::fabs(-height - core), std::fabs(norm(ca - cb) - core));
  } else {
    e.distance = std::fabs(core + lowest_support(a, b_moved));
  }
  return e;
}

}  // namespace reference
