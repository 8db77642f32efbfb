// Round convex solids in the axes that an overlap is computed in.
#pragma once

#include <array>

#include "shape/shape.hpp"
#include "volume/slices/conic_section.hpp"

namespace cmb::overlap {

// The round part of a sphere, ellipsoid, capsule, cylinder or cone: the last two without their flat ends.
class RoundSolid {
 public:
  // `pose` maps the shape's frame to the axes used here. Shapes of other kinds have no round part.
  RoundSolid(const Shape &shape, const Pose &pose);
  RoundSolid() = default;

  static bool is_round(const Shape &shape) {
    return shape.kind == ShapeKind::sphere || shape.kind == ShapeKind::ellipsoid || shape.kind == ShapeKind::capsule ||
           shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone;
  }

  // A box that holds the whole shape.
  const Vec3 &low() const { return low_; }
  const Vec3 &high() const { return high_; }
  // Calls visit(normal, offset) for the flat ends.
  template <typename Visit>
  void visit_flat_ends(Visit &&visit) const {
    if (kind_ == ShapeKind::cylinder) visit(axis_, dot(axis_, center_) + half_length_);
    if (kind_ == ShapeKind::cylinder || kind_ == ShapeKind::cone) visit(-axis_, half_length_ - dot(axis_, center_));
  }
  // A point inside the shape.
  Vec3 inner_point() const { return kind_ == ShapeKind::cone ? center_ - (0.5 * half_length_) * axis_ : center_; }
  // A point inside, flat ends left out, of a plane that cuts the round part in an ellipse; false where it does not.
  bool point_in_plane(const Vec3 &normal, double offset, Vec3 &point) const;
  // A cone's apex; else null.
  const Vec3 *apex() const { return kind_ == ShapeKind::cone ? &apex_ : nullptr; }

  // Of the line p + s d, without regard to flat ends.
  Stretch stretch(const Vec3 &p, const Vec3 &d) const;

  static constexpr int most_pieces = 3;  // of the surface: a capsule's side and ends
  int pieces() const { return pieces_; }

 private:
  friend class RoundSection;
  ShapeKind kind_ = ShapeKind::sphere;
  std::array<Quadric, most_pieces> quadric_;
  int pieces_ = 0;
  Vec3 center_, axis_, apex_, low_, high_;
  double half_length_ = 0.0;
};

// Its section by a plane y = const.
class RoundSection {
 public:
  struct Sides {
    Stretch z;
    int lower = 0, upper = 0;  // pieces of the surface
  };
  RoundSection(const RoundSolid &solid, double y, double low, double high);
  RoundSection() = default;

  // Both sides at x; empty where there are none.
  Sides at(double x) const;
  const Conic &piece(int k) const { return conic_[static_cast<std::size_t>(k)]; }
  int pieces() const { return solid_->pieces_; }
  // Calls visit(x) where pieces of the surface begin and end.
  template <typename Visit>
  void visit_joints(Visit &&visit) const {
    double x[4];
    for (int k = 0; k < solid_->pieces_; ++k) {
      const int count = conic_[static_cast<std::size_t>(k)].ends(x);
      for (int i = 0; i < count; ++i) visit(x[i]);
    }
    const int count = joints(x);
    for (int i = 0; i < count; ++i) visit(x[i]);
  }

 private:
  int joints(double *x) const;  // between a capsule's side and its ends; at most 4

  const RoundSolid *solid_ = nullptr;
  std::array<Conic, RoundSolid::most_pieces> conic_;
  double y_ = 0.0;
};

}  // namespace cmb::overlap
