// What two convex polytopes have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "manifold/polytope/contact_side.hpp"
#include "math/symmetric_matrix.hpp"

namespace cmb {

// The surface of the overlap of polytopes A and B, and its first moments.
//
// All in the contact axes, whose z runs from B to A: across the overlap, which is thin that way. An overlap that is narrow as well, as that of
// an edge, turns them about z to run along it: beside the squares of its length those of its width would be lost to rounding.
// Results depend on these axes by rounding alone.
//
// Where a side of A passes through one of B that looks the same way, as in a stack of equal boxes, the surface goes over from the
// one to the other at once. Within some hundredths of a depth both are surface in part, which grows linearly with how far each is
// within the other body.
class OverlapSolid {
 public:
  struct Plane {
    Vec3 normal;
    double offset = 0.0;
    std::int32_t face = 0;  // of its body
    double below(const Vec3 &p) const { return offset - dot(normal, p); }
  };
  // A plane convex polygon of the surface.
  struct Piece {
    std::size_t first = 0, count = 0;  // of points(), counter-clockwise from outside
    Vec3 normal;                       // outward
    // Of the overlap's surface as it is; of the surface as a force acts on it.
    bool bounds = true, carries = true;
    const Plane *fades = nullptr;  // carries as far as share() says, or wholly where null
  };

  // False where they have nothing in common.
  bool find(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b, const Pose &b_in_axes);

  // Whether the axes were turned, and what maps the ones given to find() to those.
  bool is_turned() const { return is_turned_; }
  const convex::Mat3 &turn() const { return turn_; }

  // A's faces within B, B's within A. Of A's all carry; where fades() is true, some of B's carry in part.
  const std::vector<Piece> &pieces_a() const { return pieces_a_; }
  const std::vector<Piece> &pieces_b() const { return pieces_b_; }
  bool fades() const { return fades_; }
  double share(const Plane &plane, const Vec3 &p) const;

  const std::vector<Vec3> &points() const { return points_; }
  double volume() const { return volume_; }
  const Vec3 &middle() const { return middle_; }
  // The mean of the products of coordinates, from the middle.
  const convex::SymmetricMatrix &spread() const { return spread_; }

 private:
  // A vertex as the other body's planes see it: of few planes the set of those that it lies beyond, of many the one beyond which it is
  // farthest.
  struct Corner {
    Vec3 at;
    std::uint64_t beyond = 0;
    std::int32_t plane = -1;
    double below = 0.0;  // negative beyond
  };
  // A polytope's part that may bound the overlap.
  struct Body {
    ContactSide side;
    Pose in_axes;
    std::vector<Plane> planes;
    // Corners of the convex body that is left of it between both bodies' reaches; the first ones count.
    std::vector<Vec3> outline;
    std::size_t outline_count = 0;
    double sense = 1.0;         // of the side's z
    bool few_planes = true;     // few enough to look at all of them
    bool may_fade = true;       // one into the other body's
    std::int32_t last_plane = 0;
    // Vertices that were looked at, and for each vertex in which search and where.
    struct Mark {
      std::uint32_t search = 0;
      std::int32_t place = 0;
    };
    std::vector<Corner> corners;
    std::vector<Mark> marks;
    // Where the body has sets and the other one few planes: by vertex those planes that it lies beyond.
    bool is_seen = false;
    std::vector<std::uint64_t> beyond;

    const convex::Polytope &geometry() const { return side.body().geometry(); }
    Plane plane_of(std::int32_t face) const;
  };

  // Planes of A and B that look the same way, by their places among those.
  struct Alike {
    std::size_t a, b;
    bool flush;  // one plane
  };

  void look_at(Body &body, double limit);
  void see_vertices(Body &body, const Body &other) const;
  bool keep_cutting(Body &body, const Body &other) const;
  void cut_faces_of_a();
  void cut_faces_of_b();
  void find_alike();
  void look_at_vertex(const Body &body, std::int32_t vertex, Body &other, Corner &corner);
  void start_polygon(Body &body, const Plane &face, Body &other);
  void start_seen_polygon(const Body &body, const convex::Polytope::Face &face);
  void make_room();
  static void find_farthest_plane(const Body &body, const Vec3 &where, std::int32_t start, std::int32_t &plane, double &below);
  void leave_out(const Body &other, std::size_t plane);
  void start_search();
  void cut_by(const Body &other);
  void cut_by_few(const Body &other);
  void cut_by_many(const Body &other);
  std::size_t cut_corner(const Plane &plane, std::size_t corner);
  void cut(const Plane &plane);
  void cut_out(std::size_t first, std::size_t last, const Vec3 &enters, const Vec3 &leaves);
  void cut_ragged();
  void fade(const Plane &face, const Alike &alike);
  void append(std::vector<Piece> &pieces, const Vec3 &normal, bool bounds, bool carries, const Plane *fades);
  Vec3 find_apex() const;
  bool find_moments(const Vec3 &apex);
  bool turn_along_narrow();

  Body a_, b_;
  std::vector<std::int32_t> faces_;
  std::vector<Alike> alike_;
  // The polygon at hand: `count_` points from `first_` on. By corner: how far it is below the plane that cuts and, of many planes, the
  // farthest plane; negative where that is not known.
  std::size_t first_ = 0, count_ = 0;
  std::vector<double> below_cut_, below_;
  std::vector<std::int32_t> farthest_;
  std::vector<Vec3> whole_, ragged_;
  std::vector<double> ragged_below_;
  // Few planes: those beyond which any corner lies, or all do; those that shall not cut.
  std::uint64_t beyond_any_ = 0, beyond_all_ = 0, done_ = 0;
  std::vector<std::int32_t> done_faces_;  // of many planes those that need not cut any more
  std::uint32_t search_ = 0;
  std::vector<Piece> pieces_a_, pieces_b_;
  std::vector<Vec3> points_;
  double size_ = 0.0, tolerance_ = 0.0, fading_ = 0.0;
  bool fades_ = false, is_turned_ = false;
  convex::Mat3 turn_;
  Vec3 middle_;
  double volume_ = 0.0;
  convex::SymmetricMatrix spread_;
};

}  // namespace cmb
