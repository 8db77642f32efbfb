#include "volume/slices/conic_section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/polynomial_roots.hpp"

namespace cmb::overlap {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Roots of a s^2 + 2 b s + c, `root` being that of b^2 - a c: (-b - root)/a and (-b + root)/a, without loss of digits.
double lower_root(double a, double b, double c, double root) { return b >= 0.0 ? -(b + root) / a : c / (root - b); }
double upper_root(double a, double b, double c, double root) { return b <= 0.0 ? (root - b) / a : -c / (b + root); }

}  // namespace

Stretch Quadric::stretch(const Vec3 &f, const Vec3 &e) const {
  const double a = product(e, e), b = product(e, f), c = product(f, f) - level;
  const Vec3 across = cross(e, f);
  const double squared = level * a - (across.z * across.z + third * (across.x * across.x + across.y * across.y));
  if (third >= 0.0) {
    if (!(a > 0.0)) return c <= 0.0 ? Stretch{-infinity, infinity} : Stretch{};
    if (!(squared > 0.0)) return {};
    const double root = std::sqrt(squared);
    return {lower_root(a, b, c, root), upper_root(a, b, c, root)};
  }
  if (a > 0.0) {
    if (!(squared > 0.0) || f.z * a - e.z * b > 0.0) return {};  // the other nappe
    const double root = std::sqrt(squared);
    return {lower_root(a, b, c, root), upper_root(a, b, c, root)};
  }
  const double root = std::sqrt(std::max(0.0, squared));
  if (e.z > 0.0) return {-infinity, upper_root(a, b, c, root)};
  if (e.z < 0.0) return {lower_root(a, b, c, root), infinity};
  return {};
}

Conic::Conic(const Quadric &q, double y, double low, double high) {
  const Vec3 f = q.origin + y * q.y;
  one_nappe_ = q.third < 0.0;
  axial0_ = f.z, axial_x_ = q.x.z, axial_z_ = q.z.z;
  a_ = q.product(q.z, q.z);
  b0_ = q.product(q.z, f), b1_ = q.product(q.z, q.x);
  c0_ = q.product(f, f) - q.level, c1_ = q.product(f, q.x), c2_ = q.product(q.x, q.x);
  // D by Lagrange's identity, without cancellation.
  const Vec3 g0 = cross(q.z, f), g1 = cross(q.z, q.x);
  const auto sum = [&](const Vec3 &g, const Vec3 &h) { return g.z * h.z + q.third * (g.x * h.x + g.y * h.y); };
  d0_ = q.level * a_ - sum(g0, g0), d1_ = -sum(g0, g1), d2_ = -sum(g1, g1);
  classify(low, high);
}

void Conic::classify(double low, double high) {
  const double width = std::max(std::fabs(low), std::fabs(high));
  if (!one_nappe_ && !(a_ > 1e-28 * (std::fabs(c2_) + 1.0 / (width * width)))) {
    // Along a cylinder's axis.
    kind_ = Kind::wall;
    const double squared = c1_ * c1_ - c2_ * c0_;
    if (c2_ * width * width <= 1e-28) {
      if (c0_ > 0.0) kind_ = Kind::empty;
      reach_ = {low, high};
    } else if (!(squared > 0.0)) {
      kind_ = Kind::empty;
    } else {
      const double root = std::sqrt(squared);
      end_[0] = lower_root(c2_, c1_, c0_, root), end_[1] = upper_root(c2_, c1_, c0_, root);
      reach_ = {std::max(low, end_[0]), std::min(high, end_[1])};
    }
    return;
  }
  const double quadratic = std::fabs(d2_) * width * width, linear = std::fabs(d1_) * width;
  if (quadratic <= 1e-14 * (linear + std::fabs(d0_))) {
    if (linear <= 1e-14 * std::fabs(d0_)) {
      kind_ = d0_ > 0.0 ? Kind::level : Kind::empty;
      reach_ = {low, high};
      return;
    }
    kind_ = Kind::parabola;
    end_[0] = -0.5 * d0_ / d1_;
    from_left_ = d1_ > 0.0;
  } else {
    const double squared = d1_ * d1_ - d0_ * d2_;
    if (d2_ < 0.0) {
      if (!(squared > 0.0)) return;
      kind_ = Kind::ellipse;
    } else if (!(squared > 0.0) || a_ <= 0.0) {
      kind_ = Kind::open_hyperbola;
      end_[0] = -d1_ / d2_;
      size_ = std::sqrt(std::max(0.0, -squared)) / d2_;
      size_ = std::max(size_, 1e-15 * width);
      reach_ = {low, high};
      return;
    } else {
      kind_ = Kind::hyperbola;
    }
    const double root = std::sqrt(squared), first = lower_root(d2_, d1_, d0_, root), second = upper_root(d2_, d1_, d0_, root);
    end_[0] = std::min(first, second), end_[1] = std::max(first, second);
    size_ = 2.0 * root / std::fabs(d2_);
    if (kind_ == Kind::hyperbola) {
      // One branch a nappe, left and right.
      const double middle = -b_at(end_[1]) / a_;
      from_left_ = axial0_ + axial_x_ * end_[1] + axial_z_ * middle <= 0.0;
      if (from_left_) end_[0] = end_[1];
    }
  }
  if (kind_ == Kind::ellipse) {
    reach_ = {std::max(low, end_[0]), std::min(high, end_[1])};
  } else {
    reach_ = from_left_ ? Stretch{std::max(low, end_[0]), high} : Stretch{low, std::min(high, end_[0])};
  }
  if (one_nappe_ && a_ > 0.0) {
    const double middle = -b_at(end_[0]) / a_;
    if (axial0_ + axial_x_ * end_[0] + axial_z_ * middle > 0.0) kind_ = Kind::empty;
  }
  if (reach_.empty()) kind_ = Kind::empty;
}

