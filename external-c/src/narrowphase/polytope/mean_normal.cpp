#include "narrowphase/polytope/mean_normal.hpp"


namespace cmb::convex {

// The facet's foot is off its plane's origin by the normal alone, so that products with ways in the plane and squares of
// distances follow from the corners themselves. Along the edge's line a place is given by the product with the edge, of which
// the foot's is 0.
void FacetIntegral::add_edge(const Vec3 &p, double p2, const Vec3 &q, double q2) {
  const Vec3 along = q - p;
  const double length2 = norm2(along);
  if (!(length2 > 0.0)) return;
  const double area = dot(normal_, cross(p, along)), area2 = area * area, begin = dot(p, along), end = begin + length2;
  const double limit = limit2_ * length2;
  if (area2 >= limit) {  // the line is outside the ball
    if (area < 0.0) outside_ = true;
    if (!outside_) add_angle(area, p2 - height2_ + begin);
    return;
  }
  all_beyond_ = false;
  const bool within = (p2 <= radius2_) & (q2 <= radius2_);
  const double inverse2 = 1.0 / length2, off2 = area2 * inverse2;  // the line's distance from the foot, squared
  const double chord = within ? 0.0 : std::sqrt(limit - area2);
  const double low = within ? begin : std::clamp(begin, -chord, chord), high = within ? end : std::clamp(end, -chord, chord);
  // By Green's theorem: of the integral of (limit2 - r^2)^2 r dr from the foot, divided by r^2, along the edge.
  const double constant = 3.0 * limit2_ * (limit2_ - off2) + off2 * off2, square = (2.0 * off2 - 3.0 * limit2_) / 3.0;
  const auto antiderivative = [&](double t) {
    const double t2 = t * t * inverse2;
    return t * (constant + t2 * (square + 0.2 * t2));
  };
  sum_ += area * inverse2 * (antiderivative(high) - antiderivative(low)) / 6.0;
  if (within) return;
  if (begin < -chord) {
    const double until = std::min(end, -chord);
    add_angle(area * (until - begin), area2 + begin * until);
  }
  if (end > chord) {
    const double since = std::max(begin, chord);
    add_angle(area * (end - since), area2 + since * end);
  }
}

// The part of an edge's line that is outside the ball, by the angle it fills as seen from the foot, given by multiples of
// its sine and cosine: less than half a turn, counted by a product of complex numbers that is watched for passing the
// negative real axis.
void FacetIntegral::add_angle(double sine, double cosine) {
  any_angle_ = true;
  const double real = real_ * cosine - imaginary_ * sine, imaginary = real_ * sine + imaginary_ * cosine;
  const int forwards = (sine > 0.0) & (imaginary_ >= 0.0) & (imaginary < 0.0);
  const int backwards = (sine < 0.0) & (imaginary_ < 0.0) & (imaginary >= 0.0);
  turns_ += forwards - backwards;
  real_ = real, imaginary_ = imaginary;
  const double scale = std::fabs(real) + std::fabs(imaginary);
  if (!(scale > 1e-100 && scale < 1e100) && scale > 0.0) real_ /= scale, imaginary_ /= scale;
}

double FacetIntegral::value() const {
  constexpr double full_turn = 6.28318530717958648;
  const double whole = limit2_ * limit2_ * limit2_ / 6.0;
  if (outside_) return 0.0;
  if (all_beyond_) return full_turn * whole;
  if (!any_angle_) return std::max(0.0, sum_);
  const double angle = std::copysign(std::atan2(std::fabs(imaginary_), real_), imaginary_);
  return std::max(0.0, sum_ + whole * (full_turn * turns_ + angle));
}

namespace {

// The difference of two boxes is a zonotope: each pair of their six axes spans two of its facets, parallelograms.
class BoxDifference {
 public:
  BoxDifference(const BoxPair &boxes, double radius) : translation_(boxes.b_in_a().translation), radius_(radius) {
    // Boxes with parallel axes have facets in one plane; which of them lies where is decided as if B were turned by a
    // tiny angle about an axis of no special direction.
    constexpr double tiny = 1e-11;
    const Vec3 turn{0.53 * tiny, -0.31 * tiny, 0.79 * tiny};
    for (int k = 0; k < 3; ++k) {
      axis_[k].set(k, boxes.a[k]);
      perturbed_[k] = axis_[k];
      axis_[3 + k] = boxes.b[k] * boxes.b_in_a().rotation.column(k);
      perturbed_[3 + k] = axis_[3 + k] + cross(turn, axis_[3 + k]);
    }
  }

  // Adds the facets that the axes p and q span.
  void add(int p, int q) {
    const Vec3 across = cross(axis_[p], axis_[q]);
    const double length2 = norm2(across);
    if (!(length2 > parallel2 * norm2(axis_[p]) * norm2(axis_[q]))) return;
    const Vec3 perturbed_across = cross(perturbed_[p], perturbed_[q]);
    Vec3 offset;  // of the facet's middle from the difference's, on the side of `across`
    for (int k = 0; k < 6; ++k) {
      if (k == p || k == q) continue;
      offset = offset + (dot(perturbed_across, perturbed_[k]) < 0.0 ? -1.0 : 1.0) * axis_[k];
    }
    const double reach = dot(across, offset), shift = dot(across, translation_), length = std::sqrt(length2);
    for (const double side : {1.0, -1.0}) {
      const double height = (reach - side * shift) / length;
      if (!(height < radius_)) continue;
      add_facet({(side / length) * across, side * offset - translation_, axis_[p], side * axis_[q]}, height, length);
    }
  }

