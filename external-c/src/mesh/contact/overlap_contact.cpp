#include "mesh/contact/overlap_contact.hpp"

#include "mesh/intersection/pierced_load.hpp"

namespace cmb::mesh {

bool append_overlap_contact(const WedgeIntegrals &overlap, const SectionedBody &body, const TriangleMesh &mesh, const Pose &pose,
                            ElasticScratch &scratch, ContactSet &result) {
  const std::size_t begin = result.points.size();
  // What else passes through the body is judged by the load of the patches: a corner's energy may push less.
  const WedgeEnergy stored(overlap, scratch.energy);
  double carried = stored.touches() ? append_elastic_points(overlap, stored, pose, scratch.points, result) : 0.0;
  if (!mesh.closed() && carried > 0.0) {
    const double load = total_load(result.points, begin);
    carried *= limit_by_sections(body, overlap.radius(), mesh, begin, result) / load;
  }
  const double depth = carried > 0.0 ? stored.carrying_depth() : 0.0;
  const CarriedLoad all{carried, norm(net_load(result.points, begin)), depth};
  return complete_contact(body, mesh, pose, all, result);
}

}  // namespace cmb::mesh
