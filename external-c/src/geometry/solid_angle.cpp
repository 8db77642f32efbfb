#include "geometry/solid_angle.hpp"

#include <algorithm>
#include <cmath>

#include "convex/angle.hpp"

namespace cmb {

using convex::angle_from_x;

namespace {

// Products of complex numbers are scaled where they leave this range.
constexpr double smallest_scale = 1e-100, largest_scale = 1e100;
// Squares of lengths below which products of several would underflow.
constexpr double smallest_length2 = 1e-80;

// The direction whose slope is the sum of those of p and q; zero where both are horizontal.
Vec3 sum_of_slopes(const Vec3 &p, const Vec3 &q) {
  return {p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
}

}  // namespace

double triangle_solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
  if (numerator == 0.0) return 0.0;
  return std::copysign(2.0 * angle_from_x(denominator, std::fabs(numerator)), numerator);
}

double parallelogram_solid_angle(const DirectionArc &p, const DirectionArc &q) {
  // The corners in turn, and the two triangles at a diagonal. Their determinants are the parallelogram's area, times
  // heights.
  const Vec3 a = sum_of_slopes(p.first, q.first), b = sum_of_slopes(p.second, q.first);
  const Vec3 c = sum_of_slopes(p.second, q.second), d = sum_of_slopes(p.first, q.second);
  const double area = std::fabs(p.across_x * q.across_y - p.across_y * q.across_x);
  const double a2 = norm2(a), b2 = norm2(b), c2 = norm2(c), d2 = norm2(d);
  if (!(std::min(std::min(a2, b2), std::min(c2, d2)) > smallest_length2)) {
    // A corner between two horizontal directions does not count; there is one at most.
    if (!(a2 > smallest_length2)) return std::fabs(triangle_solid_angle(b, c, d));
    if (!(b2 > smallest_length2)) return std::fabs(triangle_solid_angle(a, c, d));
    if (!(c2 > smallest_length2)) return std::fabs(triangle_solid_angle(a, b, d));
    return std::fabs(triangle_solid_angle(a, b, c));
  }
  const double la = std::sqrt(a2), lb = std::sqrt(b2), lc = std::sqrt(c2), ld = std::sqrt(d2);
  const double diagonal = la * lc + dot(a, c);
  const double cosine_b = diagonal * lb + dot(a, b) * lc + dot(b, c) * la;
  const double cosine_d = diagonal * ld + dot(a, d) * lc + dot(c, d) * la;
  const double sine_b = p.second.z * q.first.z * area, sine_d = p.first.z * q.second.z * area;
  return 2.0 * angle_from_x(cosine_b * cosine_d - sine_b * sine_d, cosine_b * sine_d + sine_b * cosine_d);
}

double DirectionCone::solid_angle() const {
  if (count_ < 3) return 0.0;
  // The triangles' half angles add up to no more than pi: the product of the complex numbers that have them as
  // arguments takes one arc tangent for all.
  double real = 1.0, imaginary = 0.0;
  const double length0 = norm(rays_[0]);
  double length1 = norm(rays_[1]), cosine01 = dot(rays_[0], rays_[1]);
  for (std::size_t i = 1; i + 1 < count_; ++i) {
    const Vec3 &a = rays_[0], &b = rays_[i], &c = rays_[i + 1];
    const double length2 = norm(c), cosine02 = dot(a, c);
    const double sine = std::fabs(dot(a, cross(b, c)));
    const double cosine = length0 * length1 * length2 + cosine01 * length2 + cosine02 * length1 + dot(b, c) * length0;
    const double next = real * cosine - imaginary * sine;
    imaginary = real * sine + imaginary * cosine;
    real = next;
    const double scale = std::fabs(real) + std::fabs(imaginary);
    if (!(scale > smallest_scale && scale < largest_scale)) {
      if (!(scale > 0.0)) return 0.0;
      real /= scale;
      imaginary /= scale;
    }
    length1 = length2;
    cosine01 = cosine02;
  }
  return 2.0 * angle_from_x(real, std::fabs(imaginary));
}

}  // namespace cmb