  const Vec3 &sum() const { return sum_; }

  // The square of the sine up to which axes are parallel.
  static constexpr double parallel2 = 1e-24;

 private:
  struct Facet {
    Vec3 normal, middle, u, v;  // half edges u and v
  };

  // A facet whose plane is `height` from the origin, which may be on the wrong side of it; a quarter of its area is `quarter`.
  void add_facet(const Facet &facet, double height, double quarter) {
    const double outward = std::max(height, 0.0), limit2 = radius_ * radius_ - outward * outward;
    const Vec3 to_foot = outward * facet.normal - facet.middle;
    // Whether the ball is beyond one of the two sides along an edge.
    const auto misses = [&](const Vec3 &edge) {
      const double beyond = std::fabs(dot(facet.normal, cross(edge, to_foot))) - quarter;
      return beyond > 0.0 && beyond * beyond >= limit2 * norm2(edge);
    };
    if (misses(facet.u) || misses(facet.v)) return;
    FacetIntegral integral(facet.normal, outward, radius_);
    if (integral.empty()) return;
    const Vec3 sum = facet.u + facet.v, difference = facet.u - facet.v;
    const Vec3 corner[4] = {facet.middle - sum, facet.middle + difference, facet.middle + sum, facet.middle - difference};
    integral.add_rim(4, [&](int k) -> const Vec3 & { return corner[k]; });
    sum_ = sum_ + integral.value() * facet.normal;
  }

  Vec3 axis_[6], perturbed_[6];  // half edges
  Vec3 translation_, sum_;
  double radius_;
};

// Two opposite facets, one of which may be near the origin: the axes that span them, their height seen as that of a
// separating axis, and how far apart the boxes' middles are along it.
struct NearFacets {
  int p, q;
  double shift, length2;

  Vec3 across(const BoxPair &boxes) const {
    if (p < 3 && q >= 3) return boxes.across_direction(p, q - 3);
    const int other = 3 - p % 3 - q % 3;
    if (p >= 3) return boxes.b_in_a().rotation.column(other);
    Vec3 axis;
    axis.set(other, 1.0);
    return axis;
  }
  // The outward normal of the facet that is nearer to the origin.
  Vec3 normal(const BoxPair &boxes) const {
    return ((shift < 0.0 ? -1.0 : 1.0) / std::sqrt(length2)) * across(boxes);
  }
};

// Whether all those facets are in one plane, whose normal is then put down.
bool in_one_plane(const BoxPair &boxes, const NearFacets *near, int count, Vec3 &normal) {
  bool any = false;
  for (int k = 0; k < count; ++k) {
    if (!(near[k].length2 > BoxDifference::parallel2)) continue;
    const Vec3 other = near[k].normal(boxes);
    if (any && !(norm2(other - normal) <= same_normal2)) return false;
    if (!any) normal = other;
    any = true;
  }
  return any;
}

}  // namespace

Vec3 mean_normal_of_boxes(const BoxPair &boxes, const AcrossEdges &edges, double depth, double size) {
  const double radius = averaging_radius(depth, size);
  // Most facets are far away: their heights, as those of the separating axes, are quickly found.
  const double far = radius + 1e-9 * size, far2 = far * far;
  NearFacets near[15];
  int count = 0;
  bool both_sides = false;  // of some pair of facets
  const auto consider = [&](double reach, double shift, double length2, int p, int q) {
    const double gap = reach - std::fabs(shift), other_gap = reach + std::fabs(shift), limit2 = far2 * length2;
    if (gap > 0.0 && gap * gap >= limit2) return;
    both_sides = both_sides || other_gap * other_gap < limit2;
    near[count++] = {p, q, shift, length2};
  };
  for (int i = 0; i < 3; ++i) {
    const int i1 = BoxPair::next[i], i2 = BoxPair::next[i1];
    consider(boxes.a[i] + boxes.reach_of_b[i], boxes.shift_a[i], 1.0, i1, i2);
    consider(boxes.b[i] + boxes.reach_of_a[i], boxes.shift_b[i], 1.0, 3 + i1, 3 + i2);
    for (int j = 0; j < 3; ++j) {
      const auto &across = edges.of[i][j];
      consider(across.reach, across.shift, across.length2, i, 3 + j);
    }
  }
  // Of facets in one plane the mean is their normal.
  Vec3 normal;
  if (!both_sides && in_one_plane(boxes, near, count, normal)) return normal;
  BoxDifference difference(boxes, radius);
  for (int k = 0; k < count; ++k) difference.add(near[k].p, near[k].q);
  return difference.sum();
}

}  // namespace cmb::convex
