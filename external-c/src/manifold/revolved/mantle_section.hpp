// Where a plane, or an end of its own, meets the mantle of a cylinder or cone.
#pragma once

#include <cstddef>

#include "manifold/revolved/mantle.hpp"
#include "manifold/revolved/passages.hpp"
#include "manifold/surface/plane_fan.hpp"

namespace cmb {

// A conic, which borders on both. Angles about the axis count from where the plane's normal points.
class MantleSection {
 public:
  // `normal` (unit, outward), `offset`: of the plane, in the mantle's frame.
  // `fitted`: room for places of edges, where they are to be fitted to both sides.
  void start(Mantle &mantle, const Vec3 &normal, double offset, EdgePlaces *fitted = nullptr);
  // A place (in the mantle's frame, and as a corner) where the plane side's border goes over to the conic, or comes from there.
  void add_passage(const Vec3 &at, bool to_curve, const Vec3 &corner = {});

  // Adds the conic's arcs between the passages to both. Where there are no passages all of it borders, or nothing: `holds` tells of a
  // place in the mantle's frame whether it is in the plane side. False where passages do not fit together.
  template <typename Holds>
  bool follow(PlaneFan &fan, Holds &&holds) {
    if (!passages_.empty()) return follow_arcs(fan);
    Vec3 at;
    if (find_loop(at) && holds(at)) follow_loop(fan);
    return true;
  }

 private:
  bool follow_arcs(PlaneFan &fan);
  // Whether it is closed, between the ends; a place of it.
  bool find_loop(Vec3 &at) const;
  void follow_loop(PlaneFan &fan);
  void add_loop(PlaneFan &fan);
  bool find_height(double cosine, double &height) const;
  void add_place(PlaneFan &fan, double cosine, double sine, double height, double turn, double rise);
  // Of a cylinder's conic that is inclined enough for its heights to follow from angles.
  void add_swing(PlaneFan &fan, double from, double turn);
  // Where a cone's conic runs as good as straight to the apex, or from there, and turns in it.
  void add_way_by_apex(PlaneFan &fan, double angle0, double height0, double angle1, double height1);
  // A part where the angle keeps its sign and the height grows or falls.
  void add_arc(PlaneFan &fan, double angle0, double height0, double angle1, double height1);

  Mantle *mantle_ = nullptr;
  EdgePlaces *fitted_ = nullptr;
  Vec3 along_, across_;             // unit, perpendicular to the axis
  double radial_ = 0.0, axial_ = 0.0, offset_ = 0.0;  // of the plane: radial cos(angle) distance + axial height = offset
  double sense_ = 1.0;              // 1 where angles grow counter-clockwise about the plane
  double front_ = 0.0;              // the height at angle 0; between the ends
  double pole_ = 0.0;               // of a cone's conic: the cosine of the angle at which it is infinitely far from the apex
  bool is_steady_ = false;          // whether its heights follow from angles, as good as exactly: then they are
  double swing_front_ = 0.0, swing_ = 0.0;  // swing_front + swing (1 - cosine)
  Passages passages_;
};

// The circle where the mantle meets an end, or a cone's apex, which counts as one without a radius.
class Rim {
 public:
  enum End : std::size_t { base, top, ends };

  void start(Mantle &mantle, End end, EdgePlaces *fitted = nullptr);
  // A place (in the mantle's frame, and as a corner) where the end's border goes over to the rim, or comes from there.
  void add_passage(const Vec3 &at, bool to_rim, const Vec3 &corner = {});
  // Adds the rim's arcs between the passages to the mantle and to the end. Where there are none all of it borders, or nothing: `holds` tells
  // of a place in the mantle's frame whether it is in the other body. False where passages do not fit together.
  template <typename Holds>
  bool follow(PlaneFan &fan, Holds &&holds) {
    if (!passages_.empty()) return follow_arcs(fan);
    if (holds(Vec3{radius_, 0.0, height_})) follow_all(fan);
    return true;
  }

 private:
  bool follow_arcs(PlaneFan &fan);
  void follow_all(PlaneFan &fan);
  void add_place(PlaneFan &fan, double cosine, double sine, double step);
  void add_arc(PlaneFan &fan, double from, double turn);

  Mantle *mantle_ = nullptr;
  EdgePlaces *fitted_ = nullptr;
  double radius_ = 0.0, height_ = 0.0;
  double sense_ = 1.0;  // 1 where angles grow counter-clockwise about the end
  Passages passages_;
};

}  // namespace cmb
