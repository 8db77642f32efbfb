// Independent reference for cores with curved surfaces, in long double: the least value of the
// Minkowski difference's support function, sought over the whole sphere of directions.
//
// The function is smooth but on known circles (edges, the sides of cylinders and cones), so its
// minimum is at a known point, at a crossing of two circles, on a circle or at a smooth place:
// all crossings are tried, circles and sphere are scanned and the best places refined.
#pragma once

#include <array>

#include "reference_distance.hpp"
#include "shape/convex_body.hpp"

namespace reference {

using cmb::convex::ConvexBody;
using cmb::convex::CoreShape;
using cmb::convex::Pose;

struct Circle {
  Point axis;  // unit
  Real height = 0;
};

inline Real core_support_height(const ConvexBody &body, const Point &d) {
  const Real hx = body.half.x, hy = body.half.y, hz = body.half.z;
  switch (body.core) {
    case CoreShape::point: return 0;
    case CoreShape::segment: return hz * std::fabs(d.z);
    case CoreShape::box: return hx * std::fabs(d.x) + hy * std::fabs(d.y) + hz * std::fabs(d.z);
    case CoreShape::ellipsoid: return std::sqrt(hx * hx * d.x * d.x + hy * hy * d.y * d.y + hz * hz * d.z * d.z);
    case CoreShape::cylinder: return hx * std::sqrt(d.x * d.x + d.y * d.y) + hz * std::fabs(d.z);
    case CoreShape::cone: return std::max(hz * d.z, hx * std::sqrt(d.x * d.x + d.y * d.y) - hz * d.z);
    case CoreShape::polytope: {
      Real best = -INFINITY;
      for (const auto &v : body.polytope->vertices()) best = std::max(best, dot(to_point(v), d));
      return best;
    }
  }
  return 0;
}

// How far p lies outside the core; exact to first order near the surface.
inline Real core_outside(const ConvexBody &body, const Point &p) {
  const Real hx = body.half.x, hy = body.half.y, hz = body.half.z;
  const Real across = std::sqrt(p.x * p.x + p.y * p.y);
  switch (body.core) {
    case CoreShape::point: return norm(p);
    case CoreShape::segment: return norm({p.x, p.y, std::max<Real>(0, std::fabs(p.z) - hz)});
    case CoreShape::box: return std::max({std::fabs(p.x) - hx, std::fabs(p.y) - hy, std::fabs(p.z) - hz});
    case CoreShape::ellipsoid: {
      const Point s{p.x / hx, p.y / hy, p.z / hz};
      const Real level = norm(s);
      if (level == 0) return -std::min({hx, hy, hz});
      return (level - 1) * level / norm({s.x / hx, s.y / hy, s.z / hz});
    }
    case CoreShape::cylinder: return std::max(across - hx, std::fabs(p.z) - hz);
    case CoreShape::cone: {
      const Real slant = std::sqrt(hx * hx + 4 * hz * hz);
      return std::max(-hz - p.z, (2 * hz * across + hx * (p.z - hz)) / slant);
    }
    case CoreShape::polytope: {
      Real worst = -INFINITY;
      for (const auto &f : body.polytope->faces()) worst = std::max(worst, dot(to_point(f.normal), p) - Real(f.offset));
      return worst;
    }
  }
  return 0;
}

// All creases and single points of the core's support function.
inline void core_creases(const ConvexBody &body, std::vector<Circle> &circles, std::vector<Point> &points) {
  const Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  switch (body.core) {
    case CoreShape::segment: circles.push_back({z, 0}); break;
    case CoreShape::box:
      for (const Point &e : {x, y, z}) circles.push_back({e, 0});
      break;
    case CoreShape::cylinder:
      circles.push_back({z, 0});
      points.push_back(z);
      points.push_back(Real(-1) * z);
      break;
    case CoreShape::cone: {
      const Real r = body.half.x, length = 2 * Real(body.half.z);
      circles.push_back({z, r / std::sqrt(r * r + length * length)});
      points.push_back(Real(-1) * z);
      break;
    }
    case CoreShape::polytope:
      for (const auto &direction : body.polytope->edge_directions()) circles.push_back({to_point(direction), 0});
      for (const auto &f : body.polytope->faces()) points.push_back(to_point(f.normal));
      break;
    default: break;
  }
}

class SmoothReference {
 public:
  SmoothReference(const ConvexBody &a, const ConvexBody &b, const Pose &pose) : a_(a), b_(b), pose_(pose) {
    std::vector<Circle> of_b;
    std::vector<Point> points_b;
    core_creases(a, circles_, points_);
    core_creases(b, of_b, points_b);
    for (const Circle &c : of_b) circles_.push_back({apply(pose.rotation, c.axis), -c.height});
    for (const Point &p : points_b) points_.push_back(Real(-1) * apply(pose.rotation, p));
  }

