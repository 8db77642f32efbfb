// The surface of what a cylinder or cone and a polytope have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "manifold/revolved/mantle_section.hpp"
#include "shape/face_clusters.hpp"
#include "shape/polytope_view.hpp"

namespace cmb {

// Its edges are parts of the polytope's edges, of the lines where the polytope's faces cut the ends, of the conics where these cut the
// mantle, and of the rims. Plane sides are integrated as fans of their edges, the mantle from a height on: so each edge is followed
// once, and added to both of its sides, in whatever order. Where an edge leaves the mantle or comes to it is decided once for all sides,
// too; between these passages conics and rims run counter-clockwise about their plane sides.
//
// Room to work in; it grows in the first calls.
class RevolvedOnPolytope {
 public:
  // A is the body of revolution, in whose frame all is; `place`: where the surface's places are from; `partner`: what the polytope is;
  // `from_apex`: whether a cone's mantle is integrated from there in any case. False where, by rounding, what meets does not fit together.
  bool find(const RevolvedBody &body, const convex::PolytopeView &polytope, const Pose &in_frame, const Vec3 &place,
            OverlapSurface &surface, Mantle::Partner partner = Mantle::Partner::polytope, bool from_apex = false);

  // Of what was found: where parts of the polytope's edges in the body begin and end, in its frame.
  template <typename Visit>
  void visit_edge_ends(Visit &&visit) const {
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      const Stretch &inside = edges_[k].inside;
      if (edge_search_[k] == search_ && inside.any) visit(inside.from), visit(inside.to);
    }
  }

 private:
  using End = Rim::End;
  static constexpr End base = Rim::base, top = Rim::top, ends = Rim::ends;

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
  struct Plane {
    double offset;
    PlaneFan fan;
  };

  // Fills faces_, planes_ and beyond_any_.
  void find_faces(const Pose &in_frame, const Vec3 &place, OverlapSurface &surface);
  void find_faces_by_groups(const FaceClusters &clusters, const Pose &in_frame);
  // Keeps a face unless it is beyond the body.
  void offer_face(std::int32_t face, const Pose &in_frame);
  const Vertex &place_vertex(std::int32_t vertex, const Pose &in_frame);
  // All of the surface, the mantle from the apex on, or from its border's height or from there, too, as is better.
  bool integrate(const Pose &in_frame, const Vec3 &place, bool to_apex, OverlapSurface &surface);
  const EdgePart &part_of(std::int32_t edge);
  Stretch in_mantle(const Vec3 &p, bool p_inside, const Vec3 &q, bool q_inside) const;
  bool follow_face(std::int32_t index, Mantle &mantle, PlaneFan *end_fan);
  void add_chord(const EdgePart &leaving, bool leaving_forward, const EdgePart &coming, bool coming_forward, End end,
                 PlaneFan &face_fan, PlaneFan &end_fan);
  bool is_in_face(std::int32_t index, const Vec3 &at) const;
  bool holds(const Vec3 &at, const Pose &in_frame) const;
  // Whether a place is in the polytope, or as near to all of its planes.
  bool has_near(const Vec3 &at, double margin, const Pose &in_frame) const;

  // Faces whose planes a place (in the polytope's frame) may be no farther below than `depth`, or all; as FaceClusters::visit_near.
  template <typename Visit>
  bool visit_near(const Vec3 &place, double depth, Visit &&visit) const {
    if (polytope_->clusters != nullptr) return polytope_->clusters->visit_near(place, depth, visit);
    for (std::size_t f = 0; f < polytope_->faces.size(); ++f) {
      if (!visit(static_cast<std::int32_t>(f))) return false;
    }
    return true;
  }

  // Of `beyond`.
  static constexpr std::uint32_t bit_of(End end) { return end == base ? 1u : 2u; }
  bool is_apex(End end) const { return end == top && !body_->is_cylinder(); }
  double height_of(End end) const { return end == base ? -body_->half : body_->half; }

  const RevolvedBody *body_ = nullptr;
  Mantle::Partner partner_ = Mantle::Partner::polytope;
  const convex::PolytopeView *polytope_ = nullptr;  // during find()
  // Of each vertex and edge that was met in this search.
  std::vector<Vertex> vertices_;
  std::vector<EdgePart> edges_;
  std::vector<std::uint32_t> vertex_search_, edge_search_;
  std::uint32_t search_ = 0, beyond_any_ = 0;  // the latter of all vertices, of the ends
  std::vector<std::uint64_t> groups_;          // of faces: how they lie to the body
  std::vector<std::int32_t> faces_;  // that may bound the overlap
  std::vector<Plane> planes_;        // in step
  MantleSection section_;
  std::vector<BorderPlace> border_;
  Rim rim_[ends];
};

}  // namespace cmb
