#include "mesh/contact/ball_contacts.hpp"
#include "mesh/contact/mesh_contact.hpp"

namespace cmb::mesh {

void sphere_contact(const Vec3 &center, double radius, const TriangleMesh &mesh, const Pose &pose,
                    MeshContactScratch &scratch, ContactSet &result) {
  const Vec3 local = pose.inverse()(center);
  const NearestPoint nearest = mesh.nearest(local);
  SharedLoad &shared = scratch.shared;
  result.distance = ball_contacts(local, radius, mesh, nearest, shared);
  result.normal = pose.rotation * nearest.normal;
  // Half way between a place of the mesh and the ball's surface below it.
  const auto middle = [&](const Vec3 &normal, double depth) { return center - (radius - 0.5 * depth) * normal; };
  result.witness = middle(result.normal, -result.distance);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (!(shared[i].load > 0.0)) continue;
    const Vec3 normal = pose.rotation * shared[i].push;
    result.points.push_back({shared[i].depth, shared[i].load / shared[i].depth, normal, middle(normal, shared[i].depth)});
  }
}

}  // namespace cmb::mesh
