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
#include "mesh/wedges/wedge_region.hpp"
#include "shape/convex_body.hpp"

namespace cmb::mesh {

// Room for one body; grows in the first calls.
struct RoundOverlapScratch {
  ConvexCell cell;
  RevolvedOnPolytope revolved;
  BallOnPolytope ball;
  OverlapSurface surface;
  std::vector<WedgePlane> planes;  // that cut the body, in its frame
  std::vector<WedgeIntegrals::Part> parts;
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
  void add(std::uint32_t t) {
    visit_regions(mesh(), t, [this](const WedgeRegion &region) { add(region); });
  }

 private:
  // What is asked by itself, with its axes along the body's.
  struct Piece {
    convex::ConvexBody body;  // an ellipsoid, a cylinder or a cone
    Pose place;               // in the mesh's frame
    double low = -HUGE_VAL, high = HUGE_VAL;  // heights between which it counts, where it goes on as another piece

    bool is_ellipsoid() const { return body.core == convex::CoreShape::ellipsoid; }
  };

  void add(const WedgeRegion &region);
  bool is_outside(const Piece &piece) const;
  bool set_cell(const Piece &piece);
  bool find_surface(const Piece &piece);
  double farthest_off(const Piece &piece) const;
  Vec3 place_on_edges(const Piece &piece, const Vec3 &otherwise) const;
  // Of what was found.
  template <typename Visit>
  void visit_edge_ends(const Piece &piece, Visit &&visit) const {
    if (piece.is_ellipsoid()) {
      scratch_.ball.visit_edge_ends(visit);
    } else {
      scratch_.revolved.visit_edge_ends(visit);
    }
  }
  // Over the overlap, of the depth and its cube.
  struct Means {
    double depth, cube;
  };
  double deepest_of_overlap(const Piece &piece, const Vec3 &local, double enough, Vec3 &deepest_place) const;
  Means means(const Piece &piece, double at_place, const Vec3 &local) const;
  void integrate(const Piece &piece);

  const Piece whole_;
  std::array<Piece, 3> pieces_;  // the first count_
  std::size_t count_ = 0;
  RoundOverlapScratch &scratch_;
  double deepest_below_ = 0.0;  // below the triangle at hand no place of the piece counts as deeper
};

}  // namespace cmb::mesh
