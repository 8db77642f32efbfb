// Polytopes inscribed in cylinders and cones.
#pragma once

#include <memory>

#include "shape/contact_polytope.hpp"
#include "shape/convex_body.hpp"

namespace cmb {

// The prism in a cylinder, the pyramid in a cone, with rim_corners corners on each rim. It stands for the body where its
// flat end touches. `body` is a cylinder or cone without rounding. Throws std::bad_alloc.
std::shared_ptr<const ContactPolytope> make_rim_polytope(const convex::ConvexBody &body);

// Regular: a disc that rests wholly on its rim's corners has the second moments of one that rests on its rim.
constexpr int rim_corners = 16;

// How far inside the polygon, which stands for a disc of `radius` (m), the place x, y from the disc's middle lies (m); negative
// outside. Axes of the body's frame.
double inside_rim_polygon(double radius, double x, double y);

}  // namespace cmb
