#include "narrowphase/polytope/surface_closure.hpp"

namespace cmb::convex {

namespace {

// The girdle's slope towards the far side.
constexpr double girdle_slope = 0.7;

}  // namespace

SurfaceClosure::SurfaceClosure(const MinkowskiDifference &difference, const Vec3 &normal, double radius)
    : difference_(difference), radius2_(radius * radius), normal_(normal),
      far_(difference.outer_point(-normal)) {}

// Seen from outside p, q and r are in counter-clockwise turn: whether the origin is below their plane by the radius.
bool SurfaceClosure::is_beyond(const Vec3 &p, const Vec3 &q, const Vec3 &r) const {
  const Vec3 across = cross(q - p, r - p);
  const double offset = dot(across, p);
  return offset > 0.0 && offset * offset >= radius2_ * norm2(across);
}

bool SurfaceClosure::put_girdle() {
  constexpr double cosine[girdle_points] = {1.0, 0.5, -0.5, -1.0, -0.5, 0.5}, half_root3 = 0.86602540378443865;
  constexpr double sine[girdle_points] = {0.0, half_root3, half_root3, 0.0, -half_root3, -half_root3};
  across_[0] = any_perpendicular(normal_);
  across_[1] = cross(normal_, across_[0]);
  for (int k = 0; k < girdle_points; ++k) {
    girdle_[k] = difference_.outer_point(girdle_slope * normal_ + cosine[k] * across_[0] + sine[k] * across_[1]);
  }
  for (int k = 0; k < girdle_points; ++k) {
    if (!is_beyond(girdle_[k], far_, girdle_[k + 1 == girdle_points ? 0 : k + 1])) return false;
  }
  with_girdle_ = true;
  return true;
}

// The girdle's point nearest to a direction, by the turn about the normal.
int SurfaceClosure::sector(const Vec3 &p) const {
  // Bounds of sectors are at odd twelfths of a turn: signs of three products.
  constexpr double root3 = 1.7320508075688773;
  const double x = dot(p, across_[0]), y = dot(p, across_[1]);
  const int bits = (x >= 0.0 ? 1 : 0) | (x + root3 * y >= 0.0 ? 2 : 0) | (x - root3 * y >= 0.0 ? 4 : 0);
  static constexpr int sectors[8] = {3, 0, 2, 1, 4, 5, 0, 0};
  return sectors[bits];
}

// The part of the closure at a side of the facets found, from p to q, is made of triangles from it to the far point or the
// girdle.
bool SurfaceClosure::holds(const Vec3 &p, const Vec3 &q) const {
  if (!with_girdle_) return is_beyond(q, p, far_);
  const int first = sector(p), last = sector(q);
  if (!is_beyond(q, p, girdle_[first])) return false;
  int at = first;
  for (int steps = 0; at != last; ++steps) {
    if (steps == girdle_points / 2) return false;  // it would lead backwards
    const int next = at + 1 == girdle_points ? 0 : at + 1;
    if (!is_beyond(q, girdle_[at], girdle_[next])) return false;
    at = next;
  }
  return true;
}

void SurfaceClosure::count_steps(const Vec3 &p, const Vec3 &q, int steps[girdle_points]) const {
  for (int at = sector(p), last = sector(q); at != last; at = at + 1 == girdle_points ? 0 : at + 1) ++steps[at];
}

}  // namespace cmb::convex
