#include "box_axes.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// The corner, edge or face of a box that is farthest along a direction, as a cycle of points.
struct Rim {
  Vec3 point[8];
  int count = 0;
};

// `box` maps the box's frame to the common one; `m` is the direction in the box's frame.
Rim farthest_rim(const Vec3 &half, const Pose &box, const Vec3 &m, double slack) {
  Vec3 corner;
  int free_axis[3];
  int free_count = 0;
  for (int k = 0; k < 3; ++k) {
    corner.set(k, m[k] < 0.0 ? -half[k] : half[k]);
    if (std::fabs(m[k]) * 2.0 * half[k] <= slack) free_axis[free_count++] = k;
  }
  Rim rim;
  if (free_count == 0) {
    rim.point[rim.count++] = box(corner);
    return rim;
  }
  const auto add = [&](double s, double t) {
    Vec3 p = corner;
    p.set(free_axis[0], s * half[free_axis[0]]);
    if (free_count > 1) p.set(free_axis[1], t * half[free_axis[1]]);
    rim.point[rim.count++] = box(p);
  };
  add(-1, -1);
  add(1, -1);
  if (free_count > 1) add(1, 1), add(-1, 1);
  return rim;
}

// Keeps the part of `rim` where dot(direction, p) <= limit.
void clip(Rim &rim, const Vec3 &direction, double limit) {
  double height[8];
  bool beyond = false;
  for (int k = 0; k < rim.count; ++k) {
    height[k] = dot(direction, rim.point[k]) - limit;
    beyond = beyond || height[k] > 0.0;
  }
  if (!beyond) return;
  Rim kept;
  const int edges = rim.count == 2 ? 1 : rim.count;
  for (int k = 0; k < rim.count; ++k) {
    const double here = height[k];
    if (here <= 0.0 && kept.count < 8) kept.point[kept.count++] = rim.point[k];
    if (k >= edges) continue;
    const int next = k + 1 < rim.count ? k + 1 : 0;
    const double there = height[next];
    if (((here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0)) && kept.count < 8) {
      kept.point[kept.count++] = rim.point[k] + (here / (here - there)) * (rim.point[next] - rim.point[k]);
    }
  }
  if (kept.count > 0) rim = kept;  // nothing left: rounding; the unclipped part is as near as can be
}

// A point common to both rims, seen along m; its height along m is either rim's.
Vec3 common_point(const Rim &rim_a, const Rim &rim_b, const Vec3 &m) {
  if (rim_a.count == 1) return rim_a.point[0];
  if (rim_b.count == 1) return rim_b.point[0];
  if (rim_a.count == 2 && rim_b.count == 2) {
    const Vec3 u = rim_a.point[1] - rim_a.point[0], v = rim_b.point[1] - rim_b.point[0];
    const Vec3 side = cross(v, m);  // normal, in the plane, to B's edge
    const double slope = dot(u, side);
    if (std::fabs(slope) > 1e-9 * norm(u) * norm(v)) {
      const double t = dot(rim_b.point[0] - rim_a.point[0], side) / slope;
      return rim_a.point[0] + std::clamp(t, 0.0, 1.0) * u;
    }
  }
  const bool b_smaller = rim_b.count < rim_a.count;
  Rim common = b_smaller ? rim_b : rim_a;
  const Rim &other = b_smaller ? rim_a : rim_b;
  if (other.count == 2) {  // parallel edges
    const Vec3 v = other.point[1] - other.point[0];
    clip(common, v, dot(v, other.point[1]));
    clip(common, -v, -dot(v, other.point[0]));
  } else {
    const Vec3 middle = 0.5 * (other.point[0] + other.point[2]);
    for (int k = 0; k < 4; ++k) {
      const Vec3 &p = other.point[k], &q = other.point[(k + 1) % 4];
      Vec3 side = cross(q - p, m);
      if (dot(side, middle - p) > 0.0) side = -side;
      clip(common, side, dot(side, p));
    }
  }
  Vec3 mean;
  for (int k = 0; k < common.count; ++k) mean = mean + common.point[k];
  return (1.0 / common.count) * mean;
}

}  // namespace

