// The shortest way out of two polytopes that overlap, by a walk over the facets of their difference C = A - B.
//
// Each facet of C is a face of one body at a vertex of the other, or is spanned by one edge of each. Across a side of a
// facet lies the one that is met next on the arc of directions of the side's edge: at the arc's end, a face, or where the
// arc leaves the directions of the other body's vertex, across another edge. Beyond a side that the origin's foot is
// beyond, the facet is nearer to the origin; so the walk comes down to a facet that holds the origin's foot. From there
// facets are added until the cone from a point of C on the far side to the rim of those found has no side within the ball
// asked for. Then these facets and the cone are a closed surface of points of C round the ball: no other facet meets it,
// and the least of the heights found is the depth. Where that takes many facets, the cone is bent outwards over a girdle of
// six more points of C.
#pragma once

#include <cstdint>
#include <vector>

#include "minkowski_difference.hpp"

namespace cmb::convex {

// Works in storage allocated by the constructor alone. Not for sharing between threads.
class SurfaceWalk {
 public:
  enum class Outcome {
    found,
    apart,     // along `direction` the bodies do not overlap
    undecided  // parallel edges or faces, or too many facets: ask another method
  };
  struct Result {
    double depth = 0.0;  // the support function along `direction`
    Vec3 direction;      // unit, from A to B
    Vec3 a, b;           // witness points, in A's frame
    Vec3 mean_outward;   // where asked for (nearby_surface.hpp), not unit
  };

  SurfaceWalk();

  // Of bodies that are polytopes or boxes (has_facets). `first` is any direction, best a guess of that from A to B. Where
  // the bodies' `size` is given (> 0), `mean_outward` is found. A result that is `found` is proven.
  Outcome way_out(const MinkowskiDifference &difference, const Vec3 &first, double size, Result &result);

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
    Vec3 normal(std::int32_t face) const;
    // The same products with ways between the polytope's vertices as d with those of the body.
    Vec3 local(const Vec3 &d) const;
  };
  // A corner of a facet and the side that begins there: an edge of one body at the corner's vertex of the other.
  struct Corner {
    Vec3 at;
    std::int32_t vertex[2];
    std::int32_t body, edge;
    bool forward;  // as the edge runs
  };
  struct Facet {
    Vec3 normal;
    double height;
    std::int32_t first, count;  // corners, counter-clockwise from outside
  };
  struct Side {
    std::int32_t facet, corner;
    bool inner;  // both of its facets were met
  };
  struct Mark {
    std::uint64_t key;
    std::uint32_t growth;
    std::int32_t side;
  };

  // What closes the surface of the facets found, all of points of C.
  class Closure {
   public:
    static constexpr int girdle_points = 6;

    Closure(const MinkowskiDifference &difference, const Facet &lowest, double radius);
    bool put_girdle();
    void leave_girdle() { with_girdle_ = false; }
    bool with_girdle() const { return with_girdle_; }
    // Whether its part at a side from p to q is outside the ball.
    bool holds(const Vec3 &p, const Vec3 &q) const;
    void count_steps(const Vec3 &p, const Vec3 &q, int steps[girdle_points]) const;

   private:
    bool is_beyond(const Vec3 &p, const Vec3 &q, const Vec3 &r) const;
    int sector(const Vec3 &p) const;

    const MinkowskiDifference &difference_;
    double radius2_;
    Vec3 normal_, far_, across_[2], girdle_[girdle_points];
    bool with_girdle_ = false;
  };

  bool start(const Vec3 &first, Facet &facet, Vec3 &apart);
  bool descend(Facet &facet);
  Outcome grow(const MinkowskiDifference &difference, double size, Facet &lowest);
  bool cross_side(const Corner &q, const Vec3 &q_end, const Vec3 &from, Facet &facet);
  bool facet_of_face(const Corner &q, const Vec3 &q_end, std::int32_t face, Facet &facet);
  bool facet_of_edges(const Corner &q, const Vec3 &q_end, std::int32_t q_end_vertex, std::int32_t other_edge,
                      std::int32_t far_vertex, Facet &facet);
  bool add_sides(const Facet &facet, std::int32_t number, std::int32_t k);
  bool is_closed(const Closure &closure) const;
  const Vec3 &end_of(const Side &side) const;
  void find_witness(const Facet &facet, Result &result) const;
  void find_mean(const Facet &lowest, double radius, Result &result) const;

  const Corner *corners_of(const Facet &facet) const { return corners_.data() + facet.first; }

  Body body_[2];
  std::vector<Corner> corners_;
  std::vector<Facet> facets_;
  std::vector<Side> sides_;
  std::vector<Mark> marks_;  // sides by what they are: a hash table, of which what the present growth wrote counts
  std::uint32_t growth_ = 0;
};

}  // namespace cmb::convex
