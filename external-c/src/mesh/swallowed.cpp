#include "mesh/swallowed.hpp"

namespace cmb::mesh {

SwallowedPlace::SwallowedPlace(const TriangleMesh &mesh, const Vec3 &place) : place_(place) {
  if (mesh.closed()) nearest_ = mesh.nearest(place);
}

void SwallowedPlace::lead_out(double other, double part, const Pose &pose, ContactSet &result) const {
  const double missing = part * (depth() - other);
  if (!(missing > 0.0)) return;
  const Vec3 normal = pose.rotation * nearest_.normal, witness = pose(0.5 * (place_ + nearest_.point));
  result.points.push_back({missing, 1.0, normal, witness});
  if (!(-part * depth() < result.distance)) return;
  result.distance = -part * depth();
  result.normal = normal;
  result.witness = witness;
}

}  // namespace cmb::mesh
