#include "mesh/contact/triangle_convex_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace cmb::mesh {

namespace {

constexpr int most_steps = 200;
// Agreement of the bounds, relative to the body: of round ones, and of those with corners, where the search ends at features.
constexpr double tolerance = 1e-10, polyhedral_tolerance = 1e-14;

// A point of (corners - body) and where it comes from. Not set at first: most searches end with the second one.
struct Difference {
  double w[3], triangle[3], body[3];

  void set(const Vec3 &of_triangle, const Vec3 &of_body) {
    w[0] = of_triangle.x - of_body.x, w[1] = of_triangle.y - of_body.y, w[2] = of_triangle.z - of_body.z;
    triangle[0] = of_triangle.x, triangle[1] = of_triangle.y, triangle[2] = of_triangle.z;
    body[0] = of_body.x, body[1] = of_body.y, body[2] = of_body.z;
  }
  Vec3 at() const { return {w[0], w[1], w[2]}; }
  Vec3 on_triangle() const { return {triangle[0], triangle[1], triangle[2]}; }
  Vec3 on_body() const { return {body[0], body[1], body[2]}; }
};

// The point nearest to the origin, of those that were looked at, as weights of some of four corners.
struct Nearest {
  Vec3 point;
  double distance2 = std::numeric_limits<double>::infinity();
  std::size_t count = 0;
  std::array<std::size_t, 3> corner{};
  std::array<double, 3> weight;

