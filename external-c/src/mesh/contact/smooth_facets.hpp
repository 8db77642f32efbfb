// The part of a round body's surface below a plane, as plane pieces.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/core/mesh_data.hpp"
#include "shape/convex_body.hpp"

namespace cmb::mesh {

// Plane convex polygons; grows in the first calls.
struct Facets {
  struct Facet {
    std::size_t first = 0, count = 0;  // into corners
    Vec3 normal;                       // unit, outward
  };
  // Along a cylinder or cone, by its angle from the lowest one (rad).
  struct Line {
    double angle, cosine, sine;
  };
  std::vector<Vec3> corners;
  std::vector<Facet> facets;
  std::vector<Line> lines;  // room
};

// Fills `facets` with pieces that cover what an ellipsoid, a cylinder or a cone has below the plane
// normal . x = offset, all in the body's frame (some pieces may reach above the plane, those wholly above it are left out). Their corners lie on the body; the
// pieces are the finer the less of the body is below the plane, so that the error stays in proportion to the depth, and
// turn with the plane, not with the body: a body that rolls has no corners. Continuous in normal and offset.
//
// Returns the factor that makes the mean depth the depth a half-space would give where all of the body's weight is in
// one point (ellipsoids, 2 nearly); 1 for cylinders and cones, which rest on faces.
double facets_below(const convex::ConvexBody &body, const Vec3 &normal, double offset, Facets &facets);

}  // namespace cmb::mesh
