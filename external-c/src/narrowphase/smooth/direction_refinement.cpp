#include "narrowphase/smooth/direction_refinement.hpp"

#include <algorithm>

#include "narrowphase/analytic/closed_form_distance.hpp"
#include "narrowphase/smooth/crease_descent.hpp"
#include "narrowphase/smooth/direction_newton.hpp"

namespace cmb::convex {

namespace {

// The creases and flat ends of a body near a direction, in A's frame.
struct Creases {
  static constexpr int capacity = 6;
  Crease crease[capacity];
  int count = 0;
  Vec3 flat[2];  // directions whose farthest points are a flat disc
  int flat_count = 0;

  void add(const Crease &c) {
    if (count < capacity) crease[count++] = c;
  }
};

// Of the core itself; `d` unit in its frame.
Creases core_creases(const ConvexBody &body, const Vec3 &d, double angle) {
  Creases result;
  const Vec3 z{0, 0, 1};
  const double across = std::sqrt(d.x * d.x + d.y * d.y);
  switch (body.core) {
    case CoreShape::point:
    case CoreShape::ellipsoid: break;
    case CoreShape::segment:
      if (std::fabs(d.z) < angle) result.add({z, 0.0, z});
      break;
    case CoreShape::box:
      for (int k = 0; k < 3; ++k) {
        Vec3 e;
        e.set(k, 1.0);
        if (std::fabs(d[k]) < angle) result.add({e, 0.0, e});
      }
      break;
    case CoreShape::polytope: {
      const Polytope &p = *body.polytope;
      const std::int32_t v = p.support_vertex(d);
      for (std::int32_t k = p.neighbour_begin(v); k < p.neighbour_begin(v + 1); ++k) {
        const Vec3 &e = p.edge_directions()[static_cast<std::size_t>(p.neighbour_edges()[static_cast<std::size_t>(k)])];
        if (std::fabs(dot(d, e)) < angle) result.add({e, 0.0, e});
      }
      break;
    }
    case CoreShape::cylinder:
      if (std::fabs(d.z) < angle) result.add({z, 0.0, z});
      if (across < angle) result.flat[result.flat_count++] = {0, 0, std::copysign(1.0, d.z)};
      break;
    case CoreShape::cone: {
      const double slant = cone_slant(body.half);
      const double height = body.half.x / slant;  // of the side's normals
      if (std::fabs(d.z - height) < angle && across > 0.0) {
        const Vec3 ruling{body.half.x * d.x / across, body.half.x * d.y / across, -2.0 * body.half.z};
        result.add({z, height, (1.0 / slant) * ruling});
      }
      if (across < angle && d.z < 0.0) result.flat[result.flat_count++] = {0, 0, -1};
      break;
    }
  }
  return result;
}

Creases creases_of_a(const MinkowskiDifference &difference, const Vec3 &m, double angle) {
  return core_creases(difference.body_a, m, angle);
}

Creases creases_of_b(const MinkowskiDifference &difference, const Vec3 &m, double angle) {
  const Mat3 &r = difference.b_in_a.rotation;
  Creases result = core_creases(difference.body_b, -transposed_times(r, m), angle);
  for (int k = 0; k < result.count; ++k) {
    Crease &c = result.crease[k];
    c = crease_of_other(c, r);
  }
  for (int k = 0; k < result.flat_count; ++k) result.flat[k] = -(r * result.flat[k]);
  return result;
}

// How far a point is outside of A, and that less `step` outside of B.
double missing(const MinkowskiDifference &difference, const Vec3 &a, const Vec3 &step) {
  const Vec3 b_local = transposed_times(difference.b_in_a.rotation, a - step - difference.b_in_a.translation);
  return outside_planes(difference.body_a, a) + outside_planes(difference.body_b, b_local);
}

// Witness points for the final direction.
void find_witness(const MinkowskiDifference &difference, RefinedDirection &result, const Vec3 &a_before) {
  constexpr double angle = 1e-7;
  const Vec3 &m = result.direction;
  const DifferencePoint p = difference.support(m);
  const Creases ca = creases_of_a(difference, m, angle), cb = creases_of_b(difference, m, angle);
  if (ca.count == 0 && ca.flat_count == 0) {
    result.a = p.a;  // A has one farthest point
  } else if (cb.count == 0 && cb.flat_count == 0) {
    result.a = p.b + result.height * m;
  } else {
    const bool line_a = ca.count == 1 && ca.flat_count == 0, line_b = cb.count == 1 && cb.flat_count == 0;
    const Vec3 &along_a = ca.crease[0].line, &along_b = cb.crease[0].line;
    const Vec3 side = cross(along_b, m);
    const double slope = dot(along_a, side);
    if (line_a && line_b && std::fabs(slope) > 1e-3) {
      result.a = p.a + (dot(p.b - p.a, side) / slope) * along_a;  // where B's line crosses A's, seen along m
    } else if (line_a && line_b) {
      // Nearly parallel: a point of A's line if it is B's too, else where they cross, or one of them ends.
      const Vec3 ahead = p.a + dot(a_before - p.a, along_a) * along_a;
      result.a = ahead;
      double least = missing(difference, ahead, result.height * m);
      const auto consider = [&](const Vec3 &candidate) {
        if (!(least > 1e-15 * difference.scale)) return;
        const double there = missing(difference, candidate, result.height * m);
        if (there < least) least = there, result.a = candidate;
      };
      if (std::fabs(slope) > 1e-12) consider(p.a + (dot(p.b - p.a, side) / slope) * along_a);
      consider(p.a);
      consider(p.b + result.height * m);
    } else if (line_a) {
      result.a = p.a + dot(a_before - p.a, along_a) * along_a;
    } else if (line_b) {
      result.a = p.b + dot(a_before - p.b, along_b) * along_b + result.height * m;
    } else {
      result.a = a_before + (dot(p.a, m) - dot(a_before, m)) * m;
    }
  }
  result.b = result.a - result.height * m;
}

}  // namespace

bool creases_nearby(const MinkowskiDifference &difference, const Vec3 &direction, double nearby) {
  constexpr double on_border = 1e-9;
  const auto among = [&direction](const Creases &creases) {
    for (int k = 0; k < creases.count; ++k) {
      if (std::fabs(dot(direction, creases.crease[k].axis) - creases.crease[k].height) > on_border) return true;
    }
    for (int k = 0; k < creases.flat_count; ++k) {
      if (norm2(direction - creases.flat[k]) > on_border * on_border) return true;
    }
    return false;
  };
  return among(creases_of_a(difference, direction, nearby)) ||
         among(creases_of_b(difference, direction, nearby));
}

RefinedDirection refine_direction(const MinkowskiDifference &difference, const Vec3 &direction, const Vec3 &a,
                                  const Vec3 &b, double nearby, bool from_afar) {
  LowestDirection lowest{direction, dot(difference.support(direction).w, direction), false, {}};
  const double rounding = 1e-15 * difference.scale;
  Creases all = creases_of_a(difference, direction, nearby);
  const Creases of_b = creases_of_b(difference, direction, nearby);
  for (const Creases *of_one : {static_cast<const Creases *>(&all), &of_b}) {
    for (const Vec3 *flat = of_one->flat; flat != of_one->flat + of_one->flat_count; ++flat) {
      lowest.attempt(difference, *flat, rounding, true);
    }
  }
  for (int k = 0; k < of_b.count; ++k) all.add(of_b.crease[k]);
  Vec3 m = direction;
  newton_on_sphere(difference, m);  // where it does not converge, as in a valley all round, it is lower all the same
  lowest.attempt(difference, m, rounding);
  for (int k = 0; k < all.count; ++k) {
    // All of a crease is equally low where both bodies are of revolution about its axis.
    m = direction;
    if (!project_on_crease(all.crease[k], m)) continue;
    lowest.attempt(difference, m, rounding, false, &all.crease[k]);
    if (newton_on_crease(difference, all.crease[k], m, from_afar)) {
      lowest.attempt(difference, m, rounding, false, &all.crease[k]);
    }
  }
  for (int k = 0; k < all.count; ++k) {
    for (int l = k + 1; l < all.count; ++l) {
      m = direction;
      if (!meeting_point(all.crease[k], all.crease[l], m)) continue;
      lowest.attempt(difference, m, rounding, false, &all.crease[k], &all.crease[l]);
    }
  }
  descend_from_creases(difference, rounding, lowest);
  RefinedDirection result{lowest.direction, dot(difference.support(lowest.direction).w, lowest.direction), a, b};
  find_witness(difference, result, a);
  return result;
}

}  // namespace cmb::convex
