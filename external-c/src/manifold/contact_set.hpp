// The points at which a pair touches.
#pragma once

#include <cstddef>
#include <vector>

#include "math/vector3.hpp"

namespace cmb {

using convex::Vec3;

struct ContactPoint {
  double depth = 0.0;   // m, > 0
  double weight = 0.0;  // > 0
  Vec3 normal;          // unit, from the second body towards the first
  Vec3 position;        // half way between the two surfaces
};

// A pair's contact, in world axes. Cleared and refilled, so that it stops allocating.
struct ContactSet {
  double distance = 0.0;  // signed
  Vec3 normal;            // at the closest or deepest place, also where the bodies are apart
  Vec3 witness;           // half way between the closest or deepest points
  std::vector<ContactPoint> points;
};

// Turns the contact of (B, A) into that of (A, B).
inline void reverse(ContactSet &contact) {
  contact.normal = -contact.normal;
  for (ContactPoint &point : contact.points) point.normal = -point.normal;
}

// The sum of weight * depth.
double total_load(const std::vector<ContactPoint> &points, std::size_t begin = 0);
// The sum of weight * depth * normal.
Vec3 net_load(const std::vector<ContactPoint> &points, std::size_t begin = 0);

// The greatest depth of the points, or of other corners of a contact, from `begin` on; 0 where there are none.
template <typename Corner>
double greatest_depth(const std::vector<Corner> &corners, std::size_t begin = 0) {
  double greatest = 0.0;
  for (std::size_t k = begin; k < corners.size(); ++k) greatest = corners[k].depth > greatest ? corners[k].depth : greatest;
  return greatest;
}

// Merges points until at most `capacity` (>= 1) are left, so that the sums of weight * depth (the load),
// weight * depth^2 (the energy stored at exponent 1) and weight * depth * position stay the same; normals are
// averaged by load. Of all pairs (of the 16 heaviest points), the one whose union changes the second moment of the load
// least goes first.
void merge_surplus(std::vector<ContactPoint> &points, std::size_t capacity);
inline void merge_points(std::vector<ContactPoint> &points, std::size_t capacity) {
  if (points.size() > capacity) merge_surplus(points, capacity);
}

}  // namespace cmb
