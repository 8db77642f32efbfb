#include "box_rim.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// The part [low, high] of a line's points for which start + t * slope <= 1. Where nothing is left, which rounding may do, the
// part stays as it is: it is as near as can be.
void clip(double start, double slope, double &low, double &high) {
  const double at_low = start + low * slope - 1.0, at_high = start + high * slope - 1.0;
  if ((at_low <= 0.0) == (at_high <= 0.0)) return;
  const double border = low + at_low / (at_low - at_high) * (high - low);
  (at_low <= 0.0 ? high : low) = border;
}

// The middle of what of an edge is over another edge, parallel to it, or over a face.
Vec3 middle_over(const BoxRim &edge, const BoxRim &other) {
  double low = -1.0, high = 1.0;
  for (int k = 0; k < other.dimension; ++k) {
    const Vec3 along = (1.0 / norm2(other.half[k])) * other.half[k];
    const double start = dot(along, edge.middle - other.middle), slope = dot(along, edge.half[0]);
    clip(start, slope, low, high);
    clip(-start, -slope, low, high);
  }
  return edge.middle + 0.5 * (low + high) * edge.half[0];
}

// A point, in the coordinates of a face that is the square |x| <= 1, |y| <= 1.
struct Place {
  double x, y;
  bool in_square() const { return std::fabs(x) <= 1.0 && std::fabs(y) <= 1.0; }
};

Place place(const BoxRim &face, const Vec3 &way) {
  return {dot(face.half[0], way) / norm2(face.half[0]), dot(face.half[1], way) / norm2(face.half[1])};
}

// Sums up places.
struct Places {
  double x = 0.0, y = 0.0, count = 0.0;

  void add_if(bool counts, const Place &p) {
    const auto one = static_cast<double>(counts);  // which ones count cannot be foretold: no branch
    x += one * p.x, y += one * p.y, count += one;
  }
};

// Narrows [from, to] to where |x + t dx| <= 1.
void narrow(double x, double dx, double inverse, double &from, double &to) {
  if (dx == 0.0) {
    if (std::fabs(x) > 1.0) to = -1.0;
    return;
  }
  const double first = (-1.0 - x) * inverse, second = (1.0 - x) * inverse;
  from = std::max(from, std::min(first, second));
  to = std::min(to, std::max(first, second));
}

Vec3 mean_of_common_corners(const BoxRim &face, const BoxRim &other) {
  const Place middle = place(other, face.middle - other.middle);
  const Place u = place(other, face.half[0]), v = place(other, face.half[1]);
  Places corners;
  // The face's corners and where its edges enter and leave the square.
  const auto add_edges = [&](const Place &along, const Place &aside) {
    const double dx = 2.0 * along.x, dy = 2.0 * along.y, inverse_x = 1.0 / dx, inverse_y = 1.0 / dy;
    for (const double side : {-1.0, 1.0}) {
      // One edge runs forwards, the other one back, so that each corner begins one edge.
      const Place begin{middle.x + side * aside.x + side * along.x, middle.y + side * aside.y + side * along.y};
      double from = 0.0, to = 1.0;
      narrow(begin.x, -side * dx, -side * inverse_x, from, to);
      narrow(begin.y, -side * dy, -side * inverse_y, from, to);
      const auto at = [&](double t) { return Place{begin.x - t * side * dx, begin.y - t * side * dy}; };
      corners.add_if(begin.in_square(), begin);
      corners.add_if((from > 0.0) & (from < to), at(from));
      corners.add_if((to < 1.0) & (from < to), at(to));
    }
  };
  add_edges(u, v);
  add_edges(v, {-u.x, -u.y});
  // The square's corners inside the face: one on its border has been met there.
  const double area = u.x * v.y - u.y * v.x;
  for (const Place &corner : {Place{-1.0, -1.0}, Place{1.0, -1.0}, Place{1.0, 1.0}, Place{-1.0, 1.0}}) {
    const double x = corner.x - middle.x, y = corner.y - middle.y;
    corners.add_if((std::fabs(x * v.y - y * v.x) < std::fabs(area)) & (std::fabs(y * u.x - x * u.y) < std::fabs(area)), corner);
  }
  const double part = 1.0 / corners.count;
  return corners.count > 0.0 ? other.middle + (part * corners.x) * other.half[0] + (part * corners.y) * other.half[1]
                             : face.middle;  // they meet by rounding only
}

}  // namespace

BoxRim farthest_rim(const Vec3 &half, const Pose &box, const Vec3 &m, double slack) {
  BoxRim rim;
  Vec3 corner;
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(m[k]) * 2.0 * half[k] <= slack && rim.dimension < 2) {
      rim.half[rim.dimension++] = half[k] * box.rotation.column(k);
    } else {
      corner.set(k, m[k] < 0.0 ? -half[k] : half[k]);
    }
  }
  rim.middle = box(corner);
  return rim;
}

Vec3 common_point(const BoxRim &a, const BoxRim &b, const Vec3 &m) {
  if (a.dimension == 0) return a.middle;
  if (b.dimension == 0) return b.middle;
  if (a.dimension == 1 && b.dimension == 1) {
    const Vec3 &u = a.half[0], &v = b.half[0];
    const Vec3 side = cross(v, m);  // normal, in the plane, to B's edge
    const double slope = dot(u, side);
    if (std::fabs(slope) > 1e-9 * norm(u) * norm(v)) {
      return a.middle + std::clamp(dot(b.middle - a.middle, side) / slope, -1.0, 1.0) * u;
    }
  }
  const bool b_smaller = b.dimension < a.dimension;
  const BoxRim &smaller = b_smaller ? b : a, &larger = b_smaller ? a : b;
  return smaller.dimension == 1 ? middle_over(smaller, larger) : mean_of_common_corners(smaller, larger);
}

}  // namespace cmb::convex
