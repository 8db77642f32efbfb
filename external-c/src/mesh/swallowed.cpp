#include "mesh/swallowed.hpp"

namespace cmb::mesh {

bool swallowed_contact(const Vec3 &place, const TriangleMesh &mesh, const Pose &pose, ContactSet &result) {
  if (!mesh.closed()) return false;
  const NearestPoint nearest = mesh.nearest(place);
  if (!(nearest.distance < 0.0)) return false;
  result.distance = nearest.distance;
  result.normal = pose.rotation * nearest.normal;
  result.witness = pose(0.5 * (place + nearest.point));
  result.points.push_back({-nearest.distance, 1.0, result.normal, result.witness});
  return true;
}

}  // namespace cmb::mesh
