#include "narrowphase/multicontact/cone_ring.hpp"

#include <algorithm>

#include "math/pi.hpp"

namespace cmb::convex {

namespace {

// How far a ball's centre is from its place on the axis at most, relative to the size.
constexpr double on_axis = 1e-10;
// The cosine of the angle between a gap's middle and a direction in it, from which on its chord is not in that direction.
constexpr double least_facing = 1e-6;

// Calls use(neighbour) with those of a core's corner, all in the core's frame.
template <typename Use>
void for_each_neighbour(const ConvexBody &body, const SupportPoint &corner, const Use &use) {
  switch (body.core) {
    case CoreShape::segment: use(SupportPoint{-corner.point, 1 - corner.vertex}); break;
    case CoreShape::box:
      for (int k = 0; k < 3; ++k) {
        SupportPoint neighbour{corner.point, corner.vertex ^ (1 << k)};
        neighbour.point.set(k, -corner.point[k]);
        use(neighbour);
      }
      break;
    case CoreShape::polytope:
      for (std::int32_t k = body.polytope->neighbour_begin(corner.vertex),
                        end = body.polytope->neighbour_begin(corner.vertex + 1);
           k < end; ++k) {
        const std::int32_t neighbour = body.polytope->neighbours()[static_cast<std::size_t>(k)];
        use(SupportPoint{body.polytope->vertices()[static_cast<std::size_t>(neighbour)], neighbour});
      }
      break;
    default: break;
  }
}

// The ring of the cone's outward directions: rise along its axis and `across` it, at an angle about it.
struct Ring {
  double rise, across;

  explicit Ring(const Vec3 &half) : rise(half.x / cone_slant(half)), across(2.0 * half.z / cone_slant(half)) {}
  Vec3 direction(double angle) const { return {across * std::cos(angle), across * std::sin(angle), rise}; }
};

// Angles in which another place is farther than the corner: those within `half` of the middle.
struct Arc {
  double middle, half;
};

// A stretch of angles without places; `open` where there is one.
struct Gap {
  bool open = false;
  double low = 0.0, high = 0.0;
};

// The arcs that the surface about a corner removes of a ring.
class Gaps {
 public:
  // Leaves the directions whose product with `way`, in the cone's frame, is at least `least`. False where there are none.
  bool add(const Ring &ring, const Vec3 &way, double least) {
    const double swing = ring.across * std::sqrt(way.x * way.x + way.y * way.y), level = ring.rise * way.z - least;
    if (level >= swing) return true;
    if (level <= -swing || count_ == most) return false;
    arcs_[count_++] = {std::atan2(-way.y, -way.x), std::acos(level / swing)};
    return true;
  }

  // The gap that an angle lies in; false where that is all of the ring.
  bool at(double angle, Gap &gap) const {
    gap = {false, angle, angle};
    for (bool grown = true; grown && gap.high - gap.low < 2.0 * pi;) {
      grown = false;
      for (const Arc *arc = arcs_; arc != arcs_ + count_; ++arc) {
        const double nearest = std::round((0.5 * (gap.low + gap.high) - arc->middle) / (2.0 * pi));
        for (const double turns : {nearest, nearest - 1.0, nearest + 1.0}) {
          const double low = arc->middle + 2.0 * pi * turns - arc->half, high = arc->middle + 2.0 * pi * turns + arc->half;
          if (!(low < gap.high && high > gap.low) || (low >= gap.low && high <= gap.high)) continue;
          gap = {true, std::min(low, gap.low), std::max(high, gap.high)};
          grown = true;
        }
      }
    }
    return gap.high - gap.low < 2.0 * pi;
  }

 private:
  static constexpr int most = 64;
  Arc arcs_[most];
  int count_ = 0;
};

// Where the ray from the axis at an angle leaves the convex hull of the ring's places, as a part of the ring's radius,
// and the one or two places there with their parts.
struct Rim {
  double part = 1.0;
  double angle[2], share[2] = {1.0, 0.0};
  int count = 1;

