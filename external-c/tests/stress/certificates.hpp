// What can be said about the distance of convex parts from how far they reach alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solids.hpp"

namespace cmb::stress {

// How far A lies beyond B along the unit n, from B to A: negative where they overlap along it. A lower bound of the signed
// distance of convex A and B whatever n is; the greatest of all n is that distance.
inline double gap_along(const Part &a, const Pose &pose_a, const Part &b, const Pose &pose_b, const Vec3 &n) {
  const double low_a = dot(n, pose_a.translation) - reach(a, -transposed_times(pose_a.rotation, n));
  const double high_b = dot(n, pose_b.translation) + reach(b, transposed_times(pose_b.rotation, n));
  return low_a - high_b;
}

// Directions of the faces and edges of a hull of few points, and some more of both.
struct Axes {
  std::vector<Vec3> normals, edges;
};

inline Axes axes_of(const std::vector<Vec3> &points) {
  Axes axes;
  double size = 0.0;
  for (const Vec3 &p : points) size = std::max(size, norm(p - points[0]));
  const auto add = [](std::vector<Vec3> &list, const Vec3 &d) {
    for (const Vec3 &known : list) {
      if (norm(cross(known, d)) < 1e-12) return;
    }
    list.push_back(d);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      for (std::size_t k = j + 1; k < points.size(); ++k) {
        const Vec3 n = cross(points[j] - points[i], points[k] - points[i]);
        if (!(norm(n) > 1e-14 * size * size)) continue;
        const Vec3 unit = normalized(n);
        double low = 0.0, high = 0.0;
        for (const Vec3 &p : points) {
          low = std::min(low, dot(unit, p - points[i]));
          high = std::max(high, dot(unit, p - points[i]));
        }
        if (low < -1e-12 * size && high > 1e-12 * size) continue;  // points on both sides: no face
        add(axes.normals, unit);
        add(axes.edges, normalized(points[j] - points[i]));
        add(axes.edges, normalized(points[k] - points[i]));
        add(axes.edges, normalized(points[k] - points[j]));
      }
    }
  }
  return axes;
}

// The greatest gap along the separating axes of two hulls: minus the depth where they overlap, a lower bound of the
// distance where they do not.
inline double greatest_gap(const Part &a, const Axes &axes_a, const Pose &pose_a, const Part &b, const Axes &axes_b,
                           const Pose &pose_b) {
  double greatest = -std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3 &n) {
    greatest = std::max(greatest, std::max(gap_along(a, pose_a, b, pose_b, n), gap_along(a, pose_a, b, pose_b, -n)));
  };
  const auto in_a = [&](const Vec3 &local) { return pose_a.rotation * (a.in_body.rotation * local); };
  const auto in_b = [&](const Vec3 &local) { return pose_b.rotation * (b.in_body.rotation * local); };
  for (const Vec3 &n : axes_a.normals) offer(in_a(n));
  for (const Vec3 &n : axes_b.normals) offer(in_b(n));
  for (const Vec3 &e : axes_a.edges) {
    for (const Vec3 &f : axes_b.edges) {
      const Vec3 n = cross(in_a(e), in_b(f));
      if (norm(n) > 1e-9) offer(normalized(n));
    }
  }
  return greatest;
}

}  // namespace cmb::stress
