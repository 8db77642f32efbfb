#include "geometry/solid_angle.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

// Products of complex numbers are scaled where they leave this range.
constexpr double smallest_scale = 1e-100, largest_scale = 1e100;

}  // namespace

double triangle_solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
  if (numerator == 0.0) return 0.0;
  return 2.0 * std::atan2(numerator, denominator);
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
