// Reproducible random bodies and poses for the convex tests.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "narrowphase/convex_distance.hpp"
#include "reference_distance.hpp"
#include "shape/convex_hull.hpp"

namespace random_bodies {

using cmb::convex::ConvexBody;
using cmb::convex::Mat3;
using cmb::convex::Polytope;
using cmb::convex::Pose;
using cmb::convex::Vec3;

// splitmix64: the same numbers with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int integer(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  double normal() {
    return std::sqrt(-2 * std::log(uniform(1e-300, 1))) * std::cos(6.283185307179586 * uniform(0, 1));
  }
  Vec3 direction() { return cmb::convex::normalized({normal(), normal(), normal()}); }

 private:
  std::uint64_t state_;
};

inline Mat3 rotation_about(const Vec3 &axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Vec3 &u = axis;
  return {{{c + u.x * u.x * (1 - c), u.x * u.y * (1 - c) - u.z * s, u.x * u.z * (1 - c) + u.y * s},
           {u.y * u.x * (1 - c) + u.z * s, c + u.y * u.y * (1 - c), u.y * u.z * (1 - c) - u.x * s},
           {u.z * u.x * (1 - c) - u.y * s, u.z * u.y * (1 - c) + u.x * s, c + u.z * u.z * (1 - c)}}};
}

inline Mat3 random_rotation(Random &random) {
  double q[4], length = 0;
  for (double &x : q) x = random.normal(), length += x * x;
  length = std::sqrt(length);
  for (double &x : q) x /= length;
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

inline reference::Polyhedron reference_of(const Polytope &p) {
  reference::Polyhedron r;
  for (const Vec3 &v : p.vertices()) r.vertices.push_back(reference::to_point(v));
  for (const Polytope::Face &f : p.faces()) {
    std::vector<int> face;
    for (int k = 0; k < f.count; ++k) face.push_back(p.face_vertices()[static_cast<std::size_t>(f.first + k)]);
    r.faces.push_back(face);
  }
  r.finish();
  return r;
}

// Points on an ellipsoid of the given semi-axes (all on the hull), or in a box where `inside`.
inline std::vector<Vec3> random_points(Random &random, int count, const Vec3 &axes, bool inside) {
  std::vector<Vec3> points;
  for (int k = 0; k < count; ++k) {
    Vec3 p = random.direction();
    if (inside) p = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    points.push_back({axes.x * p.x, axes.y * p.y, axes.z * p.z});
  }
  return points;
}

}  // namespace random_bodies
