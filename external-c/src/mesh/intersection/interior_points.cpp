#include "mesh/intersection/interior_points.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

// Whether the place lies in the box, no less than `depth` from its sides.
bool holds(const Bounds &box, const Vec3 &p, double depth) {
  for (int k = 0; k < 3; ++k) {
    if (!(p[k] - box.low[k] >= depth && box.high[k] - p[k] >= depth)) return false;
  }
  return true;
}

}  // namespace

InteriorPoint::InteriorPoint(const TriangleMesh &mesh, const Vec3 &place, double enough) : place_(place) {
  if (mesh.closed() && holds(mesh.hierarchy().bounds(), place, enough)) nearest_ = mesh.nearest(place);
}

void InteriorPoint::push_out(double other, double part, const Pose &pose, ContactSet &result, double weight) const {
  const double missing = part * (depth() - other);
  if (!(missing > 0.0) || !(weight > 0.0)) return;
  const Vec3 normal = pose.rotation * nearest_.normal, witness = pose(0.5 * (place_ + nearest_.point));
  result.points.push_back({missing, weight, normal, witness});
  if (!(-part * depth() < result.distance)) return;
  result.distance = -part * depth();
  result.normal = normal;
  result.witness = witness;
}

bool may_hold_component(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place) {
  if (!mesh.closed()) return false;
  const double rounding = 1e-12 * (mesh.bound_radius() + body.bound_radius());
  for (std::uint32_t component = 0; component < body.component_count(); ++component) {
    const Vec3 at = place(body.place_of_component(component));
    if (holds(mesh.hierarchy().bounds(), at, -rounding) && mesh.nearest(at).distance < rounding) return true;
  }
  return false;
}

InteriorPoints::InteriorPoints(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place,
                               double enough) {
  for (const Vec3 &p : body.interior_points()) {
    const InteriorPoint inside(mesh, place(p), enough);
    if (!(inside.depth() > 0.0)) continue;
    places_[count_++] = inside;
    deepest_ = std::fmax(deepest_, inside.depth());
  }
}

void InteriorPoints::push_out(double other, double part, const Pose &pose, ContactSet &result) const {
  if (!(deepest_ > other)) return;
  const auto share = [&](const InteriorPoint &place) {
    const double ratio = std::fmax(0.0, place.depth() - other) / (deepest_ - other);
    return ratio * ratio * ratio * ratio;
  };
  double sum = 0.0;
  for (std::size_t k = 0; k < count_; ++k) sum += share(places_[k]);
  for (std::size_t k = 0; k < count_; ++k) places_[k].push_out(other, part, pose, result, share(places_[k]) / sum);
}

}  // namespace cmb::mesh
