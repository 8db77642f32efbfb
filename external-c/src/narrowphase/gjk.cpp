#include "narrowphase/gjk.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// The point of a simplex nearest to the origin: its weights and the squared distance.
struct Nearest {
  Vec3 point;
  double weight[4] = {0, 0, 0, 0};
  double distance2 = INFINITY;
};

void keep_nearer(Nearest &best, const Nearest &candidate) {
  if (candidate.distance2 < best.distance2) best = candidate;
}

Nearest nearest_on_segment(const Vec3 *p, int i, int j) {
  const Vec3 edge = p[j] - p[i];
  const double along = -dot(p[i], edge), length2 = norm2(edge);
  Nearest result;
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  result.weight[i] = 1.0 - t;
  result.weight[j] += t;
  // Of the two ends the nearer one is the better origin for the sum.
  result.point = t < 0.5 ? p[i] + t * edge : p[j] - (1.0 - t) * edge;
  // The search direction must be normal to the edge even where the origin all but touches it.
  if (t > 0.0 && t < 1.0) result.point = result.point - (dot(result.point, edge) / length2) * edge;
  result.distance2 = norm2(result.point);
  return result;
}

// Interior of the triangle if the origin projects into it, else the best of its edges. All three
// edges are looked at where the triangle is degenerate, so that rounding cannot lose a region.
Nearest nearest_on_triangle(const Vec3 *p, int i, int j, int k) {
  const Vec3 ab = p[j] - p[i], ac = p[k] - p[i], bc = p[k] - p[j];
  // The two shorter edges give the normal with the least rounding.
  const double ab2 = norm2(ab), ac2 = norm2(ac), bc2 = norm2(bc);
  const Vec3 n = ab2 >= ac2 && ab2 >= bc2 ? cross(ac, bc) : ac2 >= bc2 ? cross(ab, bc) : cross(ab, ac);
  const double n2 = norm2(n);
  // Areas (times n) of the triangles that the origin's projection makes with the edges.
  const double u = dot(cross(p[j], bc), n), v = -dot(cross(p[k], ac), n), w = dot(cross(p[i], ab), n);
  Nearest result;
  if (n2 > 0.0 && u > 0.0 && v > 0.0 && w > 0.0) {
    const double sum = u + v + w;
    result.weight[i] = u / sum;
    result.weight[j] = v / sum;
    result.weight[k] = w / sum;
    result.point = (dot(n, p[i]) / n2) * n;
    result.distance2 = norm2(result.point);
    return result;
  }
  const bool degenerate = !(n2 > 1e-24 * ab2 * ac2);
  if (w <= 0.0 || degenerate) keep_nearer(result, nearest_on_segment(p, i, j));
  if (u <= 0.0 || degenerate) keep_nearer(result, nearest_on_segment(p, j, k));
  if (v <= 0.0 || degenerate) keep_nearer(result, nearest_on_segment(p, i, k));
  return result;
}

// distance2 is 0 where the tetrahedron holds the origin.
Nearest nearest_on_tetrahedron(const Vec3 *p) {
  static constexpr int face[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
  Nearest result;
  bool inside = true;
  double height[4];
  for (int f = 0; f < 4; ++f) {
    const Vec3 &a = p[face[f][0]], &b = p[face[f][1]], &c = p[face[f][2]], &opposite = p[face[f][3]];
    const Vec3 n = cross(b - a, c - a);
    const double origin_side = -dot(n, a), inner_side = dot(n, opposite - a);
    height[face[f][3]] = inner_side != 0.0 ? origin_side / inner_side : 0.0;
    if (inner_side != 0.0 && origin_side * inner_side > 0.0) continue;
    inside = false;
    keep_nearer(result, nearest_on_triangle(p, face[f][0], face[f][1], face[f][2]));
  }
  if (!inside) return result;
  const double sum = height[0] + height[1] + height[2] + height[3];
  for (int k = 0; k < 4; ++k) result.weight[k] = height[k] / sum;
  result.distance2 = 0.0;
  return result;
}

void settle(GjkResult &result, double distance, double slack) {
  const bool proven = result.lower > 0.0 && distance - result.lower <= slack;
  result.status = proven ? GjkResult::Status::apart : GjkResult::Status::uncertain;
}

}  // namespace

GjkResult gjk_distance(const MinkowskiDifference &difference, const Vec3 &first, double tolerance, double enough) {
  GjkResult result;
  result.simplex[0] = difference.support(-first);
  result.count = 1;
  result.closest = result.simplex[0].w;
  gjk_continue(difference, tolerance, enough, result);
  return result;
}

void gjk_continue(const MinkowskiDifference &difference, double tolerance, double enough, GjkResult &result) {
  const double noise = 1e-15 * difference.scale;
  const double slack = std::max(tolerance, 1000.0 * noise);
  double distance = norm(result.closest);
  while (result.steps < 100) {
    ++result.steps;
    if (!(distance > 64.0 * noise)) {
      result.status = GjkResult::Status::touching;
      return;
    }
    const DifferencePoint candidate = difference.support(-result.closest);
    const double height = dot(candidate.w, result.closest) / distance;
    if (height > result.lower || result.steps == 1) {
      result.lower = std::max(0.0, height);
      result.direction = (-1.0 / distance) * result.closest;
    }
    if (result.lower > 0.0 && distance - result.lower <= enough * distance) {
      result.status = GjkResult::Status::apart;
      return;
    }
    bool repeated = false;
    for (int k = 0; k < result.count; ++k) repeated = repeated || same_vertices(candidate, result.simplex[k]);
    // A repeated point means that rounding alone is left of the gap, unless the simplex is bad.
    if (distance - result.lower <= tolerance || repeated) return settle(result, distance, slack);
    Vec3 p[4];
    for (int k = 0; k < result.count; ++k) p[k] = result.simplex[k].w;
    p[result.count] = candidate.w;
    result.simplex[result.count] = candidate;
    const int count = result.count + 1;
    const Nearest nearest = count == 2   ? nearest_on_segment(p, 0, 1)
                            : count == 3 ? nearest_on_triangle(p, 0, 1, 2)
                                         : nearest_on_tetrahedron(p);
    if (count == 4 && nearest.distance2 == 0.0) {
      result.count = 4;
      std::copy(nearest.weight, nearest.weight + 4, result.weight);
      result.closest = {};
      result.status = GjkResult::Status::touching;
      return;
    }
    const double next = std::sqrt(nearest.distance2);
    if (!(next < distance)) {  // rounding: no progress; the weights still belong to the last simplex
      result.count = count - 1;
      return settle(result, distance, slack);
    }
    result.count = 0;
    for (int k = 0; k < count; ++k) {
      if (!(nearest.weight[k] > 0.0)) continue;
      result.simplex[result.count] = result.simplex[k];
      result.weight[result.count++] = nearest.weight[k];
    }
    result.closest = nearest.point;
    distance = next;
  }
  result.status = GjkResult::Status::uncertain;
}

}  // namespace cmb::convex
