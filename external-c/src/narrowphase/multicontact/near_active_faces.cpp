#include "narrowphase/multicontact/near_active_faces.hpp"

#include <algorithm>

#include "math/smoothstep.hpp"
#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

namespace {

// A face of a core, in its frame: its outward normal, how far the core reaches along it, and its number.
struct Flat {
  Vec3 normal;
  double reach;
  std::size_t number;
};

template <typename Use>
void for_each_flat(const ConvexBody &body, const Use &use) {
  if (body.core == CoreShape::box) {
    for (std::size_t k = 0; k < 6; ++k) {
      Flat flat{{}, body.half[static_cast<int>(k / 2)], k};
      flat.normal.set(static_cast<int>(k / 2), k % 2 == 0 ? 1.0 : -1.0);
      use(flat);
    }
  } else if (body.core == CoreShape::polytope) {
    const std::vector<Polytope::Face> &faces = body.polytope->faces();
    for (std::size_t k = 0; k < faces.size(); ++k) use(Flat{faces[k].normal, faces[k].offset, k});
  }
}

// How far beside a face a point of its plane is (m), in the core's frame.
double beside(const ConvexBody &body, const Flat &flat, const Vec3 &point) {
  double result = 0.0;
  if (body.core == CoreShape::box) {
    const int axis = static_cast<int>(flat.number / 2);
    for (int k = 0; k < 3; ++k) {
      if (k != axis) result = std::max(result, std::fabs(point[k]) - body.half[k]);
    }
    return result;
  }
  const Polytope::Face &face = body.polytope->faces()[flat.number];
  const std::int32_t *corner = body.polytope->face_vertices().data() + face.first;
  const auto vertex = [&](std::int32_t k) { return body.polytope->vertices()[static_cast<std::size_t>(corner[k])]; };
  Vec3 from = vertex(face.count - 1);
  for (std::int32_t k = 0; k < face.count; ++k) {
    const Vec3 to = vertex(k);
    result = std::max(result, dot(normalized(cross(to - from, face.normal)), point - from));
    from = to;
  }
  return result;
}

// How far the direction `d` (unit, in the core's frame) is from one along which more than a point of a curved core is the
// farthest (rad, or less); a great number where there is none, 0 for other cores.
double from_flush(const ConvexBody &body, const Vec3 &d) {
  const double across = std::sqrt(d.x * d.x + d.y * d.y);
  switch (body.core) {
    case CoreShape::point:
    case CoreShape::ellipsoid: return HUGE_VAL;
    case CoreShape::segment: return std::fabs(d.z);
    case CoreShape::cylinder: return std::min(std::fabs(d.z), across);
    case CoreShape::cone: {
      const double side = std::fabs(2.0 * body.half.z * d.z - body.half.x * across) / cone_slant(body.half);
      return d.z < 0.0 ? std::min(side, across) : side;
    }
    default: return 0.0;
  }
}

}  // namespace

NearActiveFaces::NearActiveFaces(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const ActiveSet &active,
                                 double within) {
  constexpr double flush = 0.1;
  const double swept = a.radius + b.radius, far = active.radius + within - swept;
  const Vec3 &p = active.centre;
  const MinkowskiDifference difference(a, b, b_in_a);
  // The cores' difference reaches along m at least to a known point, which tells most faces off.
  const Vec3 known_a = active.planes[0].a - a.radius * active.planes[0].direction;
  const Vec3 known_b = active.planes[0].b + b.radius * active.planes[0].direction;
  const auto consider = [&](const Flat &flat, const Vec3 &m, bool of_a) {
    const double single = of_a ? from_flush(b, -transposed_times(b_in_a.rotation, m)) : from_flush(a, m);
    if (!(single > 0.0)) return;
    const DifferencePoint there = difference.support(m);
    const double beyond = dot(m, there.w - p);
    if (!(beyond < far)) return;
    // Opposite the curved body's farthest point.
    const Vec3 foot = p + (beyond + swept) * m, core_foot = p + beyond * m;
    const Vec3 on_face = of_a ? there.b + core_foot : b_in_a.inverse()(there.a - core_foot);
    const double gap = std::max(0.0, beyond + swept - active.radius - active.slack);
    const double off = beside(of_a ? a : b, flat, on_face);
    const double part = falling_smoothstep(gap / within) * falling_smoothstep(off / within) * (1.0 - falling_smoothstep(single / flush));
    int k = count_;
    if (count_ < most) {
      ++count_;
    } else {
      k = static_cast<int>(std::max_element(gaps_, gaps_ + most) - gaps_);
      if (!(gap < gaps_[k])) return;
    }
    planes_[k].direction = m, planes_[k].height = dot(m, there.w) + swept, planes_[k].multiplier = 0.0;
    planes_[k].a = of_a ? there.b - b.radius * m + foot : there.a + a.radius * m;
    planes_[k].b = of_a ? there.b - b.radius * m : there.a + a.radius * m - foot;
    gaps_[k] = gap, parts_[k] = part;
  };
  for_each_flat(a, [&](const Flat &flat) {
    if (flat.reach - dot(flat.normal, known_b + p) < far) consider(flat, flat.normal, true);
  });
  for_each_flat(b, [&](const Flat &flat) {
    const Vec3 m = -(b_in_a.rotation * flat.normal);
    if (dot(m, known_a - p - b_in_a.translation) + flat.reach < far) consider(flat, m, false);
  });
}

}  // namespace cmb::convex
