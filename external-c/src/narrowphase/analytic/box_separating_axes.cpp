#include "narrowphase/analytic/box_separating_axes.hpp"

#include <algorithm>

#include "narrowphase/analytic/box_feature.hpp"

namespace cmb::convex {

void find_box_axes(const BoxPair &boxes, BoxAxes &result) {
  const Vec3 &half_a = boxes.half_a(), &half_b = boxes.half_b();
  const Mat3 &r = boxes.b_in_a().rotation;
  const Vec3 &t = boxes.b_in_a().translation;
  double best = -INFINITY, best_shift = 1.0;
  int best_axis = 0;
  const double scale = norm(half_a) + norm(half_b) + norm(t);
  const double favour = 1e-14 * scale;  // ties go to the axes that come first
  for (int i = 0; i < 3; ++i) {
    const double s = std::fabs(boxes.shift_a[i]) - boxes.a[i] - boxes.reach_of_b[i];
    if (s > best) best = s, best_axis = i, best_shift = boxes.shift_a[i];
  }
  for (int j = 0; j < 3; ++j) {
    const double s = std::fabs(boxes.shift_b[j]) - boxes.b[j] - boxes.reach_of_a[j];
    if (s > best + favour) best = s, best_axis = 3 + j, best_shift = boxes.shift_b[j];
  }
  Vec3 edge_axis;
  // Where a face parts the boxes, edges need not be looked at.
  AcrossEdges edges;
  if (best <= 0.0) edges.find(boxes);
  for (int i = 0; i < 3 && best <= 0.0; ++i) {
    for (int j = 0; j < 3; ++j) {
      const auto &across = edges.of[i][j];
      double s, along;
      Vec3 axis;
      if (across.length2 > 1e-6) {
        along = across.shift;
        s = std::fabs(along) - across.reach;
        const double limit = best + favour;
        // s / sqrt(length2) > limit without the root in the common case
        if (limit < 0.0 ? (s < 0.0 && s * s >= limit * limit * across.length2) : s <= 0.0) continue;
        s /= std::sqrt(across.length2);
        if (!(s > limit)) continue;
        axis = normalized(boxes.across_direction(i, j));
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
      best = s, best_axis = 6, best_shift = along, edge_axis = axis;
    }
  }
  result.separation = best;
  const double sense = std::copysign(1.0, best_shift);
  if (best_axis < 3) {
    result.axis = {};
    result.axis.set(best_axis, sense);
  } else {
    result.axis = sense * (best_axis < 6 ? r.column(best_axis - 3) : edge_axis);
  }
  if (best > 0.0) return;
  const Vec3 &m = result.axis;
  const double slack = 1e-10 * scale;
  const BoxFeature rim_a = farthest_feature(half_a, Pose{}, m, slack);
  const BoxFeature rim_b = farthest_feature(half_b, boxes.b_in_a(), -transposed_times(r, m), slack);
  const Vec3 p = common_point(rim_a, rim_b, m);
  // Exactly in A's supporting plane, and its partner in B's.
  const double plane = half_a.x * std::fabs(m.x) + half_a.y * std::fabs(m.y) + half_a.z * std::fabs(m.z);
  result.a = p + (plane - dot(m, p)) * m;
  result.b = result.a + best * m;
}

}  // namespace cmb::convex
