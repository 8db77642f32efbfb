// Contact of a shape with a half-space, in closed form.
#pragma once

#include "manifold/contact_set.hpp"
#include "shape/shape.hpp"

namespace cmb {

// The surface of a half-space: points x of the solid satisfy normal . x <= offset.
struct Plane {
  Vec3 normal;  // unit, outward
  double offset = 0.0;
};

// The plane in which a half-space at `pose` ends.
inline Plane world_plane(const Pose &pose) {
  const Vec3 normal = pose.rotation.column(2);
  return {normal, dot(normal, pose.translation)};
}

// Appends the contact of `shape` (not a half-space), placed by `pose`, with the half-space: normals point out
// of the half-space. distance, normal and witness of `result` are set.
//
// Polytopes touch with their vertices: depth is the vertex' own, weight its share. Where a vertex' share depends
// on the direction of the load, the points are shifted along the surface by a fraction of the depth, so that the
// contact stays the gradient of the energy  sum of weight * depth^2 / 2.
void halfspace_contact(const Shape &shape, const Pose &pose, const Plane &plane, ContactSet &result);

}  // namespace cmb
