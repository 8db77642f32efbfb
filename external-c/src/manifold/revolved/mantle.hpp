// The part of a cylinder's or cone's mantle in another body, integrated along its border.
#pragma once

#include <cstddef>
#include <vector>

#include "manifold/revolved/overlap_surface.hpp"
#include "manifold/revolved/revolved_body.hpp"

namespace cmb {

using convex::Pose;

// A border's place counts by the angle that it turns through about the axis times what is between a height and its own: so the parts of
// a border come in whatever order, and may go round the axis.
class Mantle {
 public:
  // What the other body is, which is what integrals over the mantle are for: along a cylinder moments of what a polytope stores are of the
  // third degree, those of what is stored in another mantle of the fifth; along a cone one more.
  enum class Partner { polytope, revolved };
  // `in_common`: from the body's frame to the axes of the nodes, `place` (there) where their places are from. `to_apex`: whether a cone's
  // apex is in the other body, or its border turns there. Heights then count from there; else from the place.
  Mantle(const RevolvedBody &body, const Pose &in_common, const Vec3 &place, bool to_apex, Partner partner,
         std::vector<OverlapSurface::Node> &nodes);

  const RevolvedBody &body() const { return *body_; }
  const Pose &in_common() const { return in_common_; }
  // A border's place at `height`, to which `outward` (unit) points from the axis; it turns by `turn`, counter-clockwise about the plane
  // side that borders there, clockwise about the mantle.
  void add_border_node(const Vec3 &outward, double height, double turn);
  // The same for a place and its way in the nodes' axes.
  void add_border_node(const Vec3 &at, const Vec3 &step);

 private:
  // `outward` in the nodes' axes.
  void add_nodes(const Vec3 &outward, double height, double turn);

  const RevolvedBody *body_;
  Pose in_common_;
  std::vector<OverlapSurface::Node> *nodes_;
  Vec3 axis_, from_place_;  // in the nodes' axes; to the body's origin
  double from_ = 0.0;  // the height that is counted from
  const double *part_, *weight_;  // of the rule from there to the border
  std::size_t parts_;
};

}  // namespace cmb
