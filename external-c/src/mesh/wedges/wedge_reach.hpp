// How far from their triangles wedges reach.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/core/mesh_data.hpp"
#include "mesh/core/triangle_hierarchy.hpp"
#include "mesh/wedges/wedge_plane.hpp"

namespace cmb::mesh {

// Behind a concave edge a wedge becomes wider with depth: what is s deep in it lies within `spread` times s of its triangle. So what is beside a
// triangle has to be as deep below its plane to be in its wedge; which leaves out whole nodes of the hierarchy.
class WedgeReach {
 public:
  // `normals` and `sides` of the triangles; `beyond_folds`: how far what counts across their folds spreads, by its depth below them.
  WedgeReach(const MeshData &data, const std::vector<Vec3> &normals, const std::vector<std::array<WedgeSide, 3>> &sides,
             const std::vector<double> &beyond_folds, const TriangleHierarchy &hierarchy);
  WedgeReach() = default;

  // Whether some of a convex body may be in the wedge of a triangle of the node. support(d) is a place of the body farthest along d.
  //
  // For p in the wedge of a triangle with normal n, all depths s(p) being those below its plane, and a the node's axis:
  // |p - center| <= radius + spread s, and s <= a . (center - p) + height + deviation |p - center|. So
  // s <= steepness (a . (center - p) + height + deviation radius), and for any unit u
  // (u + spread steepness a) . (p - center) <= radius + spread steepness (height + deviation radius).
  template <typename Support>
  bool may_meet(std::uint32_t node, Support &&support) const {
    const Bundle &bundle = bundles_[node];
    if (!bundle.is_narrow) return true;
    const Vec3 lowest = support(-bundle.axis) - bundle.center;
    const double below = dot(bundle.axis, lowest);
    if (below > bundle.most_above) return false;
    const Vec3 beside = lowest - below * bundle.axis;
    const double aside = norm(beside);
    if (!(aside > bundle.radius)) return true;
    const Vec3 direction = (1.0 / aside) * beside + bundle.slope * bundle.axis;
    return dot(direction, support(-direction) - bundle.center) <= bundle.radius + bundle.slope * bundle.most_above;
  }

  // Whether some of a convex body may be on a triangle of the node. reach(d) is the greatest d . x of the body.
  template <typename Reach>
  bool may_touch(std::uint32_t node, Reach &&reach) const {
    const Bundle &bundle = bundles_[node];
    return -reach(-bundle.axis) - dot(bundle.axis, bundle.center) <= bundle.most_above;
  }

 private:
  // Of the triangles of a node.
  struct Bundle {
    Vec3 axis, center;
    double radius = 0.0;      // of a ball about the center that holds all
    double most_above = 0.0;  // height + deviation radius: how far along the axis their planes reach at the center
    double slope = 0.0;       // spread steepness
    bool is_narrow = false;   // else nothing is known
  };
  std::vector<Bundle> bundles_;
};

}  // namespace cmb::mesh
