#include "narrowphase/gjk.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// The point of a simplex nearest to the origin, of those that were looked at: its weights and the squared distance.
struct Nearest {
  Vec3 point;
  double weight[4];
  double distance2 = INFINITY;

  // Takes a point that is nearer; false where this one is not.
  bool take(const Vec3 &offered) {
    const double offered2 = norm2(offered);
    if (!(offered2 < distance2)) return false;
    point = offered;
    distance2 = offered2;
    std::fill(weight, weight + 4, 0.0);
    return true;
  }
};

void look_at_segment(const Vec3 *p, int i, int j, Nearest &nearest) {
  const Vec3 edge = p[j] - p[i];
  const double along = -dot(p[i], edge), length2 = norm2(edge);
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  // Of the two ends the nearer one is the better origin for the sum.
  Vec3 point = t < 0.5 ? p[i] + t * edge : p[j] - (1.0 - t) * edge;
  // The search direction must be normal to the edge even where the origin all but touches it.
  if (t > 0.0 && t < 1.0) point = point - (dot(point, edge) / length2) * edge;
  if (!nearest.take(point)) return;
  nearest.weight[i] = 1.0 - t;
  nearest.weight[j] = t;
}

// Interior of the triangle if the origin projects into it, else the best of its edges. All three
// edges are looked at where the triangle is degenerate, so that rounding cannot lose a region.
void look_at_triangle(const Vec3 *p, int i, int j, int k, Nearest &nearest) {
  const Vec3 ab = p[j] - p[i], ac = p[k] - p[i], bc = p[k] - p[j];
  // The two shorter edges give the normal with the least rounding.
  const double ab2 = norm2(ab), ac2 = norm2(ac), bc2 = norm2(bc);
  const Vec3 n = ab2 >= ac2 && ab2 >= bc2 ? cross(ac, bc) : ac2 >= bc2 ? cross(ab, bc) : cross(ab, ac);
  const double n2 = norm2(n);
  // Areas (times n) of the triangles that the origin's projection makes with the edges.
  const double u = dot(cross(p[j], bc), n), v = -dot(cross(p[k], ac), n), w = dot(cross(p[i], ab), n);
  if (n2 > 0.0 && u > 0.0 && v > 0.0 && w > 0.0) {
    if (!nearest.take((dot(n, p[i]) / n2) * n)) return;
    const double sum = u + v + w;
    nearest.weight[i] = u / sum;
    nearest.weight[j] = v / sum;
    nearest.weight[k] = w / sum;
    return;
  }
  const bool degenerate = !(n2 > 1e-24 * ab2 * ac2);
  if (w <= 0.0 || degenerate) look_at_segment(p, i, j, nearest);
  if (u <= 0.0 || degenerate) look_at_segment(p, j, k, nearest);
  if (v <= 0.0 || degenerate) look_at_segment(p, i, k, nearest);
}

// distance2 is 0 where the tetrahedron holds the origin.
void look_at_flat_tetrahedron(const Vec3 *p, Nearest &nearest) {
  bool inside = true;
  double origin_side[4], inner_side[4];  // of the faces opposite each corner
  const auto look_at_face = [&](int i, int j, int k, int opposite) {
    const Vec3 n = cross(p[j] - p[i], p[k] - p[i]);
    const double origin = -dot(n, p[i]), inner = dot(n, p[opposite] - p[i]);
    origin_side[opposite] = origin, inner_side[opposite] = inner;
    if (inner != 0.0 && origin * inner > 0.0) return;
    inside = false;
    look_at_triangle(p, i, j, k, nearest);
  };
  look_at_face(0, 1, 2, 3);
  look_at_face(0, 1, 3, 2);
  look_at_face(0, 2, 3, 1);
  look_at_face(1, 2, 3, 0);
  if (!inside) return;
  for (int k = 0; k < 4; ++k) nearest.weight[k] = origin_side[k] / inner_side[k];
  const double sum = nearest.weight[0] + nearest.weight[1] + nearest.weight[2] + nearest.weight[3];
  for (double &weight : nearest.weight) weight /= sum;
  nearest.distance2 = 0.0;
}

// The last corner lies before the other three as seen from the origin, whose nearest point of these is known: it is nearest to none of their
// face's points now. Where rounding may decide that, all faces are looked at.
void look_at_tetrahedron(const Vec3 *p, Nearest &nearest) {
  constexpr double flat = 1e-6;
  const Vec3 a = p[0] - p[3], b = p[1] - p[3], c = p[2] - p[3];
  const Vec3 ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const double volume = dot(ab, c);
  if (!(volume * volume > flat * flat * (norm2(a) * norm2(b) * norm2(c)))) return look_at_flat_tetrahedron(p, nearest);
  const double before_ab = -volume * dot(ab, p[3]), before_bc = -volume * dot(bc, p[3]), before_ca = -volume * dot(ca, p[3]);
  if (before_ab > 0.0 && before_bc > 0.0 && before_ca > 0.0) return look_at_flat_tetrahedron(p, nearest);
  if (!(before_ab > 0.0)) look_at_triangle(p, 0, 1, 3, nearest);
  if (!(before_ca > 0.0)) look_at_triangle(p, 0, 2, 3, nearest);
  if (!(before_bc > 0.0)) look_at_triangle(p, 1, 2, 3, nearest);
}

void settle(GjkResult &result, double distance, double slack) {
  const bool proven = result.lower > 0.0 && distance - result.lower <= slack;
  result.status = proven ? GjkResult::Status::apart : GjkResult::Status::uncertain;
}

}  // namespace

GjkResult gjk_distance(const MinkowskiDifference &difference, const Vec3 &first, double tolerance, double enough) {
  GjkResult result = gjk_start(difference, first);
  gjk_continue(difference, tolerance, enough, result);
  return result;
}

GjkResult gjk_start(const MinkowskiDifference &difference, const Vec3 &first) {
  GjkResult result;
  result.simplex[0] = difference.support(-first);
  result.count = 1;
  result.closest = result.simplex[0].w;
  return result;
}

void gjk_continue(const MinkowskiDifference &difference, double tolerance, double enough, GjkResult &result) {
  const double noise = 1e-15 * difference.scale;
  const double slack = std::max(tolerance, 1000.0 * noise);
  double distance = norm(result.closest);
  Vec3 p[4];  // of the simplex
  for (int k = 0; k < result.count; ++k) p[k] = result.simplex[k].w;
  while (result.steps < 100) {
    ++result.steps;
    if (!(distance > 64.0 * noise)) {
      result.status = GjkResult::Status::touching;
      return;
    }
    DifferencePoint &candidate = result.simplex[result.count];
    candidate = difference.support(-result.closest);
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
    const int count = result.count + 1;
    p[result.count] = candidate.w;
    Nearest nearest;
    if (count == 2) {
      look_at_segment(p, 0, 1, nearest);
    } else if (count == 3) {
      look_at_triangle(p, 0, 1, 2, nearest);
    } else {
      look_at_tetrahedron(p, nearest);
    }
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
    int kept = 0;
    for (int k = 0; k < count; ++k) {
      if (!(nearest.weight[k] > 0.0)) continue;
      if (kept < k) {
        result.simplex[kept] = result.simplex[k];
        p[kept] = p[k];
      }
      result.weight[kept++] = nearest.weight[k];
    }
    result.count = kept;
    result.closest = nearest.point;
    distance = next;
  }
  result.status = GjkResult::Status::uncertain;
}

}  // namespace cmb::convex
