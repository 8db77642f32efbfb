// Separating directions straight through a flat end: a face of a box, an end of a cylinder, the base of a cone.
#pragma once

#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/direction_refinement.hpp"

namespace cmb::convex {

// Of the directions that the cores' flat ends face, the one in which the support function is least, in closed form, with witness
// points in the middle of what touches there; false where none has a flat end. Whether there is a lesser minimum remains
// to be proven (interior_ball.hpp).
bool flat_face_direction(const MinkowskiDifference &difference, RefinedDirection &result);

}  // namespace cmb::convex
