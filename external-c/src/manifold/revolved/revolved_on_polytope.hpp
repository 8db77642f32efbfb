// The surface of what a cylinder or cone and a polytope have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "manifold/revolved/overlap_surface.hpp"
#include "manifold/revolved/revolved_body.hpp"
#include "shape/contact_polytope.hpp"

namespace cmb {

using convex::Pose;

// Its edges are parts of the polytope's edges, of the lines where the polytope's faces cut the ends, of the conics where these cut the
// mantle, and of the rims. Plane sides are integrated as fans of their edges, the mantle from a height on: so each edge is followed
// once, and added to both of its sides, in whatever order. Where an edge leaves the mantle or comes to it is decided once for all sides,
// too; between these passages conics and rims run counter-clockwise about their plane sides.
//
// Room to work in; it grows in the first calls.
class RevolvedOnPolytope {
 public:
  // A is the body of revolution, in whose frame all is; `place`: where the surface's places are from. False where, by rounding, what
  // meets does not fit together.
  bool find(const RevolvedBody &body, const ContactPolytope &polytope, const Pose &in_frame, const Vec3 &place,
            OverlapSurface &surface);

 private:
  enum End : std::size_t { base, top, ends };

  struct Vertex {
    Vec3 at;
    std::uint32_t beyond = 0;  // the sides of a prism about the body; the first two are the ends
    bool in_mantle = false;
  };
  // Of a line's part the part in the mantle.
  struct Stretch {
    bool any = false, comes_in = false, goes_out = false;  // through the mantle
    Vec3 from, to;
  };
  // Of an edge the part between the ends.
  struct EdgePart {
    Vec3 from, to;
    bool between = false, from_in_mantle = false, to_in_mantle = false;
    Stretch inside;
  };
  // Where a plane side's border goes over from a straight line to the conic or rim, or comes from there.
  struct Passage {
    double key;  // grows counter-clockwise about the side
    double angle, height;
    bool to_curve;
  };
  struct Plane {
    Vec3 normal;
    double offset;
    std::vector<OverlapSurface::Node> *nodes;
    Vec3 apex = {};  // of its fan: the first place of its border, so that all of the fan is in both bodies
    bool has_apex = false;
  };
  // Where a plane cuts the mantle. Angles about the axis count from where the plane's normal points.
  struct Conic {
    Vec3 along, across;               // unit, perpendicular to the axis
    double radial, axial, offset;     // of the plane: radial cos(angle) distance + axial height = offset
    double sense;                     // 1 where angles grow counter-clockwise about the plane
    double height;                    // at angle 0; between the ends
  };

  const EdgePart &part_of(std::int32_t edge);
  Stretch in_mantle(const Vec3 &p, bool p_inside, const Vec3 &q, bool q_inside) const;
  bool follow_face(std::int32_t index);
  void add_chord(const EdgePart &leaving, bool leaving_forward, const EdgePart &coming, bool coming_forward, End end,
                 Plane &plane, const Conic &conic);
  bool follow_conic(Plane &plane, const Conic &conic, std::int32_t index);
  bool follow_rim(End end);
  bool holds(const Vec3 &at) const;

  Conic conic_of(const Plane &plane) const;
  bool find_height(const Conic &conic, double cosine, double &height) const;
  Passage passage(const Conic &conic, const Vec3 &at, bool to_curve) const;
  bool next_passage(std::vector<Passage> &passages, const Passage &from, Passage &next, bool &round) const;

  void add_segment(const Vec3 &from, const Vec3 &to, Plane &plane) const;
  void add_arc(Plane &plane, const Conic &conic, double angle0, double height0, double angle1, double height1);
  void add_rim(Plane &plane, double height, double from, double turn);
  void add_curve_node(const Vec3 &outward, double height, const Vec3 &step, double turn, Plane &plane);

  double height_of(End end) const { return end == base ? -body_->half : body_->half; }

  const RevolvedBody *body_ = nullptr;
  const convex::Polytope *polytope_ = nullptr;
  OverlapSurface *surface_ = nullptr;
  Pose in_frame_;
  Vec3 place_;
  Plane end_[ends];
  std::vector<Vertex> vertices_;
  std::vector<EdgePart> edges_;
  std::vector<std::uint32_t> edge_search_;
  std::uint32_t search_ = 0;
  std::vector<std::int32_t> faces_;  // that may bound the overlap
  std::vector<Plane> planes_;        // in step
  std::vector<Passage> on_conic_, on_rim_[ends];
};

}  // namespace cmb
