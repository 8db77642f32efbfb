// Where a plane cuts a convex polytope.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/polytope.hpp"

namespace cmb::convex {

// Appends the faces that the plane through `point` with the unit normal `across` (the polytope's frame) cuts, going once
// around the section; faces about a corner that is hardly beside the plane too, some of them more than once. Looks at the
// section's surroundings only, from the corner that is farthest along `start` on. False, with faces of no use, where the
// plane cuts no edge, or corners within rounding of it make the way around unclear.
bool append_section_faces(const Polytope &polytope, const Vec3 &point, const Vec3 &across, const Vec3 &start,
                          std::vector<std::int32_t> &faces);

}  // namespace cmb::convex
