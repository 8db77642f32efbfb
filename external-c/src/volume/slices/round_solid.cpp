#include "volume/slices/round_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmb::overlap {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The quadric whose axes are the columns of `axes`, stretched by `scale`, about `center`.
Quadric quadric_of(const Mat3 &axes, const Vec3 &scale, const Vec3 &center, double third, double level) {
  const Mat3 rows{{scale.x * axes.column(0), scale.y * axes.column(1), scale.z * axes.column(2)}};
  Quadric result;
  result.x = rows.column(0), result.y = rows.column(1), result.z = rows.column(2);
  result.origin = -(rows * center);
  result.third = third, result.level = level;
  return result;
}

Stretch common(const Stretch &a, const Stretch &b) { return {std::max(a.begin, b.begin), std::min(a.end, b.end)}; }

// Where low <= at + s slope <= high.
Stretch between(double at, double slope, double low, double high) {
  if (slope == 0.0) return at >= low && at <= high ? Stretch{-infinity, infinity} : Stretch{};
  const double s = (low - at) / slope, t = (high - at) / slope;
  return {std::min(s, t), std::max(s, t)};
}

}  // namespace

RoundSolid::RoundSolid(const Shape &shape, const Pose &pose)
    : kind_(shape.kind), center_(pose.translation), axis_(pose.rotation.column(2)), half_length_(shape.body.half.z) {
  const Vec3 &half = shape.body.half;
  const double radius = shape.body.radius;
  Vec3 reach;
  switch (kind_) {
    case ShapeKind::sphere:
    case ShapeKind::ellipsoid: {
      const Vec3 semi = kind_ == ShapeKind::sphere ? Vec3{radius, radius, radius} : half;
      pieces_ = 1;
      quadric_[0] = quadric_of(pose.rotation, {1.0 / semi.x, 1.0 / semi.y, 1.0 / semi.z}, center_, 1.0, 1.0);
      for (int k = 0; k < 3; ++k) {
        const Vec3 &row = pose.rotation.row[k];
        reach.set(k, norm(Vec3{semi.x * row.x, semi.y * row.y, semi.z * row.z}));
      }
      break;
    }
    case ShapeKind::capsule:
    case ShapeKind::cylinder: {
      const double r = kind_ == ShapeKind::capsule ? radius : half.x;
      pieces_ = 1;
      quadric_[0] = quadric_of(pose.rotation, {1.0 / r, 1.0 / r, 0.0}, center_, 0.0, 1.0);
      for (int k = 0; k < 3; ++k) {
        const Vec3 &row = pose.rotation.row[k];
        const double aside = kind_ == ShapeKind::capsule ? 1.0 : std::hypot(row.x, row.y);
        reach.set(k, std::fabs(row.z) * half_length_ + aside * r);
      }
      if (kind_ == ShapeKind::cylinder) break;
      pieces_ = 3;
      for (int end = 0; end < 2; ++end) {
        quadric_[static_cast<std::size_t>(1 + end)] =
            quadric_of(pose.rotation, {1.0 / r, 1.0 / r, 1.0 / r}, center_ + ((2 * end - 1) * half_length_) * axis_, 1.0, 1.0);
      }
      break;
    }
    case ShapeKind::cone: {
      pieces_ = 1;
      apex_ = center_ + half_length_ * axis_;
      const double length = 2.0 * half_length_;
      quadric_[0] = quadric_of(pose.rotation, {1.0 / half.x, 1.0 / half.x, 1.0 / length}, apex_, -1.0, 0.0);
      for (int k = 0; k < 3; ++k) {
        const Vec3 &row = pose.rotation.row[k];
        const double base = half.x * std::hypot(row.x, row.y), middle = row.z * half_length_;
        low_.set(k, std::min(middle, -middle - base));
        high_.set(k, std::max(middle, -middle + base));
      }
      low_ = center_ + low_, high_ = center_ + high_;
      return;
    }
    default: return;
  }
  low_ = center_ - reach, high_ = center_ + reach;
}