double Conic::side(bool upper, double x, double root) const {
  return upper ? upper_root(a_, b_at(x), c_at(x), root) : lower_root(a_, b_at(x), c_at(x), root);
}

Stretch Conic::at(double x) const {
  if (kind_ == Kind::empty || x < reach_.begin || x > reach_.end) return {};
  if (kind_ == Kind::wall) return {-infinity, infinity};
  const double root = std::sqrt(std::max(0.0, d0_ + x * (2.0 * d1_ + x * d2_)));
  if (a_ > 0.0) return {side(false, x, root), side(true, x, root)};
  if (axial_z_ > 0.0) return {-infinity, side(true, x, root)};
  return {side(false, x, root), infinity};
}

int Conic::ends(double *x) const {
  switch (kind_) {
    case Kind::ellipse: x[0] = end_[0], x[1] = end_[1]; return 2;
    case Kind::wall: x[0] = reach_.begin, x[1] = reach_.end; return 2;
    case Kind::hyperbola:
    case Kind::parabola: x[0] = end_[0]; return 1;
    default: return 0;
  }
}

int Conic::crossings(const Conic &other, double low, double high, double *x) const {
  low = std::max({low, reach_.begin, other.reach_.begin});
  high = std::min({high, reach_.end, other.reach_.end});
  if (!(low < high) || kind_ == Kind::wall || other.kind_ == Kind::wall) return 0;
  // Polynomials of u, x = middle + half u.
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  struct Shifted {
    double a, b[2], c[3];
  };
  const auto shifted = [&](const Conic &q) {
    const double scale = 1.0 / std::max({std::fabs(q.a_), std::fabs(q.b_at(middle)), std::fabs(q.b1_ * half),
                                         std::fabs(q.c_at(middle)), std::fabs(q.c2_ * half * half), 1e-300});
    return Shifted{scale * q.a_,
                   {scale * q.b_at(middle), scale * q.b1_ * half},
                   {scale * q.c_at(middle), scale * 2.0 * half * (q.c1_ + q.c2_ * middle), scale * q.c2_ * half * half}};
  };
  const Shifted p = shifted(*this), q = shifted(other);
  // The resultant of both quadratics of z.
  double first[3], second[2], third[4] = {0, 0, 0, 0};
  for (int i = 0; i < 3; ++i) first[i] = p.a * q.c[i] - q.a * p.c[i];
  for (int i = 0; i < 2; ++i) second[i] = p.a * q.b[i] - q.a * p.b[i];
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) third[i + j] += p.b[i] * q.c[j] - q.b[i] * p.c[j];
  }
  double resultant[5] = {0, 0, 0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) resultant[i + j] += first[i] * first[j];
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 4; ++j) resultant[i + j] -= 4.0 * second[i] * third[j];
  }
  // Where both upper and both lower sides meet above each other it has a double root, and does not change its sign.
  double slope[4];
  for (int k = 1; k < 5; ++k) slope[k - 1] = k * resultant[k];
  int count = sign_changes(resultant, 4, -1.0, 1.0, x);
  count += sign_changes(slope, 3, -1.0, 1.0, x + count);
  for (int k = 0; k < count; ++k) x[k] = middle + half * x[k];
  return count;
}

}  // namespace cmb::overlap
