#include "narrowphase/multicontact/multiplier_distribution.hpp"

#include <algorithm>

#include "math/smoothstep.hpp"
#include "narrowphase/multicontact/supporting_planes.hpp"
#include "narrowphase/multicontact/unilateral_springs.hpp"

namespace cmb::convex {

namespace {

// How far the ball's centre moves to find places that it nearly touches, and faces are from it, as a part of the radius.
constexpr double window = 0.05;
// The ball is at rest where it moves less than this, relative to the size.
constexpr double at_rest = 1e-11;
constexpr int most_rounds = 60;
// The part of the load below which a place that is no face goes over to the faces nearby.
constexpr double leaving = 0.02;
// Where directions differ by less a place passes into a face (rad).
constexpr double like_direction = 0.1;
// The square of an angle (rad) at which a place alone takes all, to rounding.
constexpr double opposite = 1e-13;

// Moves a ball that rests on three places to where it is `away` (m) from each, or as far in them where that is negative:
// where a larger or smaller ball touches them. False where it does not come there within twice the way that the planes
// tell, `step` (m).
bool move_away(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, double away, double step,
               ActiveSet &active) {
  const Vec3 from = active.centre;
  const double radius = active.radius + away;
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3 last = active.centre;
    const SupportingPlane *planes = active.planes;
    if (!active.intersection(planes[0].height - radius, planes[1].height - radius, planes[2].height - radius, active.centre)) {
      return false;
    }
    if (!(norm2(active.centre - from) < 4.0 * step * step)) return false;
    if (norm2(active.centre - last) <= at_rest * at_rest * size * size) break;
    for (SupportingPlane *plane = active.planes; plane != active.planes + 3; ++plane) {
      update_plane(a, b, b_in_a, active.centre + plane->multiplier * plane->direction, *plane);
    }
  }
  return true;
}

// The place nearest to a ball that has been moved away from its three places, if it is nearer than these. `part`
// receives how near it is to the ball at rest: 1 where that touches it, 0 where it is just as near as those to the other.
bool find_near_place(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const ActiveSet &active,
                     double away, double step, DistanceScratch &scratch, SupportingPlane &place, double &part) {
  ActiveSet other = active;
  if (!move_away(a, b, b_in_a, size, away, step, other)) return false;
  const SignedDistance there = distance_from_centre(a, b, b_in_a, other, scratch);
  const double nearer = active.radius + away + there.distance;
  if (!(nearer > active.slack)) return false;
  place = supporting_plane_at(there, other.centre);
  update_plane(a, b, b_in_a, active.centre, place);
  const double gap = std::max(0.0, place.height - dot(place.direction, active.centre) - active.radius);
  part = falling_smoothstep(gap / (gap + nearer));
  return part > 0.0;
}

// The springs at the places that share the load.
class Springs {
 public:
  explicit Springs(SupportingPlane *places) : places_(places) {}

  int count() const { return count_; }
  void add(const SupportingPlane &plane, double part) {
    if (!(part > 0.0)) return;
    places_[count_] = plane;
    part_[count_++] = part;
  }

  // Sets the multipliers that bear the load, which is no unit vector, and drops places without one; false where nothing is found.
  bool divide(const Vec3 &load) {
    const double length = norm(load);
    const Vec3 unit = (1.0 / length) * load;
    Vec3 direction[max_planes];
    double stiffness[max_planes], force[max_planes];
    for (int k = 0; k < count_; ++k) {
      direction[k] = places_[k].direction;
      stiffness[k] = part_[k] / (0.5 * norm2(unit - direction[k]) + opposite);
    }
    if (!solve_unilateral_springs(unit, direction, stiffness, count_, force)) return false;
    int kept = 0;
    for (int k = 0; k < count_; ++k) {
      if (!(force[k] > 0.0)) continue;
      places_[kept] = places_[k];
      places_[kept++].multiplier = length * force[k];
    }
    count_ = kept;
    return true;
  }

 private:
  SupportingPlane *places_;
  double part_[max_planes];
  int count_ = 0;
};

// How nearly two places are one: 1 where they are.
double likeness(const SupportingPlane &place, const SupportingPlane &other) {
  return falling_smoothstep(norm(place.direction - other.direction) / like_direction);
}

// How nearly a place is one of the faces.
double likeness(const SupportingPlane &place, const NearActiveFaces &faces) {
  double result = 0.0;
  for (int k = 0; k < faces.count(); ++k) result = std::max(result, faces.part(k) * likeness(place, faces.plane(k)));
  return result;
}

// How nearly a place is one of those that the ball rests on.
double likeness(const SupportingPlane &place, const ActiveSet &active) {
  double result = 0.0;
  for (int k = 0; k < active.count; ++k) result = std::max(result, likeness(place, active.planes[k]));
  return result;
}

// Which of the places that the ball rests on is in this direction; their count where none is.
int place_in(const ActiveSet &active, const Vec3 &direction) {
  int k = 0;
  while (k < active.count && !same_place(active.planes[k].direction, direction)) ++k;
  return k;
}

}  // namespace

int distribute_multipliers(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const ActiveSet &active,
                           DistanceScratch &scratch, SupportingPlane places[max_planes]) {
  const auto as_they_are = [&] {
    std::copy_n(active.planes, active.count, places);
    return active.count;
  };
  if (active.count < 2) return as_they_are();
  double least = INFINITY, sum = 0.0;
  for (int k = 0; k < active.count; ++k) least = std::min(least, active.planes[k].multiplier), sum += active.planes[k].multiplier;

  // Faces that the ball nearly touches. Other places pass into these, and go over to them where they are about to leave.
  const NearActiveFaces faces(a, b, b_in_a, active, window * active.radius);
  bool more = false;
  for (int k = 0; k < faces.count(); ++k) {
    more = more || (faces.part(k) > 0.0 && place_in(active, faces.plane(k).direction) == active.count);
  }
  Springs springs(places);
  for (const SupportingPlane *place = active.planes; place != active.planes + active.count; ++place) {
    const int face = faces.find(place->direction);
    const double of_face = face < faces.count() ? faces.part(face) : 0.0;
    const double going = more ? falling_smoothstep(place->multiplier / (leaving * sum)) : 0.0;
    springs.add(*place, of_face + (1.0 - going) * (1.0 - likeness(*place, faces)));
  }
  for (int k = 0; k < faces.count(); ++k) {
    if (place_in(active, faces.plane(k).direction) == active.count) springs.add(faces.plane(k), faces.part(k));
  }

  if (active.count == 3 && !active.on_cone_ring) {
    const double step = window * active.radius * (3.0 * least / sum);
    Vec3 way;  // of the centre, for each metre that the ball grows
    if (active.intersection(-1.0, -1.0, -1.0, way)) {
      const double change = step / norm(way);
      for (const double away : {change, -change}) {
        SupportingPlane place;
        double part;
        if (!find_near_place(a, b, b_in_a, size, active, away, step, scratch, place, part)) continue;
        part *= (1.0 - likeness(place, faces)) * (1.0 - likeness(place, active));
        springs.add(place, part);
        more = more || part > 0.0;
      }
    }
  }
  if (!more || !springs.divide(-active.centre)) return as_they_are();
  return springs.count();
}

}  // namespace cmb::convex
