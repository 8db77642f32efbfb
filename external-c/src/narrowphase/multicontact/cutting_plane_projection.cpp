#include "narrowphase/multicontact/cutting_plane_projection.hpp"

#include <algorithm>

#include "narrowphase/multicontact/supporting_planes.hpp"

namespace cmb::convex {

namespace {

// The ball is at rest where what its places are seen from moves less than this, relative to the size.
constexpr double at_rest = 1e-11;
constexpr int max_planes_added = 40, most_rounds = 60;
// A part of the change before that tells of a slow approach; the cosine of directions that may be of one place.
constexpr double slow = 0.5, nearby_cosine = 0.995;

// What the planes' places are seen from: the centre as it would be without the plane's own multiplier. As the nearest to that the
// place is well defined however nearly the surface there is as curved as the ball, from whose centre a whole arc is as near.
void find_views(const ActiveSet &active, Vec3 *views) {
  for (int k = 0; k < active.count; ++k) views[k] = active.centre + active.planes[k].multiplier * active.planes[k].direction;
}

// The planes where the ball rests on a curved surface are not yet those at its places: one round moves them there,
// and the centre with them. `next` receives the views from then on. False where there is no centre.
bool update_planes(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, ActiveSet &active, const Vec3 *views,
                   Vec3 *next) {
  for (int k = 0; k < active.count; ++k) update_plane(a, b, b_in_a, views[k], active.planes[k]);
  if (!active.project_origin()) return false;
  find_views(active, next);
  return true;
}

// The square of the farthest way between views.
double farthest2(const Vec3 *views, const Vec3 *next, int count) {
  double result = 0.0;
  for (int k = 0; k < count; ++k) result = std::max(result, norm2(next[k] - views[k]));
  return result;
}

// Rounds until planes and centre agree. Where they approach each other slowly, false, and the ball as it was: on a surface that
// is as curved as the ball, as all about a cone's axis, which places hold the ball is not for these few to say.
bool iterate_planes(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active) {
  const ActiveSet before = active;
  Vec3 views[ActiveSet::most], next[ActiveSet::most];
  find_views(active, views);
  double last = INFINITY;
  for (int round = 0; round < most_rounds; ++round) {
    const int count = active.count;
    if (!update_planes(a, b, b_in_a, active, views, next)) break;
    const double change = farthest2(views, next, count);
    std::copy_n(next, count, views);
    if (active.count != count) {
      last = INFINITY;
      continue;
    }
    if (change <= at_rest * at_rest * size * size) return true;
    if (change > slow * slow * last) break;
    last = change;
  }
  active = before;
  return false;
}

// The same, however slowly they approach each other. False where there is no centre.
bool iterate_planes_to_end(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active) {
  Vec3 views[ActiveSet::most], next[ActiveSet::most];
  find_views(active, views);
  for (int round = 0; round < most_rounds; ++round) {
    const int count = active.count;
    if (!update_planes(a, b, b_in_a, active, views, next)) return false;
    const bool same_planes = active.count == count;
    if (same_planes && farthest2(views, next, count) <= at_rest * at_rest * size * size) return true;
    std::copy_n(next, active.count, views);
  }
  return true;
}

}  // namespace

bool cutting_plane_projection(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active,
                              DistanceScratch &scratch) {
  const auto lacks_nothing = [](const SignedDistance &there, const ActiveSet &held) {
    return -there.distance >= held.radius - held.slack;
  };
  bool at_rest_there = true, to_end = false;
  for (int step = 0; step < max_planes_added; ++step) {
    if (step > 0 && !to_end) at_rest_there = iterate_planes(a, b, b_in_a, size, active);
    if (to_end && !iterate_planes_to_end(a, b, b_in_a, size, active)) return false;
    const SignedDistance there = distance_from_centre(a, b, b_in_a, active, scratch);
    if (lacks_nothing(there, active)) {
      if (at_rest_there || to_end) break;
      to_end = true;
      continue;
    }
    const SupportingPlane added = supporting_plane_at(there, active.centre);
    for (int k = 0; k < active.count; ++k) {
      if (!(dot(added.direction, active.planes[k].direction) > nearby_cosine)) continue;
      to_end = true;
      // Where the surface is nearly as curved as the ball, the place that holds it may have moved as far.
      ActiveSet moved = active;
      moved.planes[k] = added;
      if (!moved.project_origin() || !iterate_planes_to_end(a, b, b_in_a, size, moved)) continue;
      if (!lacks_nothing(distance_from_centre(a, b, b_in_a, moved, scratch), moved)) continue;
      active = moved;
      return true;
    }
    active.planes[active.count++] = added;
    if (!active.project_origin()) return false;
  }
  return true;
}

}  // namespace cmb::convex
