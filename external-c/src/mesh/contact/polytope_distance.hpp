// Distance of a triangle and a convex polytope.
#pragma once

#include <vector>

#include "mesh/contact/nearest_triangle.hpp"
#include "shape/polytope.hpp"

namespace cmb::mesh {

// Distance of triangle abc and a polytope whose vertices, and unit outward face normals, are given in the triangle's
// frame; exact to rounding. `polygon` and `clipped` are room.
TriangleGap triangle_polytope_distance(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::Polytope &body,
                                       const std::vector<Vec3> &vertices, const std::vector<Vec3> &normals,
                                       std::vector<Vec3> &polygon, std::vector<Vec3> &clipped);

}  // namespace cmb::mesh
