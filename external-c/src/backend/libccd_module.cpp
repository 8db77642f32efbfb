// The module with libccd: its Minkowski portal refinement, which answers for overlapping shapes only.
#include <ccd/ccd.h>

#include "backend/distance_library.hpp"

namespace {

using namespace cmb;

constexpr double portal_tolerance = 1e-10;  // of the portal's distance, relative to a body of unit size
constexpr unsigned long most_iterations = 500;

struct PlacedShape {
  const Shape *shape;
  const Pose *pose;
};

void support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *result) {
  const PlacedShape &placed = *static_cast<const PlacedShape *>(object);
  const Vec3 d{direction->v[0], direction->v[1], direction->v[2]};
  const Vec3 local = transposed_times(placed.pose->rotation, d);
  Vec3 p = convex::core_support(placed.shape->body, local).point;
  if (placed.shape->body.radius > 0.0) p = p + placed.shape->body.radius * normalized(local);
  const Vec3 world = (*placed.pose)(p);
  ccdVec3Set(result, world.x, world.y, world.z);
}

void center(const void *object, ccd_vec3_t *result) {
  const PlacedShape &placed = *static_cast<const PlacedShape *>(object);
  const Vec3 world = (*placed.pose)(convex::core_center(placed.shape->body));
  ccdVec3Set(result, world.x, world.y, world.z);
}

Vec3 vector(const ccd_vec3_t &v) { return {v.v[0], v.v[1], v.v[2]}; }

bool distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, SignedDistance &answer) {
  ccd_t options;
  CCD_INIT(&options);
  options.support1 = support;
  options.support2 = support;
  options.center1 = center;
  options.center2 = center;
  options.mpr_tolerance = portal_tolerance * (a.bound_radius + b.bound_radius);
  options.max_iterations = most_iterations;
  const PlacedShape placed_a{&a, &pose_a}, placed_b{&b, &pose_b};
  ccd_real_t depth = 0.0;
  ccd_vec3_t direction, position;
  if (ccdMPRPenetration(&placed_a, &placed_b, &options, &depth, &direction, &position) != 0) return false;
  answer.distance = -depth;
  answer.normal = -vector(direction);
  answer.point_a = vector(position) + 0.5 * answer.distance * answer.normal;
  answer.point_b = vector(position) - 0.5 * answer.distance * answer.normal;
  return true;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const cmb::DistanceLibrary cmb_distance_library = {
    CMB_VERSION, sizeof(cmb::Shape), sizeof(cmb::SignedDistance), nullptr, distance};
