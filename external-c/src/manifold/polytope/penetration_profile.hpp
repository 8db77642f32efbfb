// The corners of two polytopes' depth in each other over the contact plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "manifold/polytope/contact_side.hpp"
#include "manifold/polytope/vertex_stiffness.hpp"

namespace cmb {

// How far B's upper side lies above A's lower side, measured along the contact normal, is a concave function over the
// contact plane. Its graph's corners are vertices of one body over the other's faces, and crossings of edges. A corner's
// weight is the part of the hemisphere of directions in which it is the graph's farthest point (its normal cone), scaled
// so that a vertex of one body inside a face of the other carries its share in that face. This measure of a convex body
// changes continuously with the body (Schneider, Convex Bodies, section 4.2), so corners may appear, merge and vanish
// without a jump. Where edges cross, the scale is that of the edges, and near an end that of the vertex.
//
// Holds room; one for each thread.
class PenetrationProfile {
 public:
  struct Corner {
    Vec3 middle;  // half way between the surfaces, in the contact's axes
    double depth, weight;
    Vec3 slope;  // of the weight by the direction towards the other body, in the contact's axes (x and y)
  };

  // Places both bodies, whose poses in the contact's axes are given: z along the contact normal, from B to A.
  void place(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b, const Pose &b_in_axes);

  // How deep the bodies are in each other along the contact normal; no corner is deeper.
  double reach() const { return side_a_.reach() + side_b_.reach(); }

  // Finds the corners deeper than `level` (>= 0).
  void find_corners(double level);
  const std::vector<Corner> &corners() const { return corners_; }

 private:
  // What decides whether edges cross: an edge as it is seen along the contact normal.
  struct Line {
    Extent extent;
    double from_x, from_y, to_x, to_y;
    double highest;     // z, of the true edge
    std::int32_t edge;  // of the side

    // Whether the other edge's ends lie on different sides of this line.
    bool parts(const Line &other) const {
      return (area(other.from_x, other.from_y) > 0.0) != (area(other.to_x, other.to_y) > 0.0);
    }
    double area(double x, double y) const { return (to_x - from_x) * (y - from_y) - (to_y - from_y) * (x - from_x); }
  };
  // An edge with the directions of its faces within the hemisphere; not visible where none of them looks towards the other
  // body.
  struct Ridge {
    DirectionArc directions;
    Stiffness stiffness;  // of its points, far from its ends
    bool known = false, visible = false;
  };
  // A side's edges within a region: the first `count` ones; and the same from the left to the right.
  struct Lines {
    std::vector<Line> found, ordered;
    std::size_t count = 0;
    std::vector<Ridge> ridges;  // by the side's edge; made where asked for
    std::vector<std::pair<double, std::int32_t>> order;
    std::vector<std::int32_t> within;
    // The lines' extents reach `beyond` those of the edges.
    void gather(const ContactSide &side, const Extent &region, double beyond);
    // Of an edge found; null where it is not visible. `turning` as for the vertices.
    const Ridge *ridge(const ContactSide &side, std::int32_t edge, double turning);
    void sort();
  };

  void add_vertices(const ContactSide &side, VertexStiffness &stiffness, ContactSide &other_side, double sense);
  void add_corner(double x, double y, double z, double depth, double part, const Stiffness &scale);
  void add_crossings();
  template <bool own_is_of_a>
  std::size_t compare(const Line *own, const Line *first, const Line *last, std::size_t count);
  std::size_t compare_all();
  std::size_t sweep();
  // The crossing of two edges: its place and depth, and the parts of the edges' lengths at which it lies.
  struct Crossing {
    std::int32_t edge_a, edge_b;
    double t, s, x, y, z, depth;
  };
  bool find_crossing(std::int32_t edge_a, std::int32_t edge_b, Crossing &crossing) const;
  void add_crossing(const Crossing &crossing);

  double size_ = 0.0, level_ = 0.0, turning_a_ = 0.5;
  ContactSide side_a_, side_b_;
  Extent region_;
  Lines lines_a_, lines_b_;
  // Lines that may cross: as many as were found last.
  struct LinePair {
    const Line *a, *b;
  };
  std::vector<LinePair> near_;
  std::vector<Crossing> crossings_;
  VertexStiffness stiffness_a_, stiffness_b_;
  DirectionCone cone_;
  std::vector<Corner> corners_;
};

}  // namespace cmb
