#include "narrowphase/polytope/patch_completion.hpp"

namespace cmb::convex {

namespace {

// The support ring's slope towards the far side.
constexpr double ring_slope = 0.7;

}  // namespace

PatchCompletion::PatchCompletion(const MinkowskiDifference &difference, const Vec3 &normal, double radius)
    : difference_(difference), radius2_(radius * radius), normal_(normal),
      far_(difference.outer_point(-normal)) {}

// Seen from outside p, q and r are in counter-clockwise turn: whether the origin is below their plane by the radius.
bool PatchCompletion::is_beyond(const Vec3 &p, const Vec3 &q, const Vec3 &r) const {
  const Vec3 across = cross(q - p, r - p);
  const double offset = dot(across, p);
  return offset > 0.0 && offset * offset >= radius2_ * norm2(across);
}

bool PatchCompletion::add_ring() {
  constexpr double cosine[ring_points] = {1.0, 0.5, -0.5, -1.0, -0.5, 0.5}, half_root3 = 0.86602540378443865;
  constexpr double sine[ring_points] = {0.0, half_root3, half_root3, 0.0, -half_root3, -half_root3};
  across_[0] = any_perpendicular(normal_);
  across_[1] = cross(normal_, across_[0]);
  for (int k = 0; k < ring_points; ++k) {
    ring_[k] = difference_.outer_point(ring_slope * normal_ + cosine[k] * across_[0] + sine[k] * across_[1]);
  }
  for (int k = 0; k < ring_points; ++k) {
    if (!is_beyond(ring_[k], far_, ring_[k + 1 == ring_points ? 0 : k + 1])) return false;
  }
  has_ring_ = true;
  return true;
}

// The support ring's point nearest to a direction, by the turn about the normal.
int PatchCompletion::sector(const Vec3 &p) const {
  // Bounds of sectors are at odd twelfths of a turn: signs of three products.
  constexpr double root3 = 1.7320508075688773;
  const double x = dot(p, across_[0]), y = dot(p, across_[1]);
  const int bits = (x >= 0.0 ? 1 : 0) | (x + root3 * y >= 0.0 ? 2 : 0) | (x - root3 * y >= 0.0 ? 4 : 0);
  static constexpr int sectors[8] = {3, 0, 2, 1, 4, 5, 0, 0};
  return sectors[bits];
}

// The part of the completion at a side of the facets found, from p to q, is made of triangles from it to the far point or the
// girdle.
bool PatchCompletion::holds(const Vec3 &p, const Vec3 &q) const {
  if (!has_ring_) return is_beyond(q, p, far_);
  const int first = sector(p), last = sector(q);
  if (!is_beyond(q, p, ring_[first])) return false;
  int at = first;
  for (int steps = 0; at != last; ++steps) {
    if (steps == ring_points / 2) return false;  // it would lead backwards
    const int next = at + 1 == ring_points ? 0 : at + 1;
    if (!is_beyond(q, ring_[at], ring_[next])) return false;
    at = next;
  }
  return true;
}

void PatchCompletion::count_steps(const Vec3 &p, const Vec3 &q, int steps[ring_points]) const {
  for (int at = sector(p), last = sector(q); at != last; at = at + 1 == ring_points ? 0 : at + 1) ++steps[at];
}

}  // namespace cmb::convex
