// How far a convex body reaches along a direction before planes.
#pragma once

#include <vector>

#include "mesh/wedges/wedge_plane.hpp"
#include "shape/convex_body.hpp"

namespace cmb::mesh {

// A place on the body's surface before all planes, farther than `enough`: there is none, it is found, or it is where two or more planes
// meet.
enum class Deepest { none, found, on_edges };

// Sets `place` to that which is farthest along `direction`. All in the body's frame.
//
// By duality: on the plane m . x = o the greatest d . x is the least h(d + l m) - l o over l >= 0, h being the body's support function; the
// derivative by l says how far the supporting place is before the plane.
Deepest deepest_within(const convex::ConvexBody &body, const Vec3 &direction, const std::vector<WedgePlane> &planes, double enough,
                       Vec3 &place);

}  // namespace cmb::mesh
