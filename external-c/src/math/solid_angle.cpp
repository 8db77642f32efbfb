#include "math/solid_angle.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

// Products of complex numbers are scaled where they leave this range.
constexpr double smallest_scale = 1e-100, largest_scale = 1e100;
// Up to this z a direction is horizontal: products of several lengths would underflow.
constexpr double horizontal = 1e-40;

// The direction whose slope is the sum of those of p and q; zero where both are horizontal.
Vec3 sum_of_slopes(const Vec3 &p, const Vec3 &q) {
  return {p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
}

// Solid angle between two horizontal directions, u and v, and a third one, all of any length.
double corner_solid_angle(const Vec3 &u, const Vec3 &v, const Vec3 &top) {
  const double lu = std::sqrt(u.x * u.x + u.y * u.y), lv = std::sqrt(v.x * v.x + v.y * v.y);
  const double beside_u = top.x * u.x + top.y * u.y, beside_v = top.x * v.x + top.y * v.y;
  const double cosine = norm(top) * (lu * lv + u.x * v.x + u.y * v.y) + beside_u * lv + beside_v * lu;
  return 2.0 * std::atan2(top.z * std::fabs(u.x * v.y - u.y * v.x), cosine);
}

}  // namespace

double triangle_solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
  if (numerator == 0.0) return 0.0;
  return std::copysign(2.0 * std::atan2(std::fabs(numerator), denominator), numerator);
}

double parallelogram_solid_angle(const DirectionArc &p, const DirectionArc &q) {
  // A corner between two horizontal directions does not count.
  if (p.reaches_below(horizontal) & q.reaches_below(horizontal)) {
    return corner_solid_angle(p.lower(), q.lower(), sum_of_slopes(p.upper(), q.upper()));
  }
  // The corners in turn, and the two triangles at a diagonal. Their determinants are the parallelogram's area, times
  // heights.
  const Vec3 a = sum_of_slopes(p.first, q.first), b = sum_of_slopes(p.second, q.first);
  const Vec3 c = sum_of_slopes(p.second, q.second), d = sum_of_slopes(p.first, q.second);
  const double area = std::fabs(p.across_x * q.across_y - p.across_y * q.across_x);
  const double la = norm(a), lb = norm(b), lc = norm(c), ld = norm(d);
  const double diagonal = la * lc + dot(a, c);
  const double cosine_b = diagonal * lb + dot(a, b) * lc + dot(b, c) * la;
  const double cosine_d = diagonal * ld + dot(a, d) * lc + dot(c, d) * la;
  const double sine_b = p.second.z * q.first.z * area, sine_d = p.first.z * q.second.z * area;
  return 2.0 * std::atan2(cosine_b * sine_d + sine_b * cosine_d, cosine_b * cosine_d - sine_b * sine_d);
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
  return 2.0 * std::atan2(std::fabs(imaginary), real);
}

}  // namespace cmb
