#include "manifold/capsule_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/rod_end_share.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"

namespace cmb {

namespace {

// A number for each of the two axes; both are computed at once.
typedef double OfAxes __attribute__((vector_size(16)));

OfAxes both(double x) { return OfAxes{x, x}; }
OfAxes of_the_other(OfAxes x) { return OfAxes{x[1], x[0]}; }
OfAxes least(OfAxes x, OfAxes y) { return x < y ? x : y; }
OfAxes greatest(OfAxes x, OfAxes y) { return x > y ? x : y; }
// A sine, whatever the places are that a library took for the nearest.
OfAxes sine_within(OfAxes x) { return greatest(least(x, both(1.0)), both(-1.0)); }
OfAxes root(OfAxes x) { return OfAxes{std::sqrt(x[0]), std::sqrt(x[1])}; }

// The axes of two capsules and the places where they are nearest.
struct NearestPlaces {
  Vec3 axis[2];
  OfAxes half;
  OfAxes foot;     // of the other's middle
  OfAxes at;       // the nearest places
  OfAxes lean;     // the gap between them, times its part along the axis, which is 0 but at an end
  double cosine, apart2, apart;
  Vec3 normal;     // from B to A
  Vec3 witness;    // half way between the surfaces
  double radius_difference;  // half of A's radius minus B's
};

// A station on each axis, `way` from the nearest place, the place opposite it on the other axis, and the gap.
struct Stations {
  OfAxes way, opposite, gap;
};

inline Stations stations(const NearestPlaces &nearest, OfAxes way) {
  const OfAxes half = of_the_other(nearest.half);
  const OfAxes foot = (nearest.at + way) * nearest.cosine + of_the_other(nearest.foot);
  const OfAxes opposite = least(greatest(foot, -half), half) - of_the_other(nearest.at);
  const OfAxes gap2 = nearest.apart2 + way * way + opposite * (opposite - (2.0 * nearest.cosine) * way) +
                      2.0 * (way * nearest.lean + opposite * of_the_other(nearest.lean));
  return {way, opposite, root(gap2)};
}

// The part of the inclinations under which the inner of two stations is deeper.
OfAxes inner_part(OfAxes sine) { return 0.5 * (1.0 + end_share_difference(sine)); }

// What the change of that part misses, the outer station's depth being `outer` and the inner one's `inner`.
OfAxes missing_moment(OfAxes sine, OfAxes outer, OfAxes inner) {
  return 0.25 * end_share_slope(sine) * (outer * outer - inner * inner);
}

// The side of the nearest places towards one end of each axis.
struct Side {
  double sense;
  OfAxes end, aside;  // how far the end is, and the next station: the farther foot of the other's ends, or the end
  Stations next;
  OfAxes depth;       // there; 0 where apart
  OfAxes inner;       // the nearest place's part
  OfAxes missing;

