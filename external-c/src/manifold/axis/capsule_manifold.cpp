#include "manifold/axis/capsule_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "manifold/axis/axis_energy.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"

namespace cmb {

namespace {

// The axes of two capsules and the places where they are nearest.
struct NearestPlaces {
  Vec3 axis[2];
  double half[2];
  double at[2];    // the nearest places, along each axis from its middle
  double lean[2];  // the gap's part along each axis, from the other one towards it; 0 but at an end
  double cosine, sine2, reach, depth, apart;
  Vec3 normal;     // from B to A
  Vec3 place[2];   // the nearest places in the world
  double radius[2];
};

// What the axis of one capsule has opposite the axis of the other, measured from the nearest places: `x` along this axis, `y` along
// the other one.
class OppositeAxis {
 public:
  OppositeAxis(const NearestPlaces &nearest, int own)
      : nearest_(nearest), own_(own), other_(1 - own), gap_((own == 0 ? nearest.apart : -nearest.apart) * nearest.normal) {
    const double first = -nearest.half[own] - nearest.at[own], last = nearest.half[own] - nearest.at[own];
    const double low = -nearest.half[other_] - nearest.at[other_], high = nearest.half[other_] - nearest.at[other_];
    // The foot on the other's line is foot + cosine x; between these places it is on the axis itself.
    const double foot = -nearest.lean[other_];
    const double cosine = std::copysign(std::max(std::fabs(nearest.cosine), 1e-200), nearest.cosine);  // not 0
    double from = (low - foot) / cosine, to = (high - foot) / cosine, before = low, behind = high;
    if (from > to) std::swap(from, to), std::swap(before, behind);
    from = std::min(std::max(from, first), last), to = std::min(std::max(to, first), last);
    add_end(before, first, from);
    add_line(foot, from, to);
    add_end(behind, to, last);
  }

  // Appends what the axis carries, half of its energy.
  void carry(std::vector<ContactPoint> &points) const {
    energy_.carry({}, nearest_.axis[own_], nearest_.place[own_], nearest_.radius[own_], 0.5, nearest_.reach, own_ == 0 ? 1.0 : -1.0,
                  points);
  }

 private:
  // The balls from `first` to `last` are nearest to the end `y` of the other axis.
  void add_end(double y, double first, double last) {
    if (!(last > first)) return;
    const double u_lean = nearest_.lean[own_], v_lean = nearest_.lean[other_];
    add(y, 0.0, y * (y + 2.0 * v_lean), u_lean - nearest_.cosine * y, 1.0, first, last);
  }

  // The balls from `first` to `last` are nearest to the line of the other axis.
  void add_line(double foot, double first, double last) {
    if (!(last > first)) return;
    const double u_lean = nearest_.lean[own_], cosine = nearest_.cosine;
    add(foot, cosine, -foot * foot, u_lean - foot * cosine, nearest_.sine2, first, last);
  }

  // The place opposite x is y0 + slope x, and the gap squared apart^2 + constant + 2 linear x + curvature x^2.
  void add(double y0, double slope, double constant, double linear, double curvature, double first, double last) {
    const double shallow = constant - nearest_.depth * (nearest_.reach + nearest_.apart);
    const Vec3 &u = nearest_.axis[own_], &v = nearest_.axis[other_];
    energy_.add_round(gap_ - y0 * v, u - slope * v, shallow, linear, curvature, nearest_.reach, first, last);
  }

  const NearestPlaces &nearest_;
  const int own_, other_;
  const Vec3 gap_;  // from the other's nearest place to this one's
  AxisEnergy energy_;
};

// Appends what the axes of two capsules carry, half of it each.
void carry(const NearestPlaces &nearest, std::vector<ContactPoint> &points) {
  const std::size_t begin = points.size();
  for (int own = 0; own < 2; ++own) OppositeAxis(nearest, own).carry(points);
  if (points.size() > begin) return;
  // As deep as rounding alone.
  const Vec3 surface = nearest.place[0] - (nearest.radius[0] - 0.5 * nearest.depth) * nearest.normal;
  points.push_back({nearest.depth, 1.0, nearest.normal, surface});
}

}  // namespace

bool capsule_on_capsule(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                        std::vector<ContactPoint> &points) {
  const double radius_a = a.body.radius, radius_b = b.body.radius, reach = radius_a + radius_b;
  const double depth = -answer.distance, apart = reach - depth;
  if (!(apart > 1e-9 * reach)) return false;
  const Vec3 axis_a = pose_a.rotation.column(2), axis_b = pose_b.rotation.column(2), &normal = answer.normal;
  const Vec3 place_a = answer.point_a + radius_a * normal, place_b = answer.point_b - radius_b * normal;
  const NearestPlaces nearest{{axis_a, axis_b},
                              {a.body.half.z, b.body.half.z},
                              {dot(place_a - pose_a.translation, axis_a), dot(place_b - pose_b.translation, axis_b)},
                              {apart * dot(normal, axis_a), -apart * dot(normal, axis_b)},
                              dot(axis_a, axis_b),
                              norm2(cross(axis_a, axis_b)),
                              reach,
                              depth,
                              apart,
                              normal,
                              {place_a, place_b},
                              {radius_a, radius_b}};
  carry(nearest, points);
  return true;
}

bool capsule_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, ContactSet &result) {
  const double radius_a = a.body.radius, radius_b = b.body.radius, reach = radius_a + radius_b;
  const Vec3 axis_a = pose_a.rotation.column(2), axis_b = pose_b.rotation.column(2);
  const double half_a = a.body.half.z, half_b = b.body.half.z;
  const Vec3 between = pose_b.translation - pose_a.translation;
  const convex::NearestOnSegments on = convex::nearest_on_segments(axis_a, half_a, axis_b, half_b, between);
  const Vec3 place_a = on.place_a * axis_a, place_b = between + on.place_b * axis_b, gap = place_a - place_b;
  const double apart = norm(gap), depth = reach - apart;
  // Where the axes meet, there is no direction from one to the other.
  if (!(apart > 1e-9 * reach)) return false;
  const Vec3 normal = (1.0 / apart) * gap;
  result.distance = -depth;
  result.normal = normal;
  result.witness = pose_a.translation + 0.5 * (place_a + place_b) - (0.5 * (radius_a - radius_b)) * normal;
  if (!(depth > 0.0)) return true;
  const NearestPlaces nearest{{axis_a, axis_b},
                              {half_a, half_b},
                              {on.place_a, on.place_b},
                              {on.place_a - (on.place_b * on.cosine + on.foot_a),
                               on.place_b - (on.place_a * on.cosine + on.foot_b)},
                              on.cosine,
                              norm2(cross(axis_a, axis_b)),
                              reach,
                              depth,
                              apart,
                              normal,
                              {pose_a.translation + place_a, pose_a.translation + place_b},
                              {radius_a, radius_b}};
  carry(nearest, result.points);
  return true;
}

}  // namespace cmb
