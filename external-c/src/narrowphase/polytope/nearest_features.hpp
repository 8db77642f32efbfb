// Which features of a polytope are nearest to the points of a straight line, one after the other.
//
// Outside of the polytope the points nearest to one feature are a convex region between planes through its borders (Mirtich, V-Clip,
// ACM Transactions on Graphics 17, 1998); inside those nearest to one face are. A line goes through each region once. A plane
// between two regions is given by one expression, whichever of them asks, so that a line does not turn back by rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "narrowphase/convex_distance.hpp"
#include "shape/polytope.hpp"

namespace cmb::convex {

// Room that lines work in; one for each thread.
struct FacesAlongLine {
  std::vector<double> heights, rates;  // of the place above each face, and its growth along the line
  struct Face {
    double height, rate;
    std::int32_t face;
  };
  std::vector<Face> ahead;
};

class NearestFeatures {
 public:
  // Of the line through `place` along the unit vector `line`, in the polytope's frame. Finds the feature nearest to the place, from
  // one that is near on; where that is smooth, from the highest face on. A place inside the polytope needs that. Polytope and
  // room outlive it.
  NearestFeatures(const Polytope &polytope, const Vec3 &place, const Vec3 &line, const Feature &near, FacesAlongLine &room);

  // Whether one was found; else nothing below holds.
  bool found() const { return found_; }

  // Starts from the place along the line (sense 1) or against it (-1), to the points place + t * sense * line, 0 <= t <= length.
  void start(double sense, double length);
  // Goes on to the next region.
  void next();
  const Feature &feature() const { return feature_; }
  // Where the line leaves the feature's region; infinite where it does not. The same feature may be nearest beyond.
  double end() const { return end_; }

 private:
  bool improve();
  void look_ahead();
  void look_ahead_inside(double height, double rate);
  void find_faces_ahead(double height, double rate);
  // A plane of the region, beyond which the feature `to` is nearer: the place's height above it and its growth along the way.
  void bound(double height, double rate, FeatureKind kind, std::int32_t to);
  void look_at_faces();
  std::int32_t highest_face();

  const Polytope &polytope_;
  const Vec3 place_, line_;
  Vec3 way_;
  Feature nearest_, feature_, next_;
  double sense_ = 1.0, length_ = 0.0, at_ = 0.0, end_ = 0.0;
  bool found_ = false, inside_ = false, start_inside_ = false, next_inside_ = false, ahead_known_ = false,
       faces_known_ = false;
  FacesAlongLine &room_;  // `ahead`: what may be the nearest face further on inside
};

}  // namespace cmb::convex
