#include "geometry/solid_angle.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

double triangle_solid_angle(const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
  if (numerator == 0.0) return 0.0;
  return 2.0 * std::atan2(numerator, denominator);
}

void DirectionCone::clip(const Vec3 &normal) {
  if (count_ == 0) return;
  std::array<double, capacity> side;  // only the first count_ are used
  bool cuts = false;
  for (std::size_t i = 0; i < count_; ++i) {
    side[i] = dot(rays_[i], normal);
    cuts = cuts || side[i] < 0.0;
  }
  if (!cuts) return;
  std::array<Vec3, capacity> kept;
  std::size_t count = 0;
  const auto keep = [&](const Vec3 &ray) {
    if (count < capacity) kept[count++] = ray;
  };
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t next = i + 1 < count_ ? i + 1 : 0;
    if (side[i] >= 0.0) keep(rays_[i]);
    if ((side[i] > 0.0 && side[next] < 0.0) || (side[i] < 0.0 && side[next] > 0.0)) {
      const Vec3 ray = std::fabs(side[next]) * rays_[i] + std::fabs(side[i]) * rays_[next];
      const double length = norm(ray);
      if (length > 0.0) keep((1.0 / length) * ray);
    }
  }
  count_ = count < 3 ? 0 : count;
  std::copy_n(kept.begin(), count_, rays_.begin());
}

double DirectionCone::solid_angle() const {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < count_; ++i) sum += triangle_solid_angle(rays_[0], rays_[i], rays_[i + 1]);
  return std::fabs(sum);
}

}  // namespace cmb
