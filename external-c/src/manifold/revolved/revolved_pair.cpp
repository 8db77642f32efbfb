#include "manifold/revolved/revolved_pair.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/pi.hpp"
#include "math/trigonometric_polynomial.hpp"

namespace cmb {

namespace {

// A is smaller by this part, so that of equal bodies on one axis, or side by side, it is clear whose surface is within.
constexpr double shrink = 1e-12;

RevolvedBody shrunk(RevolvedBody body) {
  body.radius *= 1.0 - shrink;
  body.half *= 1.0 - shrink;
  return body;
}

// On the way from a body's deepest place in the other one to its middle, half way out of that one.
bool find_inside(const RevolvedBody &body, const Pose &pose, const RevolvedBody &other, const Pose &other_pose, const Vec3 &deepest,
                 Vec3 &place) {
  const Vec3 middle = pose({0.0, 0.0, body.is_cylinder() ? 0.0 : -0.5 * body.half});
  const Vec3 from = transposed_times(other_pose.rotation, deepest - other_pose.translation);
  const Vec3 ray = transposed_times(other_pose.rotation, middle - deepest);
  if (!other.holds(from)) return false;
  bool through_mantle = false;
  place = deepest + (0.5 * std::min(1.0, other.way_out(from, ray, through_mantle))) * (middle - deepest);
  return true;
}

Vec3 place_in_both(const RevolvedBody &a, const Pose &pose_a, const RevolvedBody &b, const Pose &pose_b, const Vec3 &deepest_a,
                   const Vec3 &deepest_b) {
  Vec3 place;
  if (find_inside(a, pose_a, b, pose_b, deepest_a, place) || find_inside(b, pose_b, a, pose_a, deepest_b, place)) return place;
  return 0.5 * (deepest_a + deepest_b);
}

// Whether rounding of places that are known by the bodies' size counts. What pushes its sides is greater than the load by how wide it is beside
// its thickness.
bool is_thin(const OverlapSurface &surface, double size) {
  constexpr double rounding = 1e-15, counts = 1e-8;
  const double thickness = surface.volume() / std::min(surface.area_a(), surface.area_b());
  return rounding * size * std::sqrt(surface.spread().trace()) > counts * thickness * thickness;
}

}  // namespace

RevolvedPair::Side::Side(const RevolvedBody &of, const Pose &in_common, bool to_apex, bool is_fitted, std::vector<BorderPlace> &border,
                         OverlapSurface::Nodes &nodes)
    : body(of),
      pose(in_common),
      mantle(body, in_common, {}, to_apex, Mantle::Partner::revolved, border, nodes, is_fitted),
      fan{{-in_common.rotation.column(2), {}, of.half - dot(in_common.rotation.column(2), in_common.translation), nodes},
          {in_common.rotation.column(2), {}, of.half + dot(in_common.rotation.column(2), in_common.translation), nodes}} {}

bool RevolvedPair::find(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &deepest_a, const Vec3 &deepest_b,
                        OverlapSurface &surface) {
  // The better, the nearer its places are.
  const Vec3 place = place_in_both(a, {}, b, b_in_a, deepest_a, deepest_b);
  fitted_ = nullptr;
  const bool is_known = find_from(a, b, b_in_a, place, surface);
  if (is_known && !is_thin(surface, a.radius + a.half + b.radius + b.half)) return true;
  fitted_ = &edge_;
  if (!is_known && !find_from(a, b, b_in_a, place, surface)) return false;
  return find_from(a, b, b_in_a, surface.place() + surface.middle(), surface);
}

bool RevolvedPair::find_from(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &place, OverlapSurface &surface) {
  const Pose a_in_b = b_in_a.inverse();
  const bool apex_a = !a.is_cylinder() && b.holds(a_in_b({0.0, 0.0, a.half}));
  const bool apex_b = !b.is_cylinder() && a.holds(b_in_a({0.0, 0.0, b.half}));
  const bool found = integrate(a, b, b_in_a, place, apex_a, apex_b, surface);
  // Where the border as good as turns in an apex that is outside, more than the overlap's is added and taken off: so much counts by rounding.
  constexpr double cancels = 3.0;
  const double area_a = surface.area_a(), area_b = surface.area_b();
  const bool from_apex_a = !a.is_cylinder() && !apex_a && area_a > cancels * area_b;
  const bool from_apex_b = !b.is_cylinder() && !apex_b && area_b > cancels * area_a;
  if (!from_apex_a && !from_apex_b) return found;
  std::swap(surface, before_);
  const bool found_from_apex = integrate(a, b, b_in_a, place, apex_a || from_apex_a, apex_b || from_apex_b, surface);
  if (surface.area_a() + surface.area_b() < area_a + area_b) return found_from_apex;
  std::swap(surface, before_);
  return found;
}

bool RevolvedPair::integrate(const RevolvedBody &a, const RevolvedBody &b, const Pose &b_in_a, const Vec3 &place, bool apex_a, bool apex_b,
                             OverlapSurface &surface) {
  surface.start(place);
  const Pose a_in_b = b_in_a.inverse();
  Side side_a(shrunk(a), {Pose().rotation, -place}, apex_a, fitted_ != nullptr, of_a_.border, surface.of_a());
  Side side_b(b, {b_in_a.rotation, b_in_a.translation - place}, apex_b, fitted_ != nullptr, of_b_.border, surface.of_b());
  edge_.clear();
  const auto start = [this](Side &side, Borders &borders, Side &other, const Pose &in_other) {
    for (const End end : {base, top}) {
      const Vec3 normal = (end == base ? -1.0 : 1.0) * in_other.rotation.column(2);
      borders.section[end].start(other.mantle, normal, dot(normal, in_other({0.0, 0.0, side.height(end)})), fitted_);
      borders.rim[end].start(side.mantle, end, fitted_);
    }
  };
  start(side_a, of_a_, side_b, a_in_b);
  start(side_b, of_b_, side_a, b_in_a);
  corners_.clear();
  for (const End end_a : {base, top}) {
    for (const End end_b : {base, top}) {
      if (side_a.has(end_a) && side_b.has(end_b)) add_chord(side_a, of_a_, end_a, side_b, of_b_, end_b);
    }
  }
  for (const End end : {base, top}) {
    if (side_a.has(end)) add_rim_passages(side_a, of_a_, end, side_b, a_in_b);
    if (side_b.has(end)) add_rim_passages(side_b, of_b_, end, side_a, b_in_a);
  }
  if (!follow_ends(side_a, of_a_, side_b) || !follow_ends(side_b, of_b_, side_a)) return false;
  follow_crossing(side_a, side_b, b_in_a);
  side_a.mantle.integrate();
  side_b.mantle.integrate();
  return surface.sum();
}

// The line of two ends' planes, as far as it is in both.
void RevolvedPair::add_chord(Side &a, Borders &borders_a, End end_a, Side &b, Borders &borders_b, End end_b) const {
  const Vec3 &normal_a = a.fan[end_a].normal(), &normal_b = b.fan[end_b].normal();
  const Vec3 line = cross(normal_a, normal_b);  // counter-clockwise about A's end
  const double sine = norm(line);
  if (!(sine > 1e-14)) return;
  const Vec3 along = (1.0 / sine) * line, across = cross(along, normal_a);  // in A's end, out of B
  const Vec3 center_a = a.center(end_a), center_b = b.center(end_b);
  const double aside = dot(normal_b, center_b - center_a) / dot(normal_b, across), half2_a = a.body.radius * a.body.radius - aside * aside;
  if (!(half2_a > 0.0)) return;
  const Vec3 middle = center_a + aside * across, way = center_b - middle;
  const double place_b = dot(way, along), half2_b = b.body.radius * b.body.radius - (norm2(way) - place_b * place_b);
  if (!(half2_b > 0.0)) return;
  const double half_a = std::sqrt(half2_a), half_b = std::sqrt(half2_b);
  const double from = std::max(-half_a, place_b - half_b), to = std::min(half_a, place_b + half_b);
  if (!(from < to)) return;
  Vec3 first = middle + from * along, last = middle + to * along;
  const bool first_on_rim_a = -half_a > place_b - half_b, last_on_rim_a = half_a < place_b + half_b;
  if (fitted_ != nullptr) {
    const double most = EdgePlaces::most_off * (a.body.radius + b.body.radius);
    move_onto(a.fan[end_a], b.fan[end_b], first_on_rim_a ? a.mantle : b.mantle, most, first);
    move_onto(a.fan[end_a], b.fan[end_b], last_on_rim_a ? a.mantle : b.mantle, most, last);
  }
  a.fan[end_a].add_segment(first, last);
  b.fan[end_b].add_segment(last, first);
  // Each end of the chord is on one rim, and on the other body's end goes over to a conic on that rim's mantle.
  const auto pass = [&](const Vec3 &at, bool on_rim_a, bool chord_ends) {
    if (on_rim_a) {
      borders_a.rim[end_a].add_passage(a.in_frame(at), chord_ends, at);
      borders_b.section[end_b].add_passage(a.in_frame(at), !chord_ends, at);
    } else {
      borders_a.section[end_a].add_passage(b.in_frame(at), chord_ends, at);
      borders_b.rim[end_b].add_passage(b.in_frame(at), !chord_ends, at);
    }
  };
  pass(first, first_on_rim_a, false);
  pass(last, last_on_rim_a, true);
}

// Where a rim passes the other body's mantle: a trigonometric polynomial of the second degree changes its sign. Angles from where the other body
// is, and beyond a right angle from the other side.
void RevolvedPair::add_rim_passages(Side &side, Borders &borders, End end, const Side &other, const Pose &in_other) {
  const Vec3 center = in_other({0.0, 0.0, side.height(end)}), u = in_other.rotation.column(0), v = in_other.rotation.column(1);
  const double radius = side.body.radius, slope = other.body.slope, at_center = other.body.radius_at(center.z);
  // Mostly it is clear that it does not.
  constexpr double rounding = 1e-9;
  const double rise2 = radius * radius * (u.z * u.z + v.z * v.z), above = std::fabs(center.z) - other.body.half;
  const double beside = std::sqrt(center.x * center.x + center.y * center.y) - radius - other.body.radius;
  if (beside > rounding * radius || (above > rounding * radius && above * above > (1.0 + rounding) * rise2)) return;
  const auto product = [slope](const Vec3 &p, const Vec3 &q) { return p.x * q.x + p.y * q.y - slope * slope * p.z * q.z; };
  const auto slant = [&](const Vec3 &p) { return center.x * p.x + center.y * p.y - at_center * slope * p.z; };
  const double toward = std::atan2(-slant(v), -slant(u));
  for (const double begin : {toward, toward + pi}) {
    const Vec3 out = std::cos(begin) * u + std::sin(begin) * v, on = std::cos(begin) * v - std::sin(begin) * u;
    const double sine = 2.0 * radius * slant(on), square = radius * radius;
    const double cosine2 = 0.5 * square * (product(out, out) - product(on, on)), sine2 = square * product(out, on);
    const double front = other.body.beyond_mantle(center + radius * out), back = other.body.beyond_mantle(center - radius * out);
    const double constant = 0.5 * (front + back) - cosine2;
    const TrigonometricPolynomial beyond{constant, 0.5 * (front - back), sine, cosine2, sine2};
    double angles[4];
    const int count = beyond.sign_changes_ahead(angles);
    for (int k = 0; k < count; ++k) {
      double angle = angles[k], growth = 0.0;
      Vec3 at;
      const auto look = [&] {
        const Vec3 outward = std::cos(angle) * out + std::sin(angle) * on, around = std::cos(angle) * on - std::sin(angle) * out;
        at = center + radius * outward;
        growth = at.x * around.x + at.y * around.y - other.body.radius_at(at.z) * slope * around.z;
      };
      look();
      // Of a flat cone terms are great that cancel: where they do they are known better.
      const double nearer = 0.5 * other.body.beyond_mantle(at) / (radius * growth);
      if (std::fabs(nearer) < 1e-6) angle -= nearer, look();
      if (std::fabs(at.z) > other.body.half) continue;
      const bool enters = (growth < 0.0) == (end == top);  // counter-clockwise about the end
      Vec3 common = other.pose(at);
      if (fitted_ != nullptr) {
        move_onto(side.fan[end], side.mantle, other.mantle, EdgePlaces::most_off * (side.body.radius + other.body.radius), common);
        at = other.in_frame(common);
      }
      borders.rim[end].add_passage(side.in_frame(common), enters, common);
      borders.section[end].add_passage(at, !enters, common);
      corners_.push_back(common);
    }
  }
}

bool RevolvedPair::follow_ends(Side &side, Borders &borders, const Side &other) {
  for (const End end : {base, top}) {
    PlaneFan &fan = side.fan[end];
    const auto in_end = [&](const Vec3 &in_other) {
      return norm2(other.pose(in_other) - side.center(end)) <= side.body.radius * side.body.radius;
    };
    const auto in_other = [&](const Vec3 &in_frame) { return other.holds(side.pose(in_frame)); };
    if (side.has(end) && !borders.section[end].follow(fan, in_end)) return false;
    if (!borders.rim[end].follow(fan, in_other)) return false;
  }
  return true;
}

void RevolvedPair::follow_crossing(Side &a, Side &b, const Pose &b_in_a) {
  // Of cones that whose apex is nearer to the other mantle: so what little there is about an apex is known by its own size.
  const auto beyond_apex = [](const Side &side, const Side &in) {
    if (side.body.is_cylinder()) return HUGE_VAL;
    const Vec3 apex = in.in_frame(side.pose({0.0, 0.0, side.body.half}));
    return std::fabs(in.body.beyond_mantle(apex)) * in.body.across * in.body.across;
  };
  const bool b_is_ruled = beyond_apex(b, a) < beyond_apex(a, b);
  Side &ruled = b_is_ruled ? b : a, &other = b_is_ruled ? a : b;
  MantleCrossing crossing(ruled.mantle, other.mantle, b_is_ruled ? b_in_a : b_in_a.inverse(), cuts_, fitted_);
  for (const Vec3 &corner : corners_) crossing.add_corner(ruled.in_frame(corner), corner);
  crossing.follow();
}

}  // namespace cmb
