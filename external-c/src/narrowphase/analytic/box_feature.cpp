#include "narrowphase/analytic/box_feature.hpp"

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
Vec3 middle_over(const BoxFeature &edge, const BoxFeature &other) {
  double low = -1.0, high = 1.0;
  for (int k = 0; k < other.dimension; ++k) {
    const Vec3 along = (1.0 / norm2(other.half[k])) * other.half[k];
    const double start = dot(along, edge.middle - other.middle), slope = dot(along, edge.half[0]);
    clip(start, slope, low, high);
    clip(-start, -slope, low, high);
  }
  return edge.middle + 0.5 * (low + high) * edge.half[0];
}

// A convex polygon in a face's coordinates, in which the face is the square of half edge 1.
struct Polygon {
  static constexpr int capacity = 8;
  struct Corner {
    double at[2];
  };
  Corner corner[capacity];
  int count = 0;

  void add(double x, double y) {
    if (count == capacity) return;  // more than a square's four borders leave of four corners: rounding
    corner[count].at[0] = x, corner[count].at[1] = y;
    ++count;
  }

  // Keeps what is on the inner side of one of the square's borders; or all, as above, where nothing is left.
  void clip(int axis, double sense) {
    double beyond[capacity], farthest = -1.0;
    for (int k = 0; k < count; ++k) {
      beyond[k] = sense * corner[k].at[axis] - 1.0;
      farthest = std::max(farthest, beyond[k]);
    }
    if (farthest <= 0.0) return;
    Polygon kept;
    for (int k = 0; k < count; ++k) {
      const int next = k + 1 < count ? k + 1 : 0;
      const double here = beyond[k], there = beyond[next];
      const Corner &from = corner[k], &to = corner[next];
      if (here <= 0.0) kept.add(from.at[0], from.at[1]);
      if ((here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0)) {
        const double way = here / (here - there);
        kept.add(from.at[0] + way * (to.at[0] - from.at[0]), from.at[1] + way * (to.at[1] - from.at[1]));
      }
    }
    if (kept.count > 0) *this = kept;
  }
};

Vec3 mean_of_common_corners(const BoxFeature &face, const BoxFeature &other) {
  const Vec3 along_x = (1.0 / norm2(other.half[0])) * other.half[0], along_y = (1.0 / norm2(other.half[1])) * other.half[1];
  const Vec3 between = face.middle - other.middle;
  const double x = dot(along_x, between), ux = dot(along_x, face.half[0]), vx = dot(along_x, face.half[1]);
  const double y = dot(along_y, between), uy = dot(along_y, face.half[0]), vy = dot(along_y, face.half[1]);
  Polygon common;
  common.add(x - ux - vx, y - uy - vy);
  common.add(x + ux - vx, y + uy - vy);
  common.add(x + ux + vx, y + uy + vy);
  common.add(x - ux + vx, y - uy + vy);
  common.clip(1, -1.0);
  common.clip(0, 1.0);
  common.clip(1, 1.0);
  common.clip(0, -1.0);
  double sum_x = 0.0, sum_y = 0.0;
  for (int k = 0; k < common.count; ++k) sum_x += common.corner[k].at[0], sum_y += common.corner[k].at[1];
  const double part = 1.0 / common.count;
  return other.middle + (part * sum_x) * other.half[0] + (part * sum_y) * other.half[1];
}

}  // namespace

BoxFeature farthest_feature(const Vec3 &half, const Pose &box, const Vec3 &m, double slack) {
  BoxFeature rim;
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

Vec3 common_point(const BoxFeature &a, const BoxFeature &b, const Vec3 &m) {
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
  const BoxFeature &smaller = b_smaller ? b : a, &larger = b_smaller ? a : b;
  return smaller.dimension == 1 ? middle_over(smaller, larger) : mean_of_common_corners(smaller, larger);
}

}  // namespace cmb::convex