  // Takes what is nearer than before; whether it was.
  bool take(const Vec3 &offered) {
    const double d2 = norm2(offered);
    if (!(d2 < distance2)) return false;
    point.x = offered.x, point.y = offered.y, point.z = offered.z;  // member by member, which does not wait for a copy
    distance2 = d2;
    return true;
  }
};

// One of four places that none of the corners has.
std::size_t free_place(const Nearest &nearest) {
  unsigned taken = 0;
  for (std::size_t k = 0; k < nearest.count; ++k) taken |= 1u << nearest.corner[k];
  std::size_t place = 0;
  while ((taken >> place & 1u) != 0) ++place;
  return place;
}

void look_at_corner(const Difference *s, std::size_t i, Nearest &nearest) {
  if (!nearest.take(s[i].at())) return;
  nearest.count = 1;
  nearest.corner[0] = i;
  nearest.weight[0] = 1.0;
}

void look_at_edge(const Difference *s, std::size_t i, std::size_t j, Nearest &nearest) {
  const Vec3 edge = s[j].at() - s[i].at();
  const double length2 = norm2(edge), part = -dot(s[i].at(), edge);
  if (!(part > 0.0 && part < length2)) return;
  const double second = part / length2, first = 1.0 - second;
  if (!nearest.take(first * s[i].at() + second * s[j].at())) return;
  nearest.count = 2;
  nearest.corner[0] = i, nearest.corner[1] = j;
  nearest.weight[0] = first, nearest.weight[1] = second;
}

void look_at_face(const Difference *s, std::size_t i, std::size_t j, std::size_t k, Nearest &nearest) {
  const Vec3 n = cross(s[j].at() - s[i].at(), s[k].at() - s[i].at());
  const double n2 = norm2(n);
  const double of_i = dot(n, cross(s[j].at(), s[k].at())), of_j = dot(n, cross(s[k].at(), s[i].at())), of_k = dot(n, cross(s[i].at(), s[j].at()));
  if (!(n2 > 0.0 && of_i > 0.0 && of_j > 0.0 && of_k > 0.0)) return;
  const double sum = of_i + of_j + of_k, first = of_i / sum, second = of_j / sum, third = of_k / sum;
  if (!nearest.take(first * s[i].at() + second * s[j].at() + third * s[k].at())) return;
  nearest.count = 3;
  nearest.corner[0] = i, nearest.corner[1] = j, nearest.corner[2] = k;
  nearest.weight[0] = first, nearest.weight[1] = second, nearest.weight[2] = third;
}

// What the corner `next` makes with the `count` others.
void look_at_all(const Difference *s, const std::array<std::size_t, 3> &known, std::size_t count, std::size_t next, Nearest &nearest) {
  const std::size_t a = known[0], b = known[1], c = known[2];
  if (count == 1) {
    look_at_corner(s, a, nearest);
    look_at_corner(s, next, nearest);
    look_at_edge(s, a, next, nearest);
    return;
  }
  if (count == 2) {
    look_at_corner(s, a, nearest);
    look_at_corner(s, b, nearest);
    look_at_corner(s, next, nearest);
    look_at_edge(s, a, b, nearest);
    look_at_edge(s, a, next, nearest);
    look_at_edge(s, b, next, nearest);
    look_at_face(s, a, b, next, nearest);
    return;
  }
  // The faces with the new corner, each with those of its edges and corners that no earlier one has.
  look_at_corner(s, b, nearest);
  look_at_corner(s, c, nearest);
  look_at_corner(s, next, nearest);
  look_at_edge(s, b, c, nearest);
  look_at_edge(s, b, next, nearest);
  look_at_edge(s, c, next, nearest);
  look_at_face(s, b, c, next, nearest);
  look_at_corner(s, a, nearest);
  look_at_edge(s, c, a, nearest);
  look_at_edge(s, a, next, nearest);
  look_at_face(s, c, a, next, nearest);
  look_at_edge(s, a, b, nearest);
  look_at_face(s, a, b, next, nearest);
}

// Whether the origin lies in the tetrahedron: on each face's side of the opposite corner, and no farther from the face than
// that. Of a flat one rounding alone would tell the sides.
bool holds_origin(const Difference *s, const std::array<std::size_t, 4> &corner) {
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 a = s[corner[(k + 1) % 4]].at(), b = s[corner[(k + 2) % 4]].at(), c = s[corner[(k + 3) % 4]].at(), opposite = s[corner[k]].at();
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
  const auto put_support = [&](const Vec3 &d, Difference &place) {  // the farthest of the difference along d
    std::size_t farthest = 0;
    double most = dot(d, corner[0]);
    for (std::size_t k = 1; k < corner_count; ++k) {
      const double along = dot(d, corner[k]);
      if (along > most) most = along, farthest = k;
    }
    place.set(corner[farthest], body_in_mesh(convex::core_support(body, -transposed_times(body_in_mesh.rotation, d)).point));
  };
  const double slack = tolerance * convex::core_radius(body);
  // Room for the corners that carry the nearest point found and for a new one.
  std::array<Difference, 4> pool;
  put_support(body_in_mesh.translation - corner[0], pool[0]);
  Nearest rooms[2], *nearest = &rooms[0], *moved = &rooms[1];
  look_at_corner(pool.data(), 0, *nearest);
  const auto gap = [&](double distance) {
    TriangleGap result{distance, {}, {}};
    for (std::size_t k = 0; k < nearest->count; ++k) {
      result.on_triangle = result.on_triangle + nearest->weight[k] * pool[nearest->corner[k]].on_triangle();
      result.on_body = result.on_body + nearest->weight[k] * pool[nearest->corner[k]].on_body();
    }
    return result;
  };
  for (int step = 0; step < most_steps; ++step) {
    const double distance = std::sqrt(nearest->distance2);
    if (distance <= slack) return gap(0.0);
    const std::size_t next = free_place(*nearest);
    put_support(-nearest->point, pool[next]);
    lower = dot(pool[next].at(), nearest->point) / distance;
    if (lower > enough) {
      parting = (-1.0 / distance) * nearest->point;
      return {lower, {}, {}};
    }
    if (distance - lower <= slack) break;
    if (nearest->count == 3 && !(lower > 0.0) &&
        holds_origin(pool.data(), {nearest->corner[0], nearest->corner[1], nearest->corner[2], next})) {
      return gap(0.0);
    }
    moved->distance2 = std::numeric_limits<double>::infinity();
    look_at_all(pool.data(), nearest->corner, nearest->count, next, *moved);
    if (!(moved->distance2 < nearest->distance2)) break;  // rounding ends the search
    // Corners that carry nothing go.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < moved->count; ++k) {
      if (!(moved->weight[k] > 0.0)) continue;
      moved->weight[kept] = moved->weight[k];
      moved->corner[kept++] = moved->corner[k];
    }
    moved->count = kept;
    std::swap(nearest, moved);
  }
  return gap(std::sqrt(nearest->distance2));
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