Stretch RoundSolid::stretch(const Vec3 &p, const Vec3 &d) const {
  const auto of = [&](int k) {
    const Quadric &q = quadric_[static_cast<std::size_t>(k)];
    return q.stretch(q.at(p), q.along(d));
  };
  Stretch result = of(0);
  if (kind_ != ShapeKind::capsule) return result;
  result = common(result, between(dot(axis_, p - center_), dot(axis_, d), -half_length_, half_length_));
  for (int k = 1; k < pieces_; ++k) {
    const Stretch end = of(k);
    if (end.empty()) continue;
    result = result.empty() ? end : Stretch{std::min(result.begin, end.begin), std::max(result.end, end.end)};
  }
  return result;
}

bool RoundSolid::point_in_plane(const Vec3 &normal, double offset, Vec3 &point) const {
  // Along the axis, or from the farthest point one way to that the other way.
  Vec3 way = axis_;
  if (kind_ == ShapeKind::sphere || kind_ == ShapeKind::ellipsoid) {
    // The surface's farthest point: M^-1 normal, M = F^T F.
    const Quadric &q = quadric_[0];
    const Vec3 rows[3] = {{q.x.x, q.y.x, q.z.x}, {q.x.y, q.y.y, q.z.y}, {q.x.z, q.y.z, q.z.z}};
    way = {};
    for (const Vec3 &row : rows) way = way + (dot(row, normal) / (norm2(row) * norm2(row))) * row;
  } else if (kind_ == ShapeKind::capsule) {
    const double radius = 1.0 / norm(quadric_[1].x);
    const double along = dot(axis_, normal);
    way = (along < 0.0 ? -half_length_ : half_length_) * axis_ + (radius / norm(normal)) * normal;
  }
  const double slope = dot(way, normal);
  if (slope == 0.0) return false;
  point = center_ + ((offset - dot(normal, center_)) / slope) * way;
  const Stretch inside = stretch(point, {0.0, 0.0, 1.0});
  return inside.begin < 0.0 && inside.end > 0.0;
}

RoundSection::RoundSection(const RoundSolid &solid, double y, double low, double high) : solid_(&solid), y_(y) {
  for (int k = 0; k < solid.pieces_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    conic_[i] = Conic(solid.quadric_[i], y, low, high);
  }
}

int RoundSection::joints(double *x) const {
  if (solid_->kind_ != ShapeKind::capsule) return 0;
  // Both ends of the side lie in planes, of which the section sees lines.
  const Vec3 &axis = solid_->axis_;
  const double squared = axis.x * axis.x + axis.z * axis.z;
  if (!(squared > 1e-24)) return 0;
  const Quadric &side = solid_->quadric_[0];
  const Vec3 direction{-axis.z, 0.0, axis.x};
  int count = 0;
  for (const double end : {-1.0, 1.0}) {
    const double off = dot(axis, solid_->center_) + end * solid_->half_length_ - axis.y * y_;
    const Vec3 origin{off / squared * axis.x, y_, off / squared * axis.z};
    const Stretch inside = side.stretch(side.at(origin), side.along(direction));
    if (inside.empty()) continue;
    x[count++] = origin.x + inside.begin * direction.x;
    x[count++] = origin.x + inside.end * direction.x;
  }
  return count;
}

RoundSection::Sides RoundSection::at(double x) const {
  if (solid_->kind_ != ShapeKind::capsule) return {conic_[0].at(x), 0, 0};
  Sides result;
  result.z = {infinity, -infinity};
  for (int k = 2; k >= 0; --k) {
    Stretch z = conic_[static_cast<std::size_t>(k)].at(x);
    if (z.empty()) continue;
    if (k == 0) {
      const Vec3 &axis = solid_->axis_;
      z = common(z, between(dot(axis, Vec3{x, y_, 0.0} - solid_->center_), axis.z, -solid_->half_length_,
                            solid_->half_length_));
      if (z.empty()) continue;
    }
    if (z.begin < result.z.begin) result.z.begin = z.begin, result.lower = k;
    if (z.end > result.z.end) result.z.end = z.end, result.upper = k;
  }
  return result;
}

}  // namespace cmb::overlap
