#include "manifold/disc_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/rod_end_share.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

// A rim, as far as another surface lies over it: by the angle t the depth is depth + cosine cos t + sine sin t, and the
// middle between both surfaces likewise.
struct Rim {
  double depth, cosine, sine;
  Vec3 middle, middle_cosine, middle_sine;

  // Of the disc's rim, t counted from `u` to `v` in its plane (both its radius long); the other surface is the plane
  // through `place` perpendicular to `up`; the depth counts along `normal`.
  Rim(const Vec3 &center, const Vec3 &u, const Vec3 &v, const Vec3 &place, const Vec3 &up, const Vec3 &normal) {
    const double facing = 1.0 / dot(up, normal);
    depth = facing * dot(up, place - center), cosine = -facing * dot(up, u), sine = -facing * dot(up, v);
    middle = center + (0.5 * depth) * normal;
    middle_cosine = u + (0.5 * cosine) * normal, middle_sine = v + (0.5 * sine) * normal;
  }
};

// Collects the points of an outline.
class Outline {
 public:
  Outline(const Vec3 &normal, std::vector<ContactPoint> &points) : normal_(normal), points_(points) {}

  // The greatest depth so far.
  double deepest() const { return deepest_; }

  // A corner that turns through an angle.
  void corner(const Vec3 &position, double depth, double turn) {
    deepest_ = std::max(deepest_, depth);
    if (depth > 0.0 && turn > 0.0) points_.push_back({depth, turn / (2.0 * pi), normal_, position});
  }
  void corner(const Rim &rim, double angle, double turn) {
    const double c = std::cos(angle), s = std::sin(angle);
    corner(rim.middle + c * rim.middle_cosine + s * rim.middle_sine, rim.depth + c * rim.cosine + s * rim.sine, turn);
  }

  // The arc of a rim from the angle `begin` to `end` (at most a whole turn).
  void arc(const Rim &rim, double begin, double end) {
    const double swing = std::sqrt(rim.cosine * rim.cosine + rim.sine * rim.sine);
    if (!(end > begin) || rim.depth <= -swing) return;
    // Deep around the angle `deepest`, within `half`.
    double deepest = std::atan2(rim.sine, rim.cosine);
    const auto first_from = [](double angle, double from) {
      return angle + 2.0 * pi * std::ceil((from - angle) / (2.0 * pi));
    };
    if (first_from(deepest, begin) <= end) deepest_ = std::max(deepest_, rim.depth + swing);
    if (rim.depth >= swing) return stretch(rim, end - begin, direction(begin), direction(end));
    const double half = std::acos(-rim.depth / swing);
    for (deepest = first_from(deepest, begin - half); deepest - half < end; deepest += 2.0 * pi) {
      const double from = std::max(begin, deepest - half), to = std::min(end, deepest + half);
      stretch(rim, to - from, direction(from), direction(to));
    }
  }

  // The same in equal pieces (two at least), which keep a body from rocking on a single point.
  void arc_in_pieces(const Rim &rim, double begin, double end, int pieces) {
    const double piece = (end - begin) / pieces, swing2 = rim.cosine * rim.cosine + rim.sine * rim.sine;
    if (!(rim.depth > 0.0 && rim.depth * rim.depth >= swing2)) {
      for (int k = 0; k < pieces; ++k) arc(rim, begin + k * piece, begin + (k + 1) * piece);
      return;
    }
    // All of it is deep.
    const Direction turn = direction(piece);
    Direction from = direction(begin);
    const double swing = std::sqrt(swing2);
    for (int k = 0; k < pieces; ++k) {
      const Direction to{from.c * turn.c - from.s * turn.s, from.s * turn.c + from.c * turn.s};
      if (from.c * rim.sine >= from.s * rim.cosine && to.c * rim.sine <= to.s * rim.cosine) {
        deepest_ = std::max(deepest_, rim.depth + swing);
      }
      stretch(rim, piece, from, to);
      from = to;
    }
  }

 private:
  struct Direction {
    double c, s;
  };
  static Direction direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

