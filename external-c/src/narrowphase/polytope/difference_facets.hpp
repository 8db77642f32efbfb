// The facets of the difference C = A - B of two polytopes, found one from the other.
//
// Each facet of C is a face of one body at a vertex of the other, or is spanned by one edge of each. Across a side of a
// facet lies the one that is met next on the arc of directions of the side's edge: at the arc's end, a face, or where the
// arc leaves the directions of the other body's vertex, across another edge.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

// Works in storage allocated by the constructor alone. Not for sharing between threads.
class DifferenceFacets {
 public:
  // More than this are not kept.
  static constexpr std::int32_t most_corners = 4000;

  // A corner of a facet and the side that begins there: an edge of one body at the corner's vertex of the other.
  struct Corner {
    Vec3 at;
    std::int32_t vertex[2];
    std::int32_t body, edge;
    bool forward;  // as the edge runs
  };
  struct Facet {
    Vec3 normal;
    double height;              // normal . p for points p of the facet
    std::int32_t first, count;  // corners, counter-clockwise from outside
  };

  DifferenceFacets();

  // Of bodies that are polytopes or boxes, which are borrowed. No corners are kept.
  void place(const MinkowskiDifference &difference);
  // Facets found so far, and their corners, are no longer valid.
  void forget() { corner_count_ = 0; }

  // The number of edges of the body that has more.
  std::size_t most_edges() const {
    return std::max(body_[0].polytope->edges().size(), body_[1].polytope->edges().size());
  }

  // A facet at the vertex of C that is farthest along `first`, in the direction in which the support function falls. False
  // where there is none, or the bodies are apart along `first`, which `apart` tells then.
  bool start(const Vec3 &first, const DifferencePoint &farthest, Facet &facet, Vec3 &apart);
  // The facet across side q, which ends at `q_end`: the one that is met first on the arc of its edge's directions from
  // `from`, one of the other body's vertex, to that of the edge's face beyond. The facet's first side is q turned back.
  // False where edges are parallel or there are too many corners.
  bool cross_side(const Corner &q, const Vec3 &q_end, const Vec3 &from, Facet &facet);

  const Corner &corner(std::int32_t k) const { return corners_[static_cast<std::size_t>(k)]; }
  const Corner *corners_of(const Facet &facet) const { return &corner(facet.first); }
  // Where the side that begins at a facet's k-th corner ends.
  const Vec3 &end_of(const Facet &facet, std::int32_t k) const {
    return corner(facet.first + next_in_turn(k, facet.count)).at;
  }
  // What follows number k of `count` in turn, without a branch.
  static std::int32_t next_in_turn(std::int32_t k, std::int32_t count) {
    return (k + 1) & -static_cast<std::int32_t>(k + 1 != count);
  }

  // Whether no edge leads by more than `slack` above a facet's plane from its vertices: then no vertex of C is above it, for C
  // is convex.
  bool is_outermost(const Facet &facet, double slack) const;

  // Points of A and of B, in A's frame, whose difference is the origin's foot on the facet that holds it.
  void find_witness(const Facet &facet, Vec3 &a, Vec3 &b) const;

 private:
  // A or -B, in A's frame.
  struct Body {
    const Polytope *polytope;
    Vec3 scale;  // of the polytope's coordinates
    Mat3 rotation;
    Vec3 shift;
    bool mirrored;

    Vec3 vertex(std::int32_t v) const;
    Vec3 way(std::int32_t from, std::int32_t to) const;
    Vec3 turned(const Vec3 &way) const;  // of the polytope
    Vec3 normal(std::int32_t face) const;
    // The same products with ways between the polytope's vertices as d with those of the body.
    Vec3 local(const Vec3 &d) const;
  };

  bool facet_of_face(const Corner &q, const Vec3 &q_end, std::int32_t face, Facet &facet);
  bool facet_of_edges(const Corner &q, const Vec3 &q_end, std::int32_t q_end_vertex, std::size_t slot, Facet &facet);

  // Room for `count` more corners, whatever they hold; null where there would be too many.
  Corner *add_corners(std::int32_t count);

  Body body_[2];
  std::vector<Corner> corners_;  // the first `corner_count_` count
  std::int32_t corner_count_ = 0;
};

}  // namespace cmb::convex
