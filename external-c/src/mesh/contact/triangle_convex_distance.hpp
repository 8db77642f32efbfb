// Distance of a triangle and a convex body that are apart.
#pragma once

#include "mesh/contact/nearest_triangle.hpp"
#include "shape/convex_body.hpp"

namespace cmb::mesh {

// Of the body's core, by the Gilbert-Johnson-Keerthi algorithm, to rounding where that has corners only, else to 1e-10 of the body's
// size, unless rounding ends the search before (1.5e-7 of the size in the worst of 30 000 random cases); or a value greater than
// `enough` where the distance is (its points are then of no use). Where the two meet the points are some that are near each other.
// `body_in_mesh` is the body's pose in the triangle's frame.
TriangleGap triangle_convex_gap(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::ConvexBody &body,
                                const Pose &body_in_mesh, double enough);

// The same of a polytope, to rounding where `proven`; where not, rounding ended the search, or the two meet. `parting`
// receives, where such a value is returned, a unit direction from the triangle to the body along which the two are farther
// apart than `enough`; else it stays as it is.
TriangleGap triangle_polytope_gap(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::Polytope &body,
                                  const Pose &body_in_mesh, double enough, bool &proven, Vec3 &parting);

// Whether a plane is found that parts the convex hull of six corners from the body, in the same frames: always one that does,
// though none may be found where they are hardly apart.
bool are_parted(const Vec3 (&corner)[6], const convex::ConvexBody &body, const Pose &body_in_mesh);

}  // namespace cmb::mesh
