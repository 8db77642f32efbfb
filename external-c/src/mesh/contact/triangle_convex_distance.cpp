#include "mesh/contact/triangle_convex_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cmb::mesh {

namespace {

constexpr int most_steps = 200;
// Agreement of the bounds, relative to the body: of round ones, and of those with corners, where the search ends at features.
constexpr double tolerance = 1e-10, polyhedral_tolerance = 1e-14;

// A point of (corners - body) and where it comes from.
struct Difference {
  Vec3 w, on_triangle, on_body;
};

// The nearest point to the origin of a simplex of up to three corners, as weights of them.
struct Nearest {
  Vec3 point;
  std::array<double, 3> weight{};
  double distance2 = std::numeric_limits<double>::infinity();
};

Nearest nearest_of(const Difference *s, std::size_t count) {
  Nearest best;
  const auto offer = [&](const std::array<double, 3> &weight) {
    Vec3 point;
    for (std::size_t k = 0; k < count; ++k) point = point + weight[k] * s[k].w;
    const double d2 = norm2(point);
    if (d2 < best.distance2) best = {point, weight, d2};
  };
  for (std::size_t k = 0; k < count; ++k) {
    std::array<double, 3> weight{};
    weight[k] = 1.0;
    offer(weight);
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const Vec3 edge = s[j].w - s[i].w;
      const double length2 = norm2(edge), part = -dot(s[i].w, edge);
      if (!(part > 0.0 && part < length2)) continue;
      std::array<double, 3> weight{};
      weight[j] = part / length2;
      weight[i] = 1.0 - weight[j];
      offer(weight);
    }
  }
  if (count == 3) {
    const Vec3 n = cross(s[1].w - s[0].w, s[2].w - s[0].w);
    const double n2 = norm2(n);
    const std::array<double, 3> area{dot(n, cross(s[1].w, s[2].w)), dot(n, cross(s[2].w, s[0].w)),
                                     dot(n, cross(s[0].w, s[1].w))};
    if (n2 > 0.0 && area[0] > 0.0 && area[1] > 0.0 && area[2] > 0.0) {
      const double sum = area[0] + area[1] + area[2];
      offer({area[0] / sum, area[1] / sum, area[2] / sum});
    }
  }
  return best;
}

// Whether the origin lies in the tetrahedron: on each face's side of the opposite corner, and no farther from the face than
// that. Of a flat one rounding alone would tell the sides.
bool holds_origin(const Difference *s) {
  for (int k = 0; k < 4; ++k) {
    const Vec3 &a = s[(k + 1) % 4].w, &b = s[(k + 2) % 4].w, &c = s[(k + 3) % 4].w, &opposite = s[k].w;
    const Vec3 n = cross(b - a, c - a);
    const double height = dot(n, opposite - a), of_origin = dot(n, -a);
    if (!(height * of_origin > 0.0 && std::fabs(of_origin) <= std::fabs(height))) return false;
  }
  return true;
}