BoxAxes box_axes(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a) {
  const Mat3 &r = b_in_a.rotation;
  const Vec3 &t = b_in_a.translation;
  const Vec3 t_in_b = transposed_times(r, t);
  double best = -INFINITY;
  double best_sign = 1.0;
  int best_axis = 0;
  double absolute[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) absolute[i][j] = std::fabs(r.row[i][j]);
  }
  const double scale = norm(half_a) + norm(half_b) + norm(t);
  for (int i = 0; i < 3; ++i) {
    const double reach = half_b.x * absolute[i][0] + half_b.y * absolute[i][1] + half_b.z * absolute[i][2];
    const double s = std::fabs(t[i]) - half_a[i] - reach;
    if (s > best) best = s, best_axis = i, best_sign = std::copysign(1.0, t[i]);
  }
  const double favour = 1e-14 * scale;  // ties go to the axes that come first
  for (int j = 0; j < 3; ++j) {
    const double reach = half_a.x * absolute[0][j] + half_a.y * absolute[1][j] + half_a.z * absolute[2][j];
    const double s = std::fabs(t_in_b[j]) - half_b[j] - reach;
    if (s > best + favour) best = s, best_axis = 3 + j, best_sign = std::copysign(1.0, t_in_b[j]);
  }
  Vec3 edge_axis;
  // Where a face parts the boxes, edges need not be looked at.
  for (int i = 0; i < 3 && best <= 0.0; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      // e_i x (column j of r) has the components 0, -r[i2][j], r[i1][j] on the axes i, i1, i2.
      const double length2 = r.row[i1][j] * r.row[i1][j] + r.row[i2][j] * r.row[i2][j];
      double s, along;
      Vec3 axis;
      if (length2 > 1e-6) {
        along = t[i2] * r.row[i1][j] - t[i1] * r.row[i2][j];
        const double reach = half_a[i1] * absolute[i2][j] + half_a[i2] * absolute[i1][j] +
                             half_b[j1] * absolute[i][j2] + half_b[j2] * absolute[i][j1];
        s = std::fabs(along) - reach;
        const double limit = best + favour;
        // s / sqrt(length2) > limit without the root in the common case
        if (limit < 0.0 ? (s < 0.0 && s * s >= limit * limit * length2) : s <= 0.0) continue;
        s /= std::sqrt(length2);
        if (!(s > limit)) continue;
        axis.set(i1, -r.row[i2][j]);
        axis.set(i2, r.row[i1][j]);
        axis = normalized(axis);
      } else {
        // Nearly parallel edges: an accurate common perpendicular and the full reach of both boxes.
        Vec3 e;
        e.set(i, 1.0);
        if (!common_perpendicular(e, r.column(j), axis)) continue;
        const Vec3 axis_in_b = transposed_times(r, axis);
        along = dot(t, axis);
        s = std::fabs(along);
        for (int k = 0; k < 3; ++k) s -= half_a[k] * std::fabs(axis[k]) + half_b[k] * std::fabs(axis_in_b[k]);
        if (!(s > best + favour)) continue;
      }
      best = s, best_axis = 6, best_sign = std::copysign(1.0, along), edge_axis = axis;
    }
  }
  BoxAxes result;
  result.separation = best;
  if (best_axis < 3) {
    result.axis = {};
    result.axis.set(best_axis, best_sign);
  } else {
    result.axis = best_sign * (best_axis < 6 ? r.column(best_axis - 3) : edge_axis);
  }
  if (best > 0.0) return result;
  const Vec3 &m = result.axis;
  const double slack = 1e-10 * scale;
  const Rim rim_a = farthest_rim(half_a, Pose{}, m, slack);
  const Rim rim_b = farthest_rim(half_b, b_in_a, -transposed_times(r, m), slack);
  const Vec3 p = common_point(rim_a, rim_b, m);
  // Exactly in A's supporting plane, and its partner in B's.
  const double plane = half_a.x * std::fabs(m.x) + half_a.y * std::fabs(m.y) + half_a.z * std::fabs(m.z);
  result.a = p + (plane - dot(m, p)) * m;
  result.b = result.a + best * m;
  return result;
}

}  // namespace cmb::convex
