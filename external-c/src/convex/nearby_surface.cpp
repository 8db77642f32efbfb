#include "nearby_surface.hpp"

#include "angle.hpp"

namespace cmb::convex {

void FacetIntegral::add_edge(const Vec3 &p, const Vec3 &q) {
  const Vec3 from = p - foot_, to = q - foot_, along = q - p;
  const double length2 = norm2(along);
  if (!(length2 > 0.0)) return;
  const double area = dot(normal_, cross(from, along)), begin = dot(from, along), end = begin + length2;
  const double inverse2 = 1.0 / length2, off2 = area * area * inverse2;  // the line's distance from the foot, squared
  if (off2 >= limit2_) {
    if (area < 0.0) outside_ = true;
    add_angle(area, dot(from, to));
    return;
  }
  all_beyond_ = false;
  // By Green's theorem: of the integral of (limit2 - r^2)^2 r dr from the foot, divided by r^2, along the edge.
  const double constant = 3.0 * limit2_ * (limit2_ - off2) + off2 * off2, square = (2.0 * off2 - 3.0 * limit2_) / 3.0;
  const auto antiderivative = [&](double t, double t2) { return t * (constant + t2 * (square + 0.2 * t2)); };
  if (norm2(from) <= limit2_ && norm2(to) <= limit2_) {  // all within the ball: no root is needed
    const double part = antiderivative(end, end * end * inverse2) - antiderivative(begin, begin * begin * inverse2);
    sum_ += area * inverse2 * part / 6.0;
    return;
  }
  const double length = std::sqrt(length2), off = area / length, first = begin / length, last = first + length;
  const double chord = std::sqrt(limit2_ - off2);
  const double low = std::clamp(first, -chord, chord), high = std::clamp(last, -chord, chord);
  sum_ += off * (antiderivative(high, high * high) - antiderivative(low, low * low)) / 6.0;
  if (first < -chord) {
    const double until = std::min(last, -chord);
    add_angle(off * (until - first), off2 + first * until);
  }
  if (last > chord) {
    const double since = std::max(first, chord);
    add_angle(off * (last - since), off2 + since * last);
  }
}

// The part of an edge's line that is outside the ball, by the angle it fills as seen from the foot, given by multiples of
// its sine and cosine: less than half a turn, counted by a product of complex numbers that is watched for passing the
// negative real axis.
void FacetIntegral::add_angle(double sine, double cosine) {
  any_angle_ = true;
  const double real = real_ * cosine - imaginary_ * sine, imaginary = real_ * sine + imaginary_ * cosine;
  if (sine > 0.0 && imaginary_ >= 0.0 && imaginary < 0.0) turns_ += 1.0;
  if (sine < 0.0 && imaginary_ < 0.0 && imaginary >= 0.0) turns_ -= 1.0;
  real_ = real, imaginary_ = imaginary;
  const double scale = std::fabs(real) + std::fabs(imaginary);
  if (!(scale > 1e-100 && scale < 1e100) && scale > 0.0) real_ /= scale, imaginary_ /= scale;
}

double FacetIntegral::value() const {
  constexpr double full_turn = 6.28318530717958648;
  const double whole = limit2_ * limit2_ * limit2_ / 6.0;
  if (all_beyond_) return outside_ ? 0.0 : full_turn * whole;
  if (!any_angle_) return std::max(0.0, sum_);
  const double angle = std::copysign(angle_from_x(real_, std::fabs(imaginary_)), imaginary_);
  return std::max(0.0, sum_ + whole * (full_turn * turns_ + angle));
}

namespace {

// The difference of two boxes is a zonotope: each pair of their six axes spans two of its facets, parallelograms.
class BoxDifference {
 public:
  BoxDifference(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a, double radius)
      : translation_(b_in_a.translation), radius_(radius) {
    // Boxes with parallel axes have facets in one plane; which of them lies where is decided as if B were turned by a
    // tiny angle about an axis of no special direction.
    constexpr double tiny = 1e-11;
    const Vec3 turn{0.53 * tiny, -0.31 * tiny, 0.79 * tiny};
    for (int k = 0; k < 3; ++k) {
      axis_[k].set(k, half_a[k]);
      shaken_[k] = axis_[k];
      axis_[3 + k] = half_b[k] * b_in_a.rotation.column(k);
      shaken_[3 + k] = axis_[3 + k] + cross(turn, axis_[3 + k]);
    }
  }