  // Support function of A - B (cores) along m / |m|.
  Real height(const Point &m) const {
    const Point n = (1 / norm(m)) * m;
    const Point in_b = Real(-1) * apply_transposed(pose_.rotation, n);
    return core_support_height(a_, n) + core_support_height(b_, in_b) - dot(n, to_point(pose_.translation));
  }

  Real lowest() const {
    Real best = INFINITY;
    const auto attempt = [&](const Point &m) { best = std::min(best, height(m)); };
    for (const Point &p : points_) attempt(p);
    for (std::size_t i = 0; i < circles_.size(); ++i) {
      for (std::size_t j = i + 1; j < circles_.size(); ++j) {
        const Circle &p = circles_[i], &q = circles_[j];
        const Point across = cross(p.axis, q.axis);
        const Real sine2 = dot(across, across), cosine = dot(p.axis, q.axis);
        if (sine2 < Real(1e-24)) continue;
        const Real s = (p.height - cosine * q.height) / sine2, t = (q.height - cosine * p.height) / sine2;
        const Point in_plane = s * p.axis + t * q.axis;
        const Real rest = 1 - dot(in_plane, in_plane);
        if (rest < 0) continue;
        attempt(in_plane + std::sqrt(rest / sine2) * across);
        attempt(in_plane - std::sqrt(rest / sine2) * across);
      }
      best = std::min(best, lowest_on(circles_[i]));
    }
    return std::min(best, lowest_on_sphere());
  }

 private:
  static std::array<Point, 2> basis(const Point &n) {
    const Point helper = std::fabs(n.x) < Real(0.6) ? Point{1, 0, 0} : Point{0, 1, 0};
    Point u = cross(n, helper);
    u = (1 / norm(u)) * u;
    return {u, cross(n, u)};
  }

  Real lowest_on(const Circle &circle) const {
    constexpr int samples = 720;
    const auto [u, v] = basis(circle.axis);
    const Real radius = std::sqrt(1 - circle.height * circle.height), full = 2 * std::acos(Real(-1));
    const auto value = [&, u = u, v = v](Real angle) {
      return height(circle.height * circle.axis + radius * std::cos(angle) * u + radius * std::sin(angle) * v);
    };
    std::vector<Real> scan(samples);
    for (int k = 0; k < samples; ++k) scan[k] = value(full * k / samples);
    Real best = INFINITY;
    const Real least = *std::min_element(scan.begin(), scan.end());
    const Real most = *std::max_element(scan.begin(), scan.end());
    for (int k = 0; k < samples; ++k) {
      if (scan[k] > scan[(k + 1) % samples] || scan[k] > scan[(k + samples - 1) % samples]) continue;
      if (scan[k] > least + Real(0.02) * (most - least)) continue;
      Real low = full * (k - 1) / samples, high = full * (k + 1) / samples;
      constexpr Real golden = 0.6180339887498948482L;
      Real x1 = high - golden * (high - low), x2 = low + golden * (high - low), f1 = value(x1), f2 = value(x2);
      for (int step = 0; step < 60; ++step) {
        if (f1 < f2) {
          high = x2, x2 = x1, f2 = f1, x1 = high - golden * (high - low), f1 = value(x1);
        } else {
          low = x1, x1 = x2, f1 = f2, x2 = low + golden * (high - low), f2 = value(x2);
        }
      }
      best = std::min({best, f1, f2});
    }
    return best;
  }

