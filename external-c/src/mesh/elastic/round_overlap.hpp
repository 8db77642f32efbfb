// What of a round body lies behind the triangles of a mesh, as an elastic solid.
#pragma once

#include <array>
#include <cmath>
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
// (manifold/revolved/). Of a capsule it is that of a cylinder and two half balls, each cut out of a cube of its own. On a plane an ellipsoid
// stores d^2/2, as on a half-space, and a capsule that lies.
//
// Borrows all it is given.
class RoundOverlap : public WedgeIntegrals {
 public:
  // `body`: an ellipsoid, a cylinder, a cone or a capsule. `place`: its pose in the mesh's frame.
  RoundOverlap(const convex::ConvexBody &body, const Pose &place, const TriangleMesh &mesh, RoundOverlapScratch &scratch);

  // What lies behind triangle t.
  void add(std::uint32_t t);

 private:
  // What is asked by itself, with its axes along the body's.
  struct Part {
    convex::ConvexBody body;  // an ellipsoid, a cylinder or a cone
    Vec3 center;              // in the mesh's frame
    double low = -HUGE_VAL, high = HUGE_VAL;  // heights between which it counts, where it goes on as another part

    bool is_ellipsoid() const { return body.core == convex::CoreShape::ellipsoid; }
  };

  void set_parts();
  bool is_outside(const convex::ConvexBody &body, const Vec3 &center) const;
  bool set_cell(const Part &part);
  bool find_surface(const Part &part);
  double deepest_of_overlap(const Part &part, const Vec3 &local, double enough, Vec3 &deepest_place) const;
  double mean_square(const Part &part, double at_middle, const Vec3 &local) const;
  void integrate(const Part &part);
  // How far a body about `center` reaches along a direction, in the mesh's frame.
  double reach(const convex::ConvexBody &body, const Vec3 &center, const Vec3 &direction) const;
  double reach(const Part &part, const Vec3 &direction) const { return reach(part.body, part.center, direction); }
  Vec3 to_mesh(const Part &part, const Vec3 &at) const { return part.center + rotation_ * at; }

  const convex::ConvexBody &body_;
  const Vec3 center_;    // in the mesh's frame
  const Mat3 rotation_;  // there
  std::array<Part, 3> parts_;  // the first count_
  std::size_t count_ = 0;
  RoundOverlapScratch &scratch_;
  double volume_ = 0.0, area_ = 0.0;  // of all overlaps, of the body's surface there as seen along it
  // Of the triangle at hand; in the second case, of the part:
  double offset_of_front_ = 0.0;
  double deepest_below_ = 0.0;  // no place counts as deeper
};

}  // namespace cmb::mesh
