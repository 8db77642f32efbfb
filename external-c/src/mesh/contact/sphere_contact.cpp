#include "mesh/contact/ball_contacts.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/intersection/pierced_load.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

void sphere_contact(const Vec3 &center, double radius, const TriangleMesh &mesh, const Pose &pose,
                    MeshContactScratch &scratch, ContactSet &result) {
  const std::size_t begin = result.points.size();
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
    const Vec3 normal = pose.rotation * shared[i].normal;
    result.points.push_back({shared[i].depth, shared[i].load / shared[i].depth, normal, middle(normal, shared[i].depth)});
  }
  // Beside the rim of a sheet what is nearest may carry nothing.
  const double load = total_load(result.points, begin);
  if (least_load_part * load < -result.distance) {
    const Pose place{{}, local};
    const SectionedBody ball(convex::make_sphere(radius), place, scratch.patch.polygon, scratch.patch.clipped);
    complete_contact(ball, mesh, pose, load, result);
  }
}

}  // namespace cmb::mesh