  Real lowest_on_sphere() const {
    constexpr int samples = 3000;
    std::vector<std::pair<Real, Point>> scan;
    for (int k = 0; k < samples; ++k) {
      const Real z = 1 - (2 * k + Real(1)) / samples, r = std::sqrt(1 - z * z), angle = k * 2.399963229728653L;
      const Point m{r * std::cos(angle), r * std::sin(angle), z};
      scan.push_back({height(m), m});
    }
    std::sort(scan.begin(), scan.end(), [](const auto &p, const auto &q) { return p.first < q.first; });
    std::vector<Point> starts;
    for (const auto &[value, m] : scan) {
      const auto close = [&, m = m](const Point &s) { return dot(s, m) > Real(0.98); };
      if (std::any_of(starts.begin(), starts.end(), close)) continue;
      starts.push_back(m);
      if (starts.size() == 6) break;
    }
    Real best = INFINITY;
    for (Point m : starts) {
      Real here = height(m), step = Real(0.05);
      for (int round = 0; step > Real(1e-11) && round < 2000; ++round) {
        const auto [u, v] = basis(m);
        Point next = m;
        Real lowest = here;
        for (int k = 0; k < 12; ++k) {
          const Real angle = Real(0.5235987755982989L) * k + Real(0.1) * round;
          Point p = m + step * std::cos(angle) * u + step * std::sin(angle) * v;
          p = (1 / norm(p)) * p;
          const Real value = height(p);
          if (value < lowest) lowest = value, next = p;
        }
        if (lowest < here) {
          here = lowest, m = next;
        } else {
          step /= 2;
        }
      }
      best = std::min(best, here);
    }
    return best;
  }

  const ConvexBody &a_, &b_;
  const Pose &pose_;
  std::vector<Circle> circles_;
  std::vector<Point> points_;
};

// Errors of an answer for any pair of bodies; see Errors. `search` looks for deeper minima where the
// cores overlap; without it only the certificate of the answer's own normal is checked there.
inline Errors check_smooth(const ConvexBody &a, const ConvexBody &b, const Pose &pose,
                           const cmb::convex::SignedDistance &answer, bool search) {
  Errors e;
  const Point n = to_point(answer.normal), pa = to_point(answer.point_a), pb = to_point(answer.point_b);
  const Real radii = Real(a.radius) + Real(b.radius), core = Real(answer.distance) + radii;
  const SmoothReference reference(a, b, pose);
  const Real height = reference.height(Real(-1) * n);
  e.normal = std::max(std::fabs(height + core), std::fabs(norm(n) - 1));
  const Point ca = pa + Real(a.radius) * n, cb = pb - Real(b.radius) * n;
  const Point cb_local = apply_transposed(pose.rotation, cb - to_point(pose.translation));
  e.witness = norm(pa - pb - Real(answer.distance) * n);
  e.witness = std::max({e.witness, core_outside(a, ca), core_outside(b, cb_local)});
  if (core > 0) {
    e.distance = std::max(std::fabs(-height - core), std::fabs(norm(ca - cb) - core));
    e.distance = std::max(e.distance, std::max(core_outside(a, ca), core_outside(b, cb_local)));
  } else if (search) {
    // The height along the answer's own normal takes part: the search may end a little above the minimum.
    e.distance = std::fabs(core + std::min(reference.lowest(), height));
  }
  return e;
}

}  // namespace reference
