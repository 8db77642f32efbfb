// The part of a cylinder's or cone's mantle in another body, integrated along its border.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "manifold/revolved/edge_places.hpp"
#include "manifold/revolved/revolved_body.hpp"
#include "manifold/surface/overlap_surface.hpp"

namespace cmb {

using convex::Pose;

struct BorderPlace {
  Vec3 at, outward;     // in the nodes' axes, from the place
  double height, turn;  // the height of a fitted edge's counts from the place
};

// A border's place counts by the angle that it turns through about the axis times what is between a height and its own: so the parts of
// a border come in whatever order, and may go round the axis.
class Mantle {
 public:
  // What the other body is, which is what integrals over the mantle are for: along a cylinder moments of what a polytope stores are of the
  // third degree, those of what is stored in a mesh's wedge of the fourth, in another mantle of the fifth; along a cone one more.
  enum class Partner { polytope, wedge, revolved };
  // `in_common`: from the body's frame to the axes of the nodes, `place` (there) where their places are from. `to_apex`: whether a cone's
  // apex is in the other body, or its border turns there. Heights then count from there; else from the border's mean one, so that no more is
  // added than has to be. `border`: room to work in. `is_fitted`: whether its edges are fitted (edge_places.hpp).
  Mantle(const RevolvedBody &body, const Pose &in_common, const Vec3 &place, bool to_apex, Partner partner,
         std::vector<BorderPlace> &border, OverlapSurface::Nodes &nodes, bool is_fitted = false);

  const RevolvedBody &body() const { return *body_; }
  Partner partner() const { return partner_; }
  const Pose &in_common() const { return in_common_; }
  // A border's place at `height`, to which `outward` (unit, in the body's frame) points from the axis; it turns by `turn`, counter-clockwise
  // about the plane side that borders there, clockwise about the mantle.
  void add_border_place(const Vec3 &outward, double height, double turn);
  // A place of the mantle, in the nodes' axes from the place, and the border's way there.
  void add_border_way(const Vec3 &at, const Vec3 &step, double sense);
  OffSide off(const Vec3 &at) const;
  std::vector<BorderPlace> &border() { return *border_; }
  bool counts_from_apex() const { return to_apex_; }
  void count_from_apex(bool to_apex) { to_apex_ = to_apex; }
  // Adds the nodes, once the border is whole.
  void integrate();
  // What a border's place at this height adds by its turn, as much as counts; from `begin` on where it is the first one.
  double width_at(double height, double begin) const {
    const double from = to_apex_ ? body_->half : border_->empty() ? begin : counted_from() + border_->front().height;
    return (height - from) * 0.5 * (body_->radius_at(height) + body_->radius_at(from));
  }

 private:
  // Where integrals along rulings begin.
  struct Cut {
    Vec3 normal;
    double offset;
    bool is_level;
  };
  double radius_from(const BorderPlace &place) const {
    return is_fitted_ ? radius_there_ + body_->slope * place.height : body_->radius_at(place.height);
  }
  double rise_from(const Cut &cut, const BorderPlace &place) const;
  double counted_from() const { return is_fitted_ ? height_there_ : 0.0; }
  void integrate_from(double height);
  void integrate_from(const Cut &cut);
  bool cancels(double from) const;
  double mean_height() const;
  double area_from(const Cut &cut) const;
  std::array<Cut, 2> cuts_along() const;

  const RevolvedBody *body_;
  Pose in_common_;
  std::vector<BorderPlace> *border_;
  OverlapSurface::Nodes *nodes_;
  Vec3 axis_, from_place_;  // in the nodes' axes; to the body's origin
  Vec3 from_axis_;          // the place's, across the axis
  double height_there_, radius_there_, beyond_there_;  // at the place
  bool to_apex_;
  Partner partner_;
  bool is_fitted_;
};

}  // namespace cmb
