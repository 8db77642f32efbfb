#include "narrowphase/interior_ball.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"
#include "shape/face_clusters.hpp"

namespace cmb::convex {

namespace {

// How far a core reaches beyond its supporting plane's point p (outward normal n) in other directions m:
// excess(m) = h(m) - p . m, from below. All of it in the core's frame.
struct Surroundings {
  // A ball of this radius in the core touches the plane at p: excess >= ball (1 - m . n).
  double ball = 0.0;
  // excess >= the quadratic form of m's part in the plane, whose axes are u and v, for every unit m.
  double uu = 0.0, uv = 0.0, vv = 0.0;
  // p - chord n lies in the core.
  double chord = 0.0;
  bool inside = true;  // p lies in the core

  void add(double weight, const Vec3 &e, const Vec3 &u, const Vec3 &v) {
    const double eu = dot(e, u), ev = dot(e, v);
    uu += weight * eu * eu, uv += weight * eu * ev, vv += weight * ev * ev;
  }
};

// How far it is from p against n to where a coordinate p_k leaves [-half, half].
double stretch(double p_k, double half, double n_k) {
  return n_k > 0.0 ? (half + p_k) / n_k : n_k < 0.0 ? (p_k - half) / n_k : INFINITY;
}

// A box. excess = sum of half_k |m_k| - p_k m_k >= sum of (half_k - |p_k|) |m_k|.
void around_box(const Vec3 &half, const Vec3 &p, const Vec3 &n, const Vec3 &u, const Vec3 &v, double slack, Surroundings &s) {
  const Vec3 room{half.x - std::fabs(p.x), half.y - std::fabs(p.y), half.z - std::fabs(p.z)};
  s.inside = room.x >= -slack && room.y >= -slack && room.z >= -slack;
  const Vec3 in{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
  s.ball = in.x >= in.y && in.x >= in.z ? std::min({half.x, room.y, room.z})
           : in.y >= in.z               ? std::min({half.y, room.x, room.z})
                                        : std::min({half.z, room.x, room.y});
  s.uu = room.x * u.x * u.x + room.y * u.y * u.y + room.z * u.z * u.z;
  s.uv = room.x * u.x * v.x + room.y * u.y * v.y + room.z * u.z * v.z;
  s.vv = room.x * v.x * v.x + room.y * v.y * v.y + room.z * v.z * v.z;
  s.chord = std::min({stretch(p.x, half.x, n.x), stretch(p.y, half.y, n.y), stretch(p.z, half.z, n.z)});
}

// A segment along z.
void around_segment(double half, const Vec3 &p, const Vec3 &u, const Vec3 &v, double slack, Surroundings &s) {
  const double room = half - std::fabs(p.z);
  s.inside = room >= -slack;
  s.add(room, {0, 0, 1}, u, v);
}

// excess = |D m| - (D m) . y with D = diag(half) and y = D n / |D n|: at least the square of D m's part perpendicular to y
// over twice the greatest half axis.
void around_ellipsoid(const Vec3 &half, const Vec3 &p, const Vec3 &n, const Vec3 &u, const Vec3 &v, double slack,
                      Surroundings &s) {
  const auto scaled = [&half](const Vec3 &x) { return Vec3{half.x * x.x, half.y * x.y, half.z * x.z}; };
  const double least = std::min({half.x, half.y, half.z}), most = std::max({half.x, half.y, half.z});
  const Vec3 on_sphere{p.x / half.x, p.y / half.y, p.z / half.z}, outwards{n.x / half.x, n.y / half.y, n.z / half.z};
  s.inside = (norm(on_sphere) - 1.0) * most <= slack;
  s.ball = least * least / most;
  const Vec3 y = normalized(scaled(n)), su = scaled(u), sv = scaled(v);
  const Vec3 ru = su - dot(su, y) * y, rv = sv - dot(sv, y) * y;
  const double part = 0.5 / most;
  s.uu = part * norm2(ru), s.uv = part * dot(ru, rv), s.vv = part * norm2(rv);
  // The line's other end, where |on_sphere - chord outwards| is 1 again: near the rim of a plate much shorter than it is thick.
  s.chord = 2.0 * dot(on_sphere, outwards) / norm2(outwards);
}

// The disc of radius r about the z axis: its excess in m is (r - |p|) |m'| + |p| (|m'| - m' . p / |p|), m' being m's part
// across z; the latter is at least half of |p| (m . round)^2, round being the rim's direction.
void add_disc(double radius, double across, const Vec3 &p, const Vec3 &u, const Vec3 &v, Surroundings &s) {
  const double room = radius - across;
  s.add(room, {1, 0, 0}, u, v);
  s.add(room, {0, 1, 0}, u, v);
  if (across > 0.0) s.add(0.5 * across, {-p.y / across, p.x / across, 0}, u, v);
}

void around_cylinder(const Vec3 &half, const Vec3 &p, const Vec3 &n, const Vec3 &u, const Vec3 &v, double slack,
                     Surroundings &s) {
  const double across2 = p.x * p.x + p.y * p.y, across = std::sqrt(across2), n2 = n.x * n.x + n.y * n.y;
  const double room = half.x - across, end_room = half.z - std::fabs(p.z);
  s.inside = room >= -slack && end_room >= -slack;
  s.ball = n2 < 0.5 ? std::min(room, half.z) : std::min(half.x, end_room);
  add_disc(half.x, across, p, u, v, s);
  s.add(end_room, {0, 0, 1}, u, v);
  s.chord = stretch(p.z, half.z, n.z);
  if (n2 > 0.0) {
    const double pn = p.x * n.x + p.y * n.y;
    const double leaves = (pn + std::sqrt(std::max(0.0, pn * pn + n2 * (half.x * half.x - across2)))) / n2;
    s.chord = std::min(s.chord, leaves);
  }
}

void around_cone(const Vec3 &half, const Vec3 &p, const Vec3 &n, const Vec3 &u, const Vec3 &v, double slack,
                 Surroundings &s) {
  const double radius = half.x, height = 2.0 * half.z, above = p.z + half.z;
  const double slant = cone_slant(half), across = std::sqrt(p.x * p.x + p.y * p.y);
  s.inside = above >= -slack && height * across + radius * (above - height) <= slack * slant;
  if (above <= slack) {  // on the base or its rim
    const double along = std::sqrt(n.x * n.x + n.y * n.y), down = -n.z;
    if (along < 0.5) s.ball = std::max(0.0, height * (radius - across) / (radius + slant));
    add_disc(radius, across, p, u, v, s);
    // Against n upwards, to the side beyond the axis or to the nearer one.
    const double closing = radius * down - height * along;
    s.chord = down > 0.0 ? height * (radius + across) / (height * along + radius * down) : 0.0;
    if (closing > 0.0) s.chord = std::min(s.chord, std::max(0.0, height * (radius - across) / closing));
    return;
  }
  // On the side, a part `down` of the way from the apex to the rim.
  if (!(across > 0.0)) return;
  const double down = 1.0 - above / height;
  s.ball = std::min(across * slant / height, above / (1.0 + radius / slant));
  s.chord = 2.0 * s.ball;
  // The farther of the apex and of the disc: in parts down - d and 1 - down + d, or -d.
  const double d = 0.5 * std::min(down, 1.0 - down);
  if (!(d > 0.0)) return;
  const Vec3 ruling{-radius / slant * p.x / across, -radius / slant * p.y / across, height / slant};
  s.add(d * slant, ruling, u, v);
  s.add(0.5 * (down - d) * radius, {-p.y / across, p.x / across, 0}, u, v);
}

// A face of a polytope; its edges and vertices are left to the other body. A ball of twice `enough` will do, and faces that the place is farther
// below than a ball's diameter do not bound it.
void around_polytope(const Polytope &polytope, const Vec3 &p, const Vec3 &n, double enough, double slack, Surroundings &s) {
  constexpr std::size_t size = FaceClusters::size;
  const FaceClusters &clusters = polytope.clusters();
  double ball = 2.0 * std::max(enough, 0.0), least_room = INFINITY;
  clusters.visit_groups_near(p, [&ball] { return 2.0 * ball; }, [&](std::size_t g) {
    const double *const x = clusters.normals(0) + size * g, *const y = clusters.normals(1) + size * g;
    const double *const z = clusters.normals(2) + size * g, *const offset = clusters.offsets() + size * g;
    double room[size], turn[size], beyond[size];
    for (std::size_t k = 0; k < size; ++k) {
      room[k] = offset[k] - (x[k] * p.x + y[k] * p.y + z[k] * p.z);
      turn[k] = 1.0 - (x[k] * n.x + y[k] * n.y + z[k] * n.z);
      beyond[k] = room[k] - ball * turn[k];
    }
    least_room = std::min(least_room, least_of(room, size));
    // Few faces bound the ball more than all before: others need no division.
    if (least_of(beyond, size) >= 0.0) return true;
    for (std::size_t k = 0; k < size; ++k) {
      if (turn[k] > 1e-20 && room[k] < ball * turn[k]) ball = std::max(room[k], 0.0) / turn[k];
    }
    return true;
  });
  s.ball = ball;
  s.inside = least_room >= -slack;
}

Surroundings around(const ConvexBody &body, const Vec3 &p, const Vec3 &n, const Vec3 &u, const Vec3 &v, double enough, double slack) {
  Surroundings s;
  switch (body.core) {
    case CoreShape::point: break;
    case CoreShape::segment: around_segment(body.half.z, p, u, v, slack, s); break;
    case CoreShape::box: around_box(body.half, p, n, u, v, slack, s); break;
    case CoreShape::polytope: around_polytope(*body.polytope, p, n, enough, slack, s); break;
    case CoreShape::ellipsoid: around_ellipsoid(body.half, p, n, u, v, slack, s); break;
    case CoreShape::cylinder: around_cylinder(body.half, p, n, u, v, slack, s); break;
    case CoreShape::cone: around_cone(body.half, p, n, u, v, slack, s); break;
  }
  s.ball = std::max(s.ball, 0.0);
  return s;
}

// The greatest ball for which the quadratic form and the chord answer: with q the form's lesser eigenvalue,
// max(q (1 - x^2), -chord x) >= radius (1 - x) for all x = m . n.
double ball_within(double uu, double uv, double vv, double chord) {
  const double difference = uu - vv, q = 0.5 * (uu + vv - std::sqrt(difference * difference + 4.0 * uv * uv));
  if (!(q > 0.0) || !(chord > 0.0)) return 0.0;
  // Both meet at x = -radius / (chord - radius); the form there: q (1 + x) = radius.
  const double middle = 0.5 * chord + q;
  return q * chord / (middle + std::sqrt(std::max(0.0, middle * middle - q * chord)));
}

}  // namespace

double interior_ball_radius(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &b_in_a, const Vec3 &outward,
                            const Vec3 &a,
                            const Vec3 &b, double enough, double slack) {
  const Vec3 u = any_perpendicular(outward), v = cross(outward, u);
  const Mat3 &r = b_in_a.rotation;
  const auto around_a = [&](double missing) { return around(body_a, a, outward, u, v, missing, slack); };
  const auto around_b = [&](double missing) {
    return around(body_b, transposed_times(r, b - b_in_a.translation), -transposed_times(r, outward), transposed_times(r, u),
                  transposed_times(r, v), missing, slack);
  };
  // A polytope last, which has many faces: most places that do not serve lie outside the other body, and it need have no more than what
  // that one's ball leaves.
  Surroundings of_a, of_b;
  if (body_a.core == CoreShape::polytope) {
    of_b = around_b(enough);
    if (!of_b.inside) return 0.0;
    of_a = around_a(enough - of_b.ball);
    if (!of_a.inside) return 0.0;
  } else {
    of_a = around_a(enough);
    if (!of_a.inside) return 0.0;
    of_b = around_b(enough - of_a.ball);
    if (!of_b.inside) return 0.0;
  }
  const double balls = of_a.ball + of_b.ball;
  if (balls >= enough) return balls;
  const double both = ball_within(of_a.uu + of_b.uu, of_a.uv + of_b.uv, of_a.vv + of_b.vv, of_a.chord + of_b.chord);
  return std::max(balls, both);
}

}  // namespace cmb::convex