  Side(const NearestPlaces &nearest, double towards, OfAxes spacing, double reach, double depth_at_nearest)
      : sense(towards), end(nearest.half - sense * nearest.at) {
    const OfAxes foot = sense * (nearest.foot - nearest.at) + std::fabs(nearest.cosine) * of_the_other(nearest.half);
    aside = least(foot > spacing ? foot : end, end);
    next = stations(nearest, sense * aside);
    const OfAxes rise = sine_within((next.gap - nearest.apart) / greatest(aside, spacing));
    const OfAxes sine = aside > spacing ? rise : both(1.0);  // nothing further on is never deeper
    depth = greatest(reach - next.gap, both(0.0));
    inner = inner_part(sine);
    missing = sense * missing_moment(sine, depth, both(depth_at_nearest));
  }
};

// What the stations of axis `own` beyond its nearest place carry: a point each. `missing` and `load`, so far those of the nearest
// place, receive theirs. A function of its own, for most contacts need none of it.
[[gnu::noinline]] void add_outer(const NearestPlaces &nearest, int own, const Side &before, const Side &behind, double spacing,
                                 double reach, double &missing, double &load, std::vector<ContactPoint> &points) {
  struct Carrier {
    double way, opposite, gap, weight;
  } carriers[4];
  int count = 0;
  const auto add = [&](const Stations &at, double weight) {
    carriers[count++] = {at.way[own], at.opposite[own], at.gap[own], weight};
    load += weight * (reach - at.gap[own]);
  };
  for (const Side *side : {&before, &behind}) {
    if (!(side->depth[own] > 0.0) || !(side->aside[own] > spacing)) continue;
    double beyond = 1.0;
    const double apart = side->end[own] - side->aside[own], inner = side->inner[own];
    if (apart > spacing) {
      const Stations last = stations(nearest, side->sense * side->end);
      const OfAxes depth = greatest(reach - last.gap, both(0.0));
      const OfAxes steeper = sine_within(both((last.gap[own] - side->next.gap[own]) / apart));
      beyond = std::max(inner, inner_part(steeper)[own]);
      missing += side->sense * missing_moment(steeper, depth, side->depth)[own];
      if (depth[own] > 0.0 && beyond < 1.0) add(last, 1.0 - beyond);
    }
    if (beyond > inner) add(side->next, beyond - inner);
  }
  const Vec3 &axis = nearest.axis[own];
  for (int k = 0; k < count; ++k) {
    const Carrier &at = carriers[k];
    const double way_a = own == 0 ? at.way : at.opposite, way_b = own == 0 ? at.opposite : at.way;
    const Vec3 of_a = way_a * nearest.axis[0], of_b = way_b * nearest.axis[1];
    // Of axes that nearly meet the gap is small beside the ways, whose rounding it does not divide out.
    const Vec3 normal = normalized(nearest.apart * nearest.normal + of_a - of_b, nearest.normal);
    const Vec3 middle = nearest.witness + 0.5 * (of_a + of_b) + nearest.radius_difference * (nearest.normal - normal);
    const Vec3 shift = (missing / load) * (axis - dot(axis, normal) * normal);
    points.push_back({reach - at.gap, 0.5 * at.weight, normal, middle + shift});
  }
}

// Appends what the lines of two capsules carry.
inline void carry(const NearestPlaces &nearest, double reach, double depth, std::vector<ContactPoint> &points) {
  const OfAxes spacing = station_spacing * nearest.half;
  const Side before(nearest, -1.0, spacing, reach, depth), behind(nearest, 1.0, spacing, reach, depth);
  // Shares that change with the inclination alone ask for a torque; a shift along the axis supplies it.
  OfAxes missing = before.missing + behind.missing;
  const OfAxes weight = greatest(before.inner + behind.inner - 1.0, both(0.0));
  OfAxes part = both(1.0 / depth);  // of each line's shift
  for (int own = 0; own < 2; ++own) {
    if (!(before.depth[own] + behind.depth[own] > 0.0)) continue;
    double own_missing = missing[own], load = depth * weight[own];
    add_outer(nearest, own, before, behind, spacing[own], reach, own_missing, load, points);
    missing[own] = own_missing;
    part[own] = weight[own] / load;
  }
  // What both lines carry at the nearest places is one point.
  const double sum = weight[0] + weight[1];
  if (!(sum > 0.0)) return;
  const OfAxes shift = missing * part * (1.0 / sum);
  const Vec3 along = shift[0] * nearest.axis[0] + shift[1] * nearest.axis[1];
  ContactPoint &point = points.emplace_back();
  point.depth = depth;
  point.weight = 0.5 * sum;
  point.normal = nearest.normal;
  point.position = nearest.witness + along - dot(along, nearest.normal) * nearest.normal;
}

}  // namespace

bool capsule_on_capsule(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                        std::vector<ContactPoint> &points) {
  const double radius_a = a.body.radius, radius_b = b.body.radius, reach = radius_a + radius_b;
  const double depth = -answer.distance, apart = reach - depth;
  if (!(apart > 1e-9 * reach)) return false;
  const Vec3 axis_a = pose_a.rotation.column(2), axis_b = pose_b.rotation.column(2);
  const Vec3 between = pose_b.translation - pose_a.translation;
  const double lean_a = dot(answer.normal, axis_a), lean_b = -dot(answer.normal, axis_b);
  NearestPlaces nearest{{axis_a, axis_b},
                        OfAxes{a.body.half.z, b.body.half.z},
                        OfAxes{dot(between, axis_a), -dot(between, axis_b)},
                        OfAxes{dot(answer.point_a - pose_a.translation, axis_a) + radius_a * lean_a,
                               dot(answer.point_b - pose_b.translation, axis_b) + radius_b * lean_b},
                        OfAxes{apart * lean_a, apart * lean_b},
                        dot(axis_a, axis_b),
                        apart * apart,
                        apart,
                        answer.normal,
                        0.5 * (answer.point_a + answer.point_b),
                        0.5 * (radius_a - radius_b)};
  carry(nearest, reach, depth, points);
  return true;
}

bool capsule_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, ContactSet &result) {
  const double radius_a = a.body.radius, radius_b = b.body.radius, reach = radius_a + radius_b;
  const Vec3 axis_a = pose_a.rotation.column(2), axis_b = pose_b.rotation.column(2);
  const double half_a = a.body.half.z, half_b = b.body.half.z;
  const Vec3 between = pose_b.translation - pose_a.translation;
  const convex::NearestOnSegments on = convex::nearest_on_segments(axis_a, half_a, axis_b, half_b, between);
  const Vec3 place_a = on.place_a * axis_a, place_b = between + on.place_b * axis_b, gap = place_a - place_b;
  const double apart2 = norm2(gap), apart = std::sqrt(apart2), depth = reach - apart;
  // Deeper, there may be other contact directions; where the axes meet, there is no direction from one to the other.
  if (!(apart > 1e-9 * reach) || 1.5 * depth > reach) return false;
  const Vec3 normal = (1.0 / apart) * gap;
  const Vec3 witness = pose_a.translation + 0.5 * (place_a + place_b) - (0.5 * (radius_a - radius_b)) * normal;
  result.distance = -depth;
  result.normal = normal;
  result.witness = witness;
  if (!(depth > 0.0)) return true;
  const NearestPlaces nearest{{axis_a, axis_b},
                              OfAxes{half_a, half_b},
                              OfAxes{on.foot_a, on.foot_b},
                              OfAxes{on.place_a, on.place_b},
                              OfAxes{on.place_a - (on.place_b * on.cosine + on.foot_a),
                                     on.place_b - (on.place_a * on.cosine + on.foot_b)},
                              on.cosine,
                              apart2,
                              apart,
                              normal,
                              witness,
                              0.5 * (radius_a - radius_b)};
  carry(nearest, reach, depth, result.points);
  return true;
}

}  // namespace cmb