  // Adds the facets that the axes p and q span.
  void add(int p, int q) {
    const Vec3 across = cross(axis_[p], axis_[q]);
    const double length2 = norm2(across);
    if (!(length2 > 1e-24 * norm2(axis_[p]) * norm2(axis_[q]))) return;  // parallel
    const Vec3 shaken_across = cross(shaken_[p], shaken_[q]);
    Vec3 offset;  // of the facet's middle from the difference's, on the side of `across`
    for (int k = 0; k < 6; ++k) {
      if (k == p || k == q) continue;
      offset = offset + (dot(shaken_across, shaken_[k]) < 0.0 ? -1.0 : 1.0) * axis_[k];
    }
    const double reach = dot(across, offset), shift = dot(across, translation_), length = std::sqrt(length2);
    for (const double side : {1.0, -1.0}) {
      const double height = (reach - side * shift) / length;
      if (!(height < radius_)) continue;
      const Vec3 normal = (side / length) * across, middle = side * offset - translation_;
      FacetIntegral integral(normal, std::max(height, 0.0), radius_);
      if (integral.empty()) continue;
      const Vec3 &u = axis_[p], v = side * axis_[q];
      const Vec3 corner[4] = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
      for (int k = 0; k < 4; ++k) integral.add_edge(corner[k], corner[(k + 1) % 4]);
      sum_ = sum_ + integral.value() * normal;
    }
  }

  const Vec3 &sum() const { return sum_; }

  // The outward normal of the facet that the axes p and q span, on the side that is nearer to the origin; zero where
  // they are parallel.
  Vec3 nearer_normal(int p, int q) const {
    const Vec3 across = cross(axis_[p], axis_[q]);
    const double length2 = norm2(across);
    if (!(length2 > 1e-24 * norm2(axis_[p]) * norm2(axis_[q]))) return {};
    return ((dot(across, translation_) < 0.0 ? -1.0 : 1.0) / std::sqrt(length2)) * across;
  }

 private:
  Vec3 axis_[6], shaken_[6];  // half edges
  Vec3 translation_, sum_;
  double radius_;
};

}  // namespace

Vec3 nearby_surface_of_boxes(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a, double depth, double size) {
  const double radius = surface_reach(depth, size);
  BoxDifference difference(half_a, half_b, b_in_a, radius);
  // Most facets are far away: their heights, as those of the separating axes, are quickly found.
  const Mat3 &r = b_in_a.rotation;
  const Vec3 &t = b_in_a.translation, t_in_b = transposed_times(r, t);
  const double far = radius + 1e-9 * size;
  double absolute[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) absolute[i][j] = std::fabs(r.row[i][j]);
  }
  struct {
    int p, q;
  } near[15];
  int count = 0;
  bool both_sides = false;  // of some pair of facets
  const auto consider = [&](double reach, double shift, double length2, int p, int q) {
    const double gap = reach - std::fabs(shift), other_gap = reach + std::fabs(shift), limit2 = far * far * length2;
    if (gap > 0.0 && gap * gap >= limit2) return;
    both_sides = both_sides || other_gap * other_gap < limit2;
    near[count].p = p, near[count++].q = q;
  };
  constexpr int next[3] = {1, 2, 0};
  for (int i = 0; i < 3; ++i) {
    const int i1 = next[i], i2 = next[i1];
    const double of_b = half_b.x * absolute[i][0] + half_b.y * absolute[i][1] + half_b.z * absolute[i][2];
    const double of_a = half_a.x * absolute[0][i] + half_a.y * absolute[1][i] + half_a.z * absolute[2][i];
    consider(half_a[i] + of_b, t[i], 1.0, i1, i2);
    consider(half_b[i] + of_a, t_in_b[i], 1.0, 3 + i1, 3 + i2);
    for (int j = 0; j < 3; ++j) {
      const int j1 = next[j], j2 = next[j1];
      const double reach = half_a[i1] * absolute[i2][j] + half_a[i2] * absolute[i1][j] + half_b[j1] * absolute[i][j2] +
                           half_b[j2] * absolute[i][j1];
      consider(reach, t[i2] * r.row[i1][j] - t[i1] * r.row[i2][j],
               r.row[i1][j] * r.row[i1][j] + r.row[i2][j] * r.row[i2][j], i, 3 + j);
    }
  }
  // Of facets in one plane the mean is their normal.
  bool one_plane = !both_sides && count > 0;
  const Vec3 first = one_plane ? difference.nearer_normal(near[0].p, near[0].q) : Vec3{};
  for (int k = 1; k < count && one_plane; ++k) {
    const Vec3 normal = difference.nearer_normal(near[k].p, near[k].q);
    one_plane = norm2(normal) == 0.0 || norm2(normal - first) <= same_normal2;
  }
  if (one_plane && norm2(first) > 0.0) return first;
  for (int k = 0; k < count; ++k) difference.add(near[k].p, near[k].q);
  return difference.sum();
}

}  // namespace cmb::convex
