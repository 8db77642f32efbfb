#include "nearby_surface.hpp"

namespace cmb::convex {

void FacetIntegral::add_edge(const Vec3 &p, const Vec3 &q) {
  const Vec3 from = p - foot_, along = q - p;
  const double length2 = norm2(along);
  if (!(length2 > 0.0)) return;
  const double length = std::sqrt(length2);
  const double off = dot(normal_, cross(from, along)) / length;  // of the edge's line from the foot
  const double begin = dot(from, along) / length, end = begin + length;
  const double off2 = off * off;
  if (off2 >= limit2_) {
    if (off < 0.0) outside_ = true;
    add_angle(off, begin, end);
    return;
  }
  all_beyond_ = false;
  const double chord = std::sqrt(limit2_ - off2);
  const double low = std::clamp(begin, -chord, chord), high = std::clamp(end, -chord, chord);
  // By Green's theorem: of the integral of (limit2 - r^2)^2 r dr from the foot, divided by r^2, along the edge.
  const double constant = 3.0 * limit2_ * (limit2_ - off2) + off2 * off2, square = (2.0 * off2 - 3.0 * limit2_) / 3.0;
  const auto antiderivative = [&](double t) { return t * (constant + t * t * (square + 0.2 * t * t)); };
  sum_ += off * (antiderivative(high) - antiderivative(low)) / 6.0;
  if (begin < -chord) add_angle(off, begin, std::min(end, -chord));
  if (end > chord) add_angle(off, std::max(begin, chord), end);
}

// The part of an edge's line from `begin` to `end`, outside the ball, by the angle it fills as seen from the foot.
void FacetIntegral::add_angle(double off, double begin, double end) {
  const double sine = off * (end - begin), cosine = off * off + begin * end;
  if (arcs_ < most_arcs) {
    arc_[arcs_][0] = sine;
    arc_[arcs_++][1] = cosine;
  } else {
    more_angle_ += std::atan2(sine, cosine);
  }
}

double FacetIntegral::value() const {
  const double whole = limit2_ * limit2_ * limit2_ / 6.0;
  if (all_beyond_) return outside_ ? 0.0 : 6.28318530717958648 * whole;
  double angle = more_angle_;
  for (int k = 0; k < arcs_; ++k) angle += std::atan2(arc_[k][0], arc_[k][1]);
  return std::max(0.0, sum_ + whole * angle);
}

// The difference of two boxes is a zonotope: each pair of their six axes spans two of its facets, parallelograms.
Vec3 nearby_surface_of_boxes(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a, double depth, double size) {
  // Boxes with parallel axes have facets in one plane; which of them lies where is decided as if B were turned by a
  // tiny angle about an axis of no special direction.
  constexpr double tiny = 1e-11;
  const Vec3 turn{0.53 * tiny, -0.31 * tiny, 0.79 * tiny};
  Vec3 axis[6], shaken[6];  // half edges
  for (int k = 0; k < 3; ++k) {
    axis[k].set(k, half_a[k]);
    shaken[k] = axis[k];
    axis[3 + k] = half_b[k] * b_in_a.rotation.column(k);
    shaken[3 + k] = axis[3 + k] + cross(turn, axis[3 + k]);
  }
  const double radius = surface_reach(depth, size);
  Vec3 sum;
  for (int p = 0; p < 6; ++p) {
    for (int q = p + 1; q < 6; ++q) {
      const Vec3 across = cross(axis[p], axis[q]);
      const double length2 = norm2(across);
      if (!(length2 > 1e-24 * norm2(axis[p]) * norm2(axis[q]))) continue;  // parallel
      const Vec3 shaken_across = cross(shaken[p], shaken[q]);
      Vec3 offset;  // of the facet's middle from the difference's, on the side of `across`
      for (int k = 0; k < 6; ++k) {
        if (k == p || k == q) continue;
        offset = offset + (dot(shaken_across, shaken[k]) < 0.0 ? -1.0 : 1.0) * axis[k];
      }
      const double reach = dot(across, offset), shift = dot(across, b_in_a.translation);
      // Both sides: the facets' heights times the length of `across`.
      if (std::min(reach - shift, reach + shift) >= radius * std::sqrt(length2)) continue;
      const double length = std::sqrt(length2);
      for (const double side : {1.0, -1.0}) {
        const double height = (reach - side * shift) / length;
        if (!(height < radius)) continue;
        const Vec3 normal = (side / length) * across, middle = side * offset - b_in_a.translation;
        FacetIntegral integral(normal, std::max(height, 0.0), radius);
        if (integral.empty()) continue;
        const Vec3 &u = axis[p], v = side * axis[q];
        const Vec3 corner[4] = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
        for (int k = 0; k < 4; ++k) integral.add_edge(corner[k], corner[(k + 1) % 4]);
        sum = sum + integral.value() * normal;
      }
    }
  }
  return sum;
}

}  // namespace cmb::convex
