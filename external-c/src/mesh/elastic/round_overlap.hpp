// What of an ellipsoid, a cylinder or a cone lies behind the triangles of a mesh, as an elastic solid.
#pragma once

#include <cstdint>
#include <vector>

#include "manifold/revolved/ball_on_polytope.hpp"
#include "manifold/revolved/revolved_on_polytope.hpp"
#include "math/pose_algebra.hpp"
#include "mesh/elastic/convex_cell.hpp"
#include "mesh/elastic/wedge_integrals.hpp"
#include "mesh/elastic/wedge_planes.hpp"
#include "shape/convex_body.hpp"

namespace cmb::mesh {

// Room for one body; grows in the first calls.
struct RoundOverlapScratch {
  ConvexCell cell;
  RevolvedOnPolytope revolved;
  BallOnPolytope ball;
  OverlapSurface surface;
  std::vector<WedgePlane> planes;  // that cut the body, in its frame
};

// A wedge is cut out of a cube about the body, and the surface of what both have in common is exact, as for convex bodies
// (manifold/revolved/). An ellipsoid on a plane stores d^2/2, as on a half-space.
//
// Borrows all it is given.
class RoundOverlap : public WedgeIntegrals {
 public:
  // `place`: the body's pose in the mesh's frame.
  RoundOverlap(const convex::ConvexBody &body, const Pose &place, const TriangleMesh &mesh, RoundOverlapScratch &scratch);

  // What lies behind triangle t.
  void add(std::uint32_t t);

 private:
  bool set_cell();
  bool is_beyond(const WedgeSide &side, double offset_of_front) const;
  bool find_surface();
  double deepest_of_overlap(const Vec3 &local, double enough, Vec3 &deepest_place) const;
  double mean_square(double at_middle, const Vec3 &local) const;
  void integrate();
  // How far the body reaches along a direction of the mesh's frame.
  double reach(const Vec3 &direction) const;

  const convex::ConvexBody &body_;
  const Pose &place_;
  const Pose to_body_;
  const RevolvedBody revolved_;  // of cylinders and cones
  RoundOverlapScratch &scratch_;
  double volume_ = 0.0, area_ = 0.0;  // of all overlaps, of the body's surface there as seen along it
  double deepest_below_ = 0.0;  // below the triangle at hand no place counts as deeper
};

}  // namespace cmb::mesh