  void stretch(const Rim &rim, double length, const Direction &from, const Direction &to) {
    if (!(length > shortest)) return;
    const double c0 = from.c, c1 = to.c, s0 = from.s, s1 = to.s;
    const double squares = 0.5 * (s1 * c1 - s0 * c0), mixed = 0.5 * (s1 * s1 - s0 * s0);
    deepest_ = std::max({deepest_, rim.depth + c0 * rim.cosine + s0 * rim.sine, rim.depth + c1 * rim.cosine + s1 * rim.sine});
    // Integrals of the depth, and of it times cosine, sine, and itself.
    const double sum = rim.depth * length + rim.cosine * (s1 - s0) - rim.sine * (c1 - c0);
    const double by_cosine = rim.depth * (s1 - s0) + rim.cosine * (0.5 * length + squares) + rim.sine * mixed;
    const double by_sine = -rim.depth * (c1 - c0) + rim.cosine * mixed + rim.sine * (0.5 * length - squares);
    const double square = rim.depth * sum + rim.cosine * by_cosine + rim.sine * by_sine;
    if (!(sum > 0.0) || !(square > 0.0)) return;
    points_.push_back({square / sum, sum * sum / (2.0 * pi * square), normal_,
                       rim.middle + (by_cosine / sum) * rim.middle_cosine + (by_sine / sum) * rim.middle_sine});
  }

  static constexpr double shortest = 1e-12;  // rad
  Vec3 normal_;
  std::vector<ContactPoint> &points_;
  double deepest_ = 0.0;
};

// In so many pieces are a whole rim, and each of two arcs; that many points are not merged.
constexpr int rim_pieces = 4, arc_pieces = 3;

}  // namespace

Disc::Disc(const Shape &shape, const Pose &pose, const Vec3 &towards) {
  const Vec3 upper = pose.rotation.column(2);
  axis = shape.kind == ShapeKind::cone || dot(upper, towards) < 0.0 ? -upper : upper;
  center = pose.translation + shape.body.half.z * axis;
  radius = shape.body.half.x;
}

double disc_on_disc(const Disc &a, const Disc &b, const Vec3 &normal, double sense, std::vector<ContactPoint> &points) {
  // Seen along the normal, the first axis from A's middle to B's.
  const Vec3 between = b.center - a.center, level = between - dot(between, normal) * normal;
  const double apart = norm(level);
  if (apart >= a.radius + b.radius) return 0.0;
  constexpr double rounding = 1e-12;  // by the radii: less has no direction, and may lie along the normal
  const Vec3 e1 = apart > rounding * (a.radius + b.radius) ? (1.0 / apart) * level : convex::any_perpendicular(normal);
  const Vec3 e2 = cross(normal, e1);
  const auto in_plane = [&e1, &e2](const Disc &disc, Vec3 &u, Vec3 &v) {
    u = disc.radius * normalized(e1 - dot(e1, disc.axis) * disc.axis);
    v = cross(disc.axis, u);
    if (dot(v, e2) < 0.0) v = -v;
  };
  Vec3 ua, va, ub, vb;
  in_plane(a, ua, va);
  in_plane(b, ub, vb);
  const Rim rim_a(a.center, ua, va, b.center, b.axis, normal);
  const Rim rim_b(b.center, ub, vb, a.center, a.axis, -normal);  // B's depth counts the other way
  Outline outline(sense * normal, points);
  if (apart + a.radius <= b.radius) {
    outline.arc_in_pieces(rim_a, -pi, pi, rim_pieces);
  } else if (apart + b.radius <= a.radius) {
    outline.arc_in_pieces(rim_b, -pi, pi, rim_pieces);
  } else {
    const double along = 0.5 * (apart + (a.radius - b.radius) * (a.radius + b.radius) / apart);
    const double half_a = std::acos(std::clamp(along / a.radius, -1.0, 1.0));
    const double half_b = std::acos(std::clamp((apart - along) / b.radius, -1.0, 1.0));
    outline.arc_in_pieces(rim_a, -half_a, half_a, arc_pieces);
    outline.arc_in_pieces(rim_b, pi - half_b, pi + half_b, arc_pieces);
    for (const double side : {1.0, -1.0}) {  // where the rims cross, seen along the normal: in halves on each
      outline.corner(rim_a, side * half_a, 0.5 * (pi - half_a - half_b));
      outline.corner(rim_b, pi - side * half_b, 0.5 * (pi - half_a - half_b));
    }
  }
  return outline.deepest();
}

}  // namespace cmb
