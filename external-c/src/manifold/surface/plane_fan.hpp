// Plane parts of an overlap's surface, integrated as fans of their borders.
#pragma once

#include <vector>

#include "manifold/surface/off_side.hpp"
#include "manifold/surface/overlap_surface.hpp"

namespace cmb {

// A border's parts run counter-clockwise about the normal, in whatever order they come.
class PlaneFan {
 public:
  // `normal`: unit, outward. `place`: where the nodes' places are from. `offset`: how far the plane is from there along the normal.
  PlaneFan(const Vec3 &normal, const Vec3 &place, double offset, OverlapSurface::Nodes &nodes)
      : normal_(normal), place_(place), offset_(offset), nodes_(&nodes) {}

  const Vec3 &normal() const { return normal_; }
  // From where the nodes' places are from.
  OffSide off(const Vec3 &at) const { return {dot(normal_, at) - offset_, normal_}; }
  void add_segment(const Vec3 &from, const Vec3 &to);
  // A place of a curve, and its way there by the weight of the rule that integrates along it.
  void add_curve_node(const Vec3 &at, const Vec3 &step);

 private:
  void begin(const Vec3 &at) {
    if (!has_apex_) apex_ = at, has_apex_ = true;
  }

  Vec3 normal_, place_;
  double offset_;
  OverlapSurface::Nodes *nodes_;
  Vec3 apex_;  // the first place of the border, so that all of the fan is in both bodies
  bool has_apex_ = false;
};

}  // namespace cmb
