// How two triangles pass through each other.
#pragma once

#include "mesh/core/mesh_data.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

// The segment that two triangles have in common: its length as depth, 0 where there is none or they lie in one plane, and its
// middle. `normal_a`, `normal_b`: unit. Corners nearer to the other triangle's plane than `in_plane` (m) lie in it: where an edge
// does, both triangles at it have it in common with the other one, and rounding cannot give it to neither.
TriangleSection common_segment(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b,
                               double in_plane);

// Depth: the least translation that parts them, 0 where they do not cross or where that is at most `enough` (the place is of
// no use then); exact, by the separating axes of two triangles. Place: the middle of the segment they have in common. Both are
// continuous in the corners. `normal_a`, `normal_b`: unit.
TriangleSection triangle_crossing(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b,
                                  double enough = 0.0);

// Whether they meet, or as good as do: false where an axis parts them by more than `rounding` (m).
bool may_meet(const Vec3 (&a)[3], const Vec3 &normal_a, const Vec3 (&b)[3], const Vec3 &normal_b, double rounding);

}  // namespace cmb::mesh
