#include "mesh/elastic/wedge_integrals.hpp"

#include <cmath>

namespace cmb::mesh {

void WedgeIntegrals::look_at(std::uint32_t t) {
  triangle_ = t;
  normal_ = mesh_.face_normal(t);
  offset_ = dot(normal_, mesh_.corner(t, 0));
}

bool WedgeIntegrals::is_out_of_reach(const Vec3 &center) const {
  if (depth(center) <= -radius_) return true;
  for (const WedgeSide &side : mesh_.wedge_sides(triangle_)) {
    if (dot(side.normal, center) - side.offset <= -radius_) return true;
  }
  return false;
}

void WedgeIntegrals::begin(const Vec3 &place) {
  if (!begun_) patches_.set_origin(place);
  begun_ = true;
}

void WedgeIntegrals::add_patch(const PatchSums &patch, const Vec3 &middle) {
  if (patch.area > 0.0) patches_.add(patch, normal_, inside_share(middle));
}

void WedgeIntegrals::offer_deepest(double depth, const Vec3 &place) {
  if (!(depth > deepest_) || !(inside_share(place) > 0.0)) return;
  deepest_ = depth;
  deepest_place_ = place;
  deepest_normal_ = normal_;
}

// 1 where the triangle's plane is what is nearest to a point behind it; falls to 0 where another part of the surface
// is nearer by half, as on the far side of a thin wall. Down to the clear depth nothing is, which need not be looked up.
double WedgeIntegrals::inside_share(const Vec3 &p) const {
  const double clear = mesh_.clear_depth(triangle_), deep = depth(p);
  if (!mesh_.closed() || deep <= clear) return 1.0;
  const double share = std::fmin(1.0, std::fmax(0.0, -2.0 * mesh_.nearest(p, triangle_).distance / deep - 1.0 + 1e-9));
  return deep >= 2.0 * clear ? share : 1.0 - (deep / clear - 1.0) * (1.0 - share);
}

Wrench WedgeIntegrals::wrench() const {
  const double part = 0.5 * factor_ / first_.integral, mean = third_.integral / first_.integral;
  return {-part * (third_.gradient.force - mean * first_.gradient.force),
          -part * (third_.gradient.torque - mean * first_.gradient.torque)};
}

}  // namespace cmb::mesh
