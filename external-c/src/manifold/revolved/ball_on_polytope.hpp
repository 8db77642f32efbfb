// The surface of what an ellipsoid and a polytope have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "manifold/revolved/passages.hpp"
#include "manifold/surface/overlap_surface.hpp"
#include "manifold/surface/plane_fan.hpp"
#include "shape/polytope_view.hpp"

namespace cmb {

using convex::Pose;

// As a ball's, in axes that are as long as the ellipsoid's semi-axes. Its edges are parts of the polytope's edges and arcs of the
// circles where its faces cut the ball. Faces are fans of their edges. The ball's part is a fan of its arcs, too, of great circles from
// one place of the ball on, which cover it once but where the antipode is inside: then all of the ball is added. A narrow band along a circle, as
// where planes that hardly differ cut a needle across, great circles would leave by many times its width: it is covered by meridians about
// the circle's axis.
//
// Room to work in; it grows in the first calls.
class BallOnPolytope {
 public:
  // A is the ellipsoid of these semi-axes, in whose frame all is; `place`: where the surface's places are from. False where, by rounding,
  // what meets does not fit together, or they have nothing in common.
  bool find(const Vec3 &semi_axes, const convex::PolytopeView &polytope, const Pose &in_frame, const Vec3 &place,
            OverlapSurface &surface);

  // Of what was found: where parts of the polytope's edges in the ellipsoid begin and end, in its frame.
  template <typename Visit>
  void visit_edge_ends(Visit &&visit) const {
    for (const Stretch &stretch : stretches_) {
      if (!stretch.any) continue;
      for (const Vec3 *const at : {&stretch.from, &stretch.to}) {
        visit(Vec3{semi_axes_.x * at->x, semi_axes_.y * at->y, semi_axes_.z * at->z});
      }
    }
  }

 private:
  struct Vertex {
    Vec3 at;
    bool inside = false;
  };
  // Of an edge the part in the ball.
  struct Stretch {
    bool any = false, comes_in = false, goes_out = false;
    Vec3 from, to;
  };
  struct Plane {
    Vec3 normal;
    double offset;
  };
  // A part of the circle in which a plane cuts the ball: counter-clockwise about the plane's normal, so clockwise about the ball's part.
  struct Arc {
    Vec3 center, along, across;  // along, across: as long as the radius
    double from, turn;
    const Plane *plane;
    // Places at even angles from the first to the last, which tell where it runs.
    static constexpr int parts = 4;
    Vec3 sample[parts + 1] = {};
  };
  // Along which the ball's part lies.
  struct Band {
    const Plane *plane = nullptr;
    double radius = 0.0;  // of its circle
  };

  Stretch stretch_of(const Vertex &p, const Vertex &q) const;
  bool follow_face(std::size_t index, PlaneFan &fan);
  void add_arc(Arc arc, PlaneFan &fan);
  bool holds(const Vec3 &at) const;
  void add_ball_part(const Vec3 &place, OverlapSurface::Nodes &nodes) const;
  bool find_band(Band &band) const;
  void add_band(const Band &band, const Vec3 &place, OverlapSurface::Nodes &nodes) const;

  Vec3 semi_axes_;
  const convex::PolytopeView *polytope_ = nullptr;  // during find()
  std::vector<Vertex> vertices_;
  std::vector<Stretch> stretches_;  // of the edges
  std::vector<Plane> planes_;       // of the faces
  std::vector<Arc> arcs_;
  Passages passages_;
};

}  // namespace cmb
