#include <ccd/ccd.h>

#include <cmath>

#include "contact_peer.hpp"

namespace cmb::bench {

namespace {

struct PlacedShape {
  const Shape *shape;
  Pose pose;
};

// libccd is given this engine's support functions: with a search over all vertices it would be slower.
void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *result) {
  const PlacedShape &placed = *static_cast<const PlacedShape *>(object);
  const Vec3 local = transposed_times(placed.pose.rotation, {direction->v[0], direction->v[1], direction->v[2]});
  Vec3 p = convex::core_support(placed.shape->body, local).point;
  if (placed.shape->body.radius > 0.0) p = p + placed.shape->body.radius * normalized(local);
  p = placed.pose(p);
  ccdVec3Set(result, p.x, p.y, p.z);
}

void center(const void *object, ccd_vec3_t *result) {
  const PlacedShape &placed = *static_cast<const PlacedShape *>(object);
  const Vec3 p = placed.pose(convex::core_center(placed.shape->body));
  ccdVec3Set(result, p.x, p.y, p.z);
}

class PortalPeer : public ContactPeer {
 public:
  explicit PortalPeer(const PosedPair &pair) : pair_(pair), a_{&pair.a, {}}, b_{&pair.b, {}} {
    CCD_INIT(&options_);
    options_.support1 = options_.support2 = support;
    options_.center1 = options_.center2 = center;
    options_.max_iterations = 500;
    // With libccd's own 1e-4 it would stop early: fast, with errors of some 1e-4 of the size.
    options_.mpr_tolerance = 1e-8 * (pair.a.bound_radius + pair.b.bound_radius);
  }

  double ask(std::size_t k) override {
    a_.pose = pair_.pose_a[k];
    b_.pose = pair_.pose_b[k];
    ccd_real_t depth;
    ccd_vec3_t direction, at;
    return ccdMPRPenetration(&a_, &b_, &options_, &depth, &direction, &at) == 0 ? -depth : std::nan("");
  }

 private:
  const PosedPair &pair_;
  ccd_t options_;
  PlacedShape a_, b_;
};

}  // namespace

std::unique_ptr<ContactPeer> make_libccd_portal(const PosedPair &pair) {
  if (pair.a.kind == ShapeKind::halfspace || pair.b.kind == ShapeKind::halfspace) return nullptr;
  return std::make_unique<PortalPeer>(pair);
}

}  // namespace cmb::bench
