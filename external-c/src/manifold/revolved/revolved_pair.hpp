// The surface of what two cylinders or cones have in common.
#pragma once

#include <vector>

#include "manifold/revolved/mantle_crossing.hpp"
#include "manifold/revolved/mantle_section.hpp"
#include "manifold/surface/overlap_surface.hpp"

namespace cmb {

// As RevolvedOnPolytope: its edges are chords where two ends meet, conics where an end meets a mantle, rims, and where the mantles cross.
// Room to work in; it grows in the first calls.
class RevolvedPair {
 public:
  // In A's frame; `deepest_a`, `deepest_b`: the places of A and B that are deepest in the other body. False where, by rounding, what meets does not
  // fit together.
  bool find(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &deepest_a, const Vec3 &deepest_b,
            OverlapSurface &surface);

 private:
  using End = Rim::End;
  static constexpr End base = Rim::base, top = Rim::top, ends = Rim::ends;

  // A body's ends in common axes.
  struct Side {
    RevolvedBody body;
    Pose pose;  // in common axes, from a place in the overlap
    Mantle mantle;
    PlaneFan fan[ends];
    Side(const RevolvedBody &of, const Pose &in_common, bool to_apex, bool is_fitted, std::vector<BorderPlace> &border,
         OverlapSurface::Nodes &nodes);
    double height(End end) const { return end == base ? -body.half : body.half; }
    Vec3 center(End end) const { return pose({0.0, 0.0, height(end)}); }
    Vec3 in_frame(const Vec3 &common) const { return transposed_times(pose.rotation, common - pose.translation); }
    bool has(End end) const { return end == base || body.is_cylinder(); }
    bool holds(const Vec3 &common) const { return body.holds(in_frame(common)); }
  };
  struct Borders {
    MantleSection section[ends];  // of this body's ends with the other's mantle
    Rim rim[ends];
    std::vector<BorderPlace> border;  // of this body's mantle
  };

  bool find_from(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &place, OverlapSurface &surface);
  // All of the surface, each mantle from its apex on or from its border's height.
  bool integrate(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &place, bool apex_a, bool apex_b,
                 OverlapSurface &surface);
  void add_chord(Side &a, Borders &borders_a, End end_a, Side &b, Borders &borders_b, End end_b) const;
  void add_rim_passages(Side &side, Borders &borders, End end, const Side &other, const Pose &in_other);
  static bool follow_ends(Side &side, Borders &borders, const Side &other);
  void follow_crossing(Side &a, Side &b, const Pose &b_in_a);

  Borders of_a_, of_b_;
  MantleCrossing::Cuts cuts_;
  std::vector<Vec3> corners_;  // where a rim passes the other body's mantle, in common axes
  EdgePlaces edge_;
  EdgePlaces *fitted_ = nullptr;
  OverlapSurface before_;  // what was found first, of two
};

}  // namespace cmb