  bool find(const Gaps &gaps, double at) {
    Gap gap;
    if (!gaps.at(at, gap)) return false;
    angle[0] = at;
    if (!gap.open) return true;
    const double middle = 0.5 * (gap.low + gap.high), half = 0.5 * (gap.high - gap.low), facing = std::cos(at - middle);
    if (!(facing > least_facing) || !(half > 0.0)) return false;
    part = std::cos(half) / facing;
    const double aside = std::clamp(part * std::sin(at - middle) / std::sin(half), -1.0, 1.0);
    angle[0] = gap.low, angle[1] = gap.high;
    share[0] = 0.5 * (1.0 - aside), share[1] = 0.5 * (1.0 + aside);
    count = 2;
    return true;
  }
};

// A corner of the core at `place`, in its frame, to `slack` (m), if it is among the farthest along d.
bool find_corner(const ConvexBody &body, const Vec3 &d, const Vec3 &place, double slack, SupportPoint &corner) {
  const SupportPoint farthest = body.core == CoreShape::cone ? SupportPoint{{0, 0, body.half.z}, 0} : core_support(body, d);
  bool found = false;
  const auto consider = [&](const SupportPoint &candidate) {
    if (found || !(norm2(candidate.point - place) <= slack * slack)) return;
    found = true;
    corner = candidate;
  };
  consider(farthest);
  for_each_neighbour(body, farthest, consider);  // as far, to rounding, at an end of the ring
  return found;
}

// The cone is A's where `of_a`.
bool replace_by_ring_of(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, bool of_a, double size,
                        ActiveSet &active) {
  const ConvexBody &cone = of_a ? a : b, &other = of_a ? b : a;
  const double core_radius = active.radius - a.radius - b.radius;
  const bool has_corners = is_polyhedral(other.core) || other.core == CoreShape::cone;
  if (cone.core != CoreShape::cone || !has_corners || !(core_radius > 0.0)) return false;
  // Directions out of the cone are C's outward ones, or, where the cone is B's, against these.
  const double sense = of_a ? 1.0 : -1.0;
  const Mat3 to_a, &b_to_a = b_in_a.rotation, &from_cone = of_a ? to_a : b_to_a, &from_other = of_a ? b_to_a : to_a;
  const Ring ring(cone.half);
  // Where the corner must be: the ball's centre is below the tip of C on the axis.
  const Vec3 apex = of_a ? Vec3{0, 0, cone.half.z} : b_in_a({0, 0, cone.half.z});
  const Vec3 place = apex - sense * active.centre - (core_radius / ring.rise) * from_cone.column(2);
  const Vec3 place_in_other = of_a ? b_in_a.inverse()(place) : place;
  SupportPoint corner;
  int meeting = 0;
  while (meeting < active.count && !find_corner(other, -sense * transposed_times(from_other, active.planes[meeting].direction),
                                                place_in_other, on_axis * size, corner)) {
    ++meeting;
  }
  if (meeting == active.count) return false;
  Gaps gaps;
  bool some = true;
  for_each_neighbour(other, corner, [&](const SupportPoint &neighbour) {
    some = some && gaps.add(ring, transposed_times(from_cone, from_other * (neighbour.point - corner.point)), 0.0);
  });
  if (other.core == CoreShape::cone) {
    some = gaps.add(ring, transposed_times(from_cone, -from_other.column(2)), Ring(other.half).rise);
  }
  if (!some) return false;
  // The load, out of the cone, as the ring's places bear it: how much in all, and the middle of it.
  const Vec3 load = -sense * transposed_times(from_cone, active.centre);
  const double total = load.z / ring.rise, aside = std::sqrt(load.x * load.x + load.y * load.y);
  if (!(total > 0.0)) return false;
  const double middle = aside / (total * ring.across), angle = std::atan2(load.y, load.x);
  Rim near, far;
  if (!near.find(gaps, angle) || !far.find(gaps, angle + pi) || !(near.part + far.part > 0.0)) return false;
  const double of_near = std::clamp((middle + far.part) / (near.part + far.part), 0.0, 1.0);
  active.count = 0;
  const auto add = [&](const Rim &rim, double of_rim) {
    for (int end = 0; end < rim.count; ++end) {
      const double borne = total * of_rim * rim.share[end];
      if (!(borne > 0.0)) continue;
      SupportingPlane &plane = active.planes[active.count++];
      plane.direction = sense * (from_cone * ring.direction(rim.angle[end]));
      plane.height = dot(plane.direction, active.centre) + active.radius;
      const Vec3 on_core = active.centre + core_radius * plane.direction;
      plane.a = (of_a ? place + on_core : place) + a.radius * plane.direction;
      plane.b = (of_a ? place : place - on_core) - b.radius * plane.direction;
      plane.multiplier = borne;
    }
  };
  add(near, of_near);
  add(far, 1.0 - of_near);
  active.on_cone_ring = true;
  return true;
}

}  // namespace

bool replace_by_cone_ring(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, ActiveSet &active) {
  return active.count > 1 && (replace_by_ring_of(a, b, b_in_a, true, size, active) || replace_by_ring_of(a, b, b_in_a,
                                                                                                         false, size, active));
}

}  // namespace cmb::convex
