#include "narrowphase/smooth/crease_descent.hpp"

namespace cmb::convex {

namespace {

// Turn (rad) to beside a flat end or crease, where only one side of it tells how the support function falls.
constexpr double beside = 1e-8;

// Whether the support function falls from beside m on along `way` (unit, perpendicular to m); `from` is there.
bool falls(const MinkowskiDifference &difference, const Vec3 &m, const Vec3 &way, Vec3 &from) {
  from = normalized(m + beside * way);
  return dot(difference.support(from).w, way - beside * m) < 0.0;
}

// From a flat end on which the other body's farthest point is not: in the direction of that point.
bool leave_flat(const MinkowskiDifference &difference, double rounding, LowestDirection &lowest) {
  const Vec3 m = lowest.direction;
  const DifferencePoint there = difference.support(m);
  const Mat3 &r = difference.b_in_a.rotation;
  for (const bool of_a : {true, false}) {
    const ConvexBody &body = of_a ? difference.body_a : difference.body_b;
    const Vec3 towards = of_a ? m : -transposed_times(r, m);
    const bool has_end = body.core == CoreShape::cylinder || body.core == CoreShape::cone;
    if (!has_end || !(std::fabs(towards.z) > 0.5)) continue;
    const Vec3 point = of_a ? there.b : transposed_times(r, there.a - difference.b_in_a.translation);
    const double across2 = point.x * point.x + point.y * point.y;
    if (!(across2 > body.half.x * body.half.x)) continue;
    const Vec3 outward = (1.0 / std::sqrt(across2)) * Vec3{point.x, point.y, 0.0};
    Vec3 next;
    if (!falls(difference, m, of_a ? outward : -(r * outward), next)) continue;
    newton_on_sphere(difference, next);
    if (lowest.attempt(difference, next, rounding)) return true;
  }
  return false;
}

// The polytope's face that is perpendicular to d (unit), if the vertex v is at such a one.
const Polytope::Face *face_across(const Polytope &polytope, std::int32_t v, const Vec3 &d) {
  constexpr double same2 = 1e-20;
  for (std::int32_t k = polytope.neighbour_begin(v); k < polytope.neighbour_begin(v + 1); ++k) {
    const std::int32_t edge = polytope.neighbour_edges()[static_cast<std::size_t>(k)];
    for (const std::int32_t f : polytope.edges()[static_cast<std::size_t>(edge)].face) {
      const Polytope::Face &face = polytope.faces()[static_cast<std::size_t>(f)];
      if (norm2(face.normal - d) < same2) return &face;
    }
  }
  return nullptr;
}

enum class AtFace { none, within, left };

// From a polytope's face beside which the other body's farthest point is, over the edge that is between; `edge` receives
// that edge's crease. It need not be at the vertex that stands for the face. Within the face all ways lead up.
AtFace leave_face(const MinkowskiDifference &difference, double rounding, LowestDirection &lowest, Crease &edge) {
  const Vec3 m = lowest.direction;
  const DifferencePoint there = difference.support(m);
  const Mat3 &r = difference.b_in_a.rotation;
  for (const bool of_a : {true, false}) {
    const ConvexBody &body = of_a ? difference.body_a : difference.body_b;
    if (body.core != CoreShape::polytope) continue;
    const Polytope &polytope = *body.polytope;
    const std::int32_t vertex = of_a ? there.vertex_a : there.vertex_b;
    const Polytope::Face *face = face_across(polytope, vertex, of_a ? m : -transposed_times(r, m));
    if (face == nullptr) continue;
    const Vec3 point = of_a ? there.b : transposed_times(r, there.a - difference.b_in_a.translation);
    const std::int32_t *const corners = polytope.face_vertices().data() + face->first;
    const auto corner = [&](std::int32_t k) { return polytope.vertices()[static_cast<std::size_t>(corners[k])]; };
    double farthest = 0.0;
    Vec3 along, outward, from = corner(face->count - 1);
    for (std::int32_t k = 0; k < face->count; ++k) {
      const Vec3 to = corner(k), side = normalized(to - from), out = normalized(cross(side, face->normal));
      if (dot(out, point - from) > farthest) farthest = dot(out, point - from), along = side, outward = out;
      from = to;
    }
    if (!(farthest > 0.0)) return AtFace::within;
    edge = of_a ? Crease{along, 0.0, along} : crease_of_other({along, 0.0, along}, r);
    Vec3 next;
    if (!falls(difference, m, of_a ? outward : -(r * outward), next)) continue;
    if (newton_on_crease(difference, edge, next, true) && lowest.attempt(difference, next, rounding, false, &edge)) {
      return AtFace::left;
    }
  }
  return AtFace::none;
}

// To either side of a crease.
bool leave_crease(const MinkowskiDifference &difference, double rounding, LowestDirection &lowest) {
  const Vec3 m = lowest.direction, &axis = lowest.crease[0]->axis;
  const Vec3 across = normalized(axis - dot(axis, m) * m);
  for (const double side : {1.0, -1.0}) {
    Vec3 next;
    if (!falls(difference, m, side * across, next)) continue;
    newton_on_sphere(difference, next);
    if (lowest.attempt(difference, next, rounding)) return true;
  }
  return false;
}

// From where two creases meet along one of them.
bool leave_meeting(const MinkowskiDifference &difference, double rounding, LowestDirection &lowest) {
  const Vec3 m = lowest.direction;
  for (const Crease *crease : {lowest.crease[0], lowest.crease[1]}) {
    const Vec3 along = normalized(cross(crease->axis, m));
    for (const double sense : {1.0, -1.0}) {
      Vec3 next;
      if (!falls(difference, m, sense * along, next) || !newton_on_crease(difference, *crease, next, true)) continue;
      if (lowest.attempt(difference, next, rounding, false, crease)) return true;
    }
  }
  return false;
}

}  // namespace

void descend_from_creases(const MinkowskiDifference &difference, double rounding, LowestDirection &lowest) {
  if (lowest.on_flat) {
    leave_flat(difference, rounding, lowest);
    return;
  }
  Crease edge;
  if (lowest.crease[0] == nullptr || lowest.crease[1] != nullptr) {
    const AtFace at_face = leave_face(difference, rounding, lowest, edge);
    if (at_face == AtFace::within) return;
    if (at_face == AtFace::none && !(lowest.crease[1] != nullptr && leave_meeting(difference, rounding, lowest))) return;
  }
  leave_crease(difference, rounding, lowest);
  lowest.crease[0] = lowest.crease[1] = nullptr;
}

}  // namespace cmb::convex
