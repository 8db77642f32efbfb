#include "narrowphase/analytic/box_distance.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

Vec3 clamped(const Vec3 &p, const Vec3 &half) {
  return {std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y), std::clamp(p.z, -half.z, half.z)};
}

// The points a of A and b of B are six coordinates within bounds, in A's and B's frames, and a - b is linear in them: the
// distance is a least square with bounds. As in the active set method, some coordinates are free, and the others wait at
// bounds (or where they began) for one of them to be moved to the least distance, the free ones following. No more than
// two are free: if three of them leave the difference no direction to go, the boxes overlap.
class NearestPoints {
 public:
  NearestPoints(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a)
      : rotation_(b_in_a.rotation), translation_(b_in_a.translation) {
    for (int k = 0; k < 3; ++k) half_[k] = half_a[k], half_[3 + k] = half_b[k];
    // Nearest points in alternation, from B's middle on.
    Vec3 a = clamped(translation_, half_a);
    Vec3 b = clamped(transposed_times(rotation_, a - translation_), half_b);
    a = clamped(b_in_a(b), half_a);
    for (int k = 0; k < 3; ++k) at_[k] = a[k];
    take_free(0);
    if (free_count_ == 0) b = clamped(transposed_times(rotation_, a - translation_), half_b);
    for (int k = 0; k < 3; ++k) at_[3 + k] = b[k];
    if (free_count_ == 0) take_free(3);
    find_difference();
  }

  // Ends with points proven to be nearest to `tolerance`, or false.
  bool solve(double tolerance, double least) {
    constexpr int most_steps = 24;
    if (free_count_ > 2) return false;
    for (int step = 0; step < most_steps; ++step) {
      if (!find_normal() || !(distance_ > least)) return false;
      // How much nearer the boxes' extents along the normal come than the points do: by each coordinate's way to the
      // end that it is drawn to.
      const Vec3 normal_in_b = transposed_times(rotation_, normal_);
      const double slope[6] = {normal_.x, normal_.y, normal_.z, -normal_in_b.x, -normal_in_b.y, -normal_in_b.z};
      double gap = 0.0, largest = 0.0;
      int drawn = 0;
      for (int k = 0; k < 6; ++k) {
        const double loss = std::fabs(slope[k]) * half_[k] + slope[k] * at_[k];
        gap += loss;
        drawn = loss > largest ? k : drawn;
        largest = loss > largest ? loss : largest;
      }
      if (gap <= tolerance) return true;
      if (is_free(drawn) || !move(drawn, slope[drawn] > 0.0 ? -1.0 : 1.0)) return false;
      find_difference();
    }
    return false;
  }

  // direction from A to B
  CoreDistance answer() const {
    const Vec3 b{at_[3], at_[4], at_[5]};
    return {distance_, -normal_, {at_[0], at_[1], at_[2]}, rotation_ * b + translation_, DistanceMethod::closed_form, true};
  }

 private:
  bool is_free(int k) const { return (free_count_ > 0 && free_[0] == k) || (free_count_ > 1 && free_[1] == k); }

  // The coordinates of the box from `first` on that are between their bounds.
  void take_free(int first) {
    for (int k = first; k < first + 3; ++k) {
      if (std::fabs(at_[k]) < half_[k]) free_[free_count_++] = k;
    }
  }

  // The change of the difference by a coordinate.
  Vec3 way(int k) const {
    if (k >= 3) return -rotation_.column(k - 3);
    Vec3 axis;
    axis.set(k, 1.0);
    return axis;
  }

  void find_difference() {
    const Vec3 b{at_[3], at_[4], at_[5]};
    difference_ = Vec3{at_[0], at_[1], at_[2]} - (rotation_ * b + translation_);
  }

  // The difference's direction, perpendicular to the free ways to rounding however small the difference is. False where
  // those are parallel to rounding.
  bool find_normal() {
    if (free_count_ == 2) {
      const int i = free_[0], j = free_[1];
      if (i < 3 && j >= 3) {
        if (!common_perpendicular(way(i), way(j), normal_)) return false;
      } else {
        normal_ = way((i < 3 ? 3 : 12) - i - j);
      }
      distance_ = dot(normal_, difference_);
      if (distance_ < 0.0) normal_ = -normal_, distance_ = -distance_;
      return true;
    }
    Vec3 across = difference_;
    if (free_count_ == 1) {
      const Vec3 along = way(free_[0]);
      across = across - dot(across, along) * along;
    }
    distance_ = norm(across);
    normal_ = (1.0 / distance_) * across;
    return true;
  }

  // Moves a coordinate that is not free, the free ones following, as long as the points come nearer; false where the boxes
  // meet, or where the points do not come nearer.
  bool move(int moved, double sense) {
    for (;;) {
      const Vec3 of_moved = sense * way(moved);
      double follow[2] = {0.0, 0.0};
      Vec3 change = of_moved;
      if (free_count_ > 0) {
        const Vec3 u = way(free_[0]);
        follow[0] = -dot(of_moved, u);
        if (free_count_ > 1) {
          const Vec3 v = way(free_[1]);
          const double cosine = dot(u, v);
          const Vec3 across = v - cosine * u;
          follow[1] = -dot(of_moved, across) / norm2(across);
          follow[0] -= follow[1] * cosine;
          change = change + follow[1] * v;
        }
        change = change + follow[0] * u;
      }
      const double approach = -dot(difference_, change);
      if (!(approach > 0.0)) return false;
      double step = approach / norm2(change);  // of nearly parallel ways beyond any bound
      int stopped = -1;  // 0, 1: a free one; 2: the moved one
      const double room = half_[moved] - sense * at_[moved];
      if (step >= room) step = room, stopped = 2;
      for (int k = 0; k < free_count_; ++k) {
        const double limit = half_[free_[k]] - std::copysign(1.0, follow[k]) * at_[free_[k]];
        if (std::fabs(follow[k]) * step > limit) step = limit / std::fabs(follow[k]), stopped = k;
      }
      if (stopped < 0 && free_count_ == 2) return false;
      for (int k = 0; k < free_count_; ++k) {
        const double end = half_[free_[k]];
        at_[free_[k]] = std::clamp(at_[free_[k]] + follow[k] * step, -end, end);
      }
      at_[moved] = std::clamp(at_[moved] + sense * step, -half_[moved], half_[moved]);
      if (stopped < 0) {
        free_[free_count_++] = moved;
        if (free_[0] > moved) std::swap(free_[0], free_[free_count_ - 1]);
        return true;
      }
      if (stopped == 2) {
        at_[moved] = sense * half_[moved];
        return true;
      }
      at_[free_[stopped]] = std::copysign(half_[free_[stopped]], follow[stopped]);
      if (stopped == 0) free_[0] = free_[1];
      --free_count_;
      difference_ = difference_ + step * change;
    }
  }

  const Mat3 &rotation_;
  const Vec3 &translation_;
  double half_[6], at_[6];
  int free_[3] = {0, 0, 0}, free_count_ = 0;
  Vec3 difference_, normal_;
  double distance_ = 0.0;
};

}  // namespace

bool distance_of_disjoint_boxes(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a, double tolerance,
                                CoreDistance &result) {
  NearestPoints points(half_a, half_b, b_in_a);
  if (!points.solve(tolerance, 6.4 * tolerance)) return false;
  result = points.answer();
  return true;
}

}  // namespace cmb::convex