// Of the convex hull of some corners; see triangle_convex_gap. `lower` receives a bound that the last direction proves;
// `parting` that direction, unit, from the corners to the body, where the bound is greater than `enough`.
template <std::size_t corner_count>
TriangleGap hull_convex_gap(const Vec3 (&corner)[corner_count], const convex::ConvexBody &body, const Pose &body_in_mesh,
                            double enough, double tolerance, double &lower, Vec3 &parting) {
  lower = 0.0;
  const auto support = [&](const Vec3 &d) {  // the farthest of the difference along d
    std::size_t farthest = 0;
    double most = dot(d, corner[0]);
    for (std::size_t k = 1; k < corner_count; ++k) {
      const double along = dot(d, corner[k]);
      if (along > most) most = along, farthest = k;
    }
    const Vec3 &on_triangle = corner[farthest];
    const Vec3 on_body = body_in_mesh(convex::core_support(body, -transposed_times(body_in_mesh.rotation, d)).point);
    return Difference{on_triangle - on_body, on_triangle, on_body};
  };
  const double slack = tolerance * convex::core_radius(body);
  // The corners that carry the nearest point found, with its weights.
  std::array<Difference, 3> simplex;
  std::size_t count = 1;
  simplex[0] = support(body_in_mesh.translation - corner[0]);
  Nearest nearest{simplex[0].w, {1.0, 0.0, 0.0}, norm2(simplex[0].w)};
  const auto gap = [&](double distance) {
    TriangleGap result{distance, {}, {}};
    for (std::size_t k = 0; k < count; ++k) {
      result.on_triangle = result.on_triangle + nearest.weight[k] * simplex[k].on_triangle;
      result.on_body = result.on_body + nearest.weight[k] * simplex[k].on_body;
    }
    return result;
  };
  for (int step = 0; step < most_steps; ++step) {
    const double distance = std::sqrt(nearest.distance2);
    if (distance <= slack) return gap(0.0);
    const Difference next = support(-nearest.point);
    lower = dot(next.w, nearest.point) / distance;
    if (lower > enough) {
      parting = (-1.0 / distance) * nearest.point;
      return {lower, {}, {}};
    }
    if (distance - lower <= slack) break;
    std::array<Difference, 3> tried = simplex;
    std::size_t tried_count = count;
    Nearest moved;
    if (count < 3) {
      tried[tried_count++] = next;
      moved = nearest_of(tried.data(), tried_count);
    } else {
      const std::array<Difference, 4> corners{simplex[0], simplex[1], simplex[2], next};
      if (!(lower > 0.0) && holds_origin(corners.data())) return gap(0.0);
      // The nearest face with the new corner; one corner goes.
      for (std::size_t k = 0; k < 3; ++k) {
        const std::array<Difference, 3> face{simplex[(k + 1) % 3], simplex[(k + 2) % 3], next};
        const Nearest candidate = nearest_of(face.data(), 3);
        if (!(candidate.distance2 < moved.distance2)) continue;
        moved = candidate;
        tried = face;
      }
    }
    if (!(moved.distance2 < nearest.distance2)) break;  // rounding ends the search
    nearest = {moved.point, {}, moved.distance2};
    // Corners that carry nothing go.
    count = 0;
    for (std::size_t k = 0; k < tried_count; ++k) {
      if (!(moved.weight[k] > 0.0)) continue;
      nearest.weight[count] = moved.weight[k];
      simplex[count++] = tried[k];
    }
  }
  return gap(std::sqrt(nearest.distance2));
}

}  // namespace

TriangleGap triangle_convex_gap(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::ConvexBody &body,
                                const Pose &body_in_mesh, double enough) {
  const Vec3 corner[3] = {a, b, c};
  double lower;
  Vec3 parting;
  return hull_convex_gap(corner, body, body_in_mesh, enough, is_polyhedral(body.core) ? polyhedral_tolerance : tolerance, lower,
                         parting);
}

TriangleGap triangle_polytope_gap(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::Polytope &body,
                                  const Pose &body_in_mesh, double enough, bool &proven, Vec3 &parting) {
  const Vec3 corner[3] = {a, b, c};
  const double size = body.radius() + std::fmax(norm(b - a), norm(c - a));
  double lower;
  const TriangleGap gap = hull_convex_gap(corner, convex::make_polytope(body), body_in_mesh, enough,
                                           polyhedral_tolerance, lower, parting);
  proven = lower > enough || gap.distance - lower <= 10.0 * polyhedral_tolerance * size;
  return gap;
}

bool are_parted(const Vec3 (&corner)[6], const convex::ConvexBody &body, const Pose &body_in_mesh) {
  double lower;
  Vec3 parting;
  hull_convex_gap(corner, body, body_in_mesh, 0.0, tolerance, lower, parting);
  return lower > 0.0;
}

}  // namespace cmb::mesh
