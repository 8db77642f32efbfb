#include "manifold/axis/capsule_on_revolved.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/axis/axis_energy.hpp"
#include "manifold/axis/carried_part.hpp"
#include "manifold/axis/revolved_profile.hpp"
#include "math/gauss_rule.hpp"
#include "math/smoothstep.hpp"

namespace cmb {

namespace {

using Part = RevolvedProfile::Part;

// Places of an axis where the stretch is cut; those outside of it are left out.
class Cuts {
 public:
  Cuts(double from, double to) : places_{from}, to_(to) {}

  void add(double x) {
    if (x > places_[0] && x < to_) places_[count_++] = x;
  }
  // Where constant + 2 slope x + curvature x^2 is 0.
  void add_roots(double constant, double slope, double curvature) {
    const double discriminant = slope * slope - curvature * constant;
    if (!(discriminant > 0.0)) return;
    const double sum = -slope - std::copysign(std::sqrt(discriminant), slope);
    add(sum / curvature), add(constant / sum);
  }
  // Calls take(from, to) for each piece.
  template <typename Take>
  void each(const Take &take) {
    places_[count_++] = to_;
    std::sort(places_ + 1, places_ + count_);
    for (int k = 1; k < count_; ++k) {
      if (places_[k] > places_[k - 1]) take(places_[k - 1], places_[k]);
    }
  }

 private:
  static constexpr int most = 24;
  double places_[most];
  const double to_;
  int count_ = 1;
};

// An axis beside or inside a cylinder or cone, in whose frame all is; places are counted from `origin`, the deepest one.
class AxisBesideRevolved {
 public:
  AxisBesideRevolved(const RevolvedProfile &profile, const Vec3 &origin, const Vec3 &axis, double radius)
      : profile_(profile), origin_(origin), axis_(axis), radius_(radius),
        across2_(origin.x * origin.x + origin.y * origin.y),
        lean_(origin.x * axis.x + origin.y * axis.y),
        curvature_(axis.x * axis.x + axis.y * axis.y) {}

  // Of the stretch between these places what is deep; `depth` is the greatest.
  AxisEnergy energy(double first, double last, double depth) {
    AxisEnergy energy;
    lowest_ = 0.0;
    const Stretch near = near_bounds(first, last);
    const double from = end_of_contact(near.from), to = end_of_contact(near.to);
    if (!(to > from)) return energy;
    energy.extend(from, to);
    Cuts cuts(from, to);
    cut_outside(cuts);
    // Near an edge the gap bends at the deepest place, in the body between its sides: no rule goes over it.
    if (depth > 0.2 * radius_) cuts.add(0.0);
    if (!profile_.is_cylinder() || depth > radius_) cuts.add(-lean_ / curvature_);
    if (depth >= radius_) cut_inside(cuts);
    cuts.each([&](double begin, double end) {
      add_piece(begin, end, energy);
      if (depth >= radius_) lowest_ = std::min({lowest_, gap_at(begin), gap_at(end)});
    });
    return energy;
  }

  // How deep the axis that energy() was asked for is in the body, plus the radius; the radius where it is not.
  double deepest() const { return radius_ - lowest_; }

  // The part of the stretch that is near edges, or near where two sides inside are as near.
  double near_edges(double begin, double end) const {
    constexpr int samples = 8;
    const double step = (end - begin) / samples, near = near_edge_part * std::min(1.0, profile_.base_sharpness()) * radius_;
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) {
      sum += convex::falling_smoothstep(profile_.to_edge(place(begin + (k + 0.5) * step)) / near);
    }
    return sum / samples;
  }

 private:
  MeridianPlace place(double x) const {
    const double across_x = origin_.x + x * axis_.x, across_y = origin_.y + x * axis_.y;
    return {std::sqrt(across_x * across_x + across_y * across_y), origin_.z + x * axis_.z};
  }
  double gap_at(double x) const {
    const MeridianPlace at = place(x);
    return profile_.gap(profile_.nearest(at), at).distance;
  }
  // Away from the obstacle, of unit length.
  Vec3 direction(const RevolvedProfile::Gap &gap, double x, double across) const {
    const double part = across > 0.0 ? gap.by_across / across : 0.0;
    return {part * (origin_.x + x * axis_.x), part * (origin_.y + x * axis_.y), gap.by_height};
  }

  struct Stretch {
    double from, to;
  };
  // Of the stretch what is within the radius of the cylinder that holds the body: between planes, and about its axis. On a cylinder's flat
  // sides and its mantle that is what is deep.
  Stretch near_bounds(double first, double last) const {
    const double most = profile_.half_length() + radius_, reach = profile_.radius() + radius_;
    const double up = (std::copysign(most, axis_.z) - origin_.z) / axis_.z, down = (-std::copysign(most, axis_.z) - origin_.z) / axis_.z;
    Stretch near{first, last};
    if (down < 0.0) near.from = std::max(near.from, down);  // no number where it does not come nearer
    if (up > 0.0) near.to = std::min(near.to, up);
    const double room = across2_ - reach * reach, root = std::sqrt(std::max(0.0, lean_ * lean_ - curvature_ * room));
    if (!(room < 0.0)) return near;
    const double sum = -lean_ - std::copysign(root, lean_), x = sum / curvature_, y = room / sum;
    near.from = std::max(near.from, std::min(x, y)), near.to = std::min(near.to, std::max(x, y));
    return near;
  }
  // What is deep ends here, at `x` or before it. The distance is a convex function: Newton's method comes from the one side.
  double end_of_contact(double x) const {
    const double sense = x;
    for (int step = 0; step < 50; ++step) {
      const MeridianPlace at = place(x);
      const RevolvedProfile::Gap gap = profile_.gap(profile_.nearest(at), at);
      const double above = gap.distance - radius_;
      if (!(above > 1e-14 * radius_)) return x;
      const double next = x - above / dot(direction(gap, x, at.across), axis_);
      if (!(next * sense > 0.0)) return 0.0;
      if (next == x) return x;
      x = next;
    }
    return x;
  }

  void cut_at_height(double height, Cuts &cuts) const { cuts.add((height - origin_.z) / axis_.z); }
  // Where the distance from the axis of revolution is radius + slope * (height - at).
  void cut_at_cone(double radius, double slope, double at, Cuts &cuts) const {
    const double here = radius + slope * (origin_.z - at), growth = slope * axis_.z;
    cuts.add_roots(across2_ - here * here, lean_ - here * growth, curvature_ - growth * growth);
  }

  // Where the nearest part changes outside of the body.
  void cut_outside(Cuts &cuts) const {
    const double radius = profile_.radius(), half = profile_.half_length();
    cut_at_height(-half, cuts);
    cut_at_cone(radius, 0.0, 0.0, cuts);
    if (profile_.is_cylinder()) {
      cut_at_height(half, cuts);
    } else {
      const double across_mantle = profile_.normal_across() / profile_.normal_along();
      cut_at_cone(radius, across_mantle, -half, cuts);
      cut_at_cone(0.0, across_mantle, half, cuts);
    }
  }
  void cut_inside(Cuts &cuts) const {
    const double radius = profile_.radius(), half = profile_.half_length();
    cut_at_cone(radius, -profile_.base_sharpness(), -half, cuts);
    if (profile_.is_cylinder()) {
      cut_at_cone(radius, 1.0, half, cuts);
      cut_at_height(0.0, cuts);
    } else {
      cut_deepest_under_mantle(cuts);
    }
  }

  // Where the axis is deepest below a cone's mantle: there the distance from the axis of revolution, a hyperbola, grows as fast as the height
  // takes away.
  void cut_deepest_under_mantle(Cuts &cuts) const {
    const double turn = lean_ / curvature_, least2 = across2_ - lean_ * turn;
    const double fall = profile_.normal_along() * axis_.z, growth = profile_.normal_across() * curvature_;
    const double free = profile_.normal_across() * growth - fall * fall;
    if (free > 0.0) cuts.add(-turn - std::copysign(std::sqrt(std::max(0.0, least2 / (curvature_ * free))), fall) * std::fabs(fall));
  }

  void add_piece(double from, double to, AxisEnergy &energy) const {
    const double half = profile_.half_length();
    // Not in the middle, where an axis may touch the border of two parts without passing over.
    constexpr double aside = 0.382;
    const Part part = profile_.nearest(place(from + aside * (to - from)));
    if (part == Part::base) {
      energy.add_flat({0, 0, -1}, radius_ + half + origin_.z, -axis_.z, from, to);
    } else if (part == Part::top) {
      energy.add_flat({0, 0, 1}, radius_ + half - origin_.z, axis_.z, from, to);
    } else if (part == Part::mantle && profile_.is_cylinder()) {
      const double reach = profile_.radius() + radius_;
      energy.add_round({origin_.x, origin_.y, 0}, {axis_.x, axis_.y, 0}, across2_ - reach * reach, lean_, curvature_, reach, from, to);
    } else {
      integrate(part, from, to, energy);
    }
  }

  void integrate(Part part, double from, double to, AxisEnergy &energy) const {
    constexpr int count = 8;
    const auto &rule = overlap::gauss_rule<count>;
    for (std::size_t k = 0; k < count; ++k) {
      const double x = from + (to - from) * rule.node[k];
      const MeridianPlace at = place(x);
      const RevolvedProfile::Gap gap = profile_.gap(part, at);
      energy.add_place(x, (to - from) * rule.weight[k], radius_ - gap.distance, direction(gap, x, at.across));
    }
  }

  const RevolvedProfile &profile_;
  const Vec3 origin_, axis_;
  const double radius_;
  // The squared distance from the axis of revolution is across2 + 2 lean x + curvature x^2.
  const double across2_, lean_, curvature_;
  double lowest_ = 0.0;  // the least signed distance, not above 0
};

}  // namespace

double capsule_on_revolved(const Shape &capsule, const convex::Pose &pose, const Shape &revolved, const convex::Pose &revolved_pose,
                           double depth, const Vec3 &deepest, double sense, std::vector<ContactPoint> &points) {
  const RevolvedProfile profile(revolved.body);
  const Mat3 &frame = revolved_pose.rotation;
  const double radius = capsule.body.radius, half = capsule.body.half.z;
  const Vec3 axis = pose.rotation.column(2);
  const double place = std::clamp(dot(deepest - pose.translation, axis), -half, half);
  const Vec3 origin = pose.translation + place * axis;
  AxisBesideRevolved beside(profile, transposed_times(frame, origin - revolved_pose.translation), transposed_times(frame, axis),
                                  radius);
  const AxisEnergy energy = beside.energy(-half - place, half - place, depth);
  double part = 1.0, limit = radius;
  if (depth > deep_axis_part * radius) {
    const double inside = beside.deepest();
    limit = std::max(depth, inside);
    part = carried_part(beside.near_edges(energy.begin(), energy.end()), inside, depth, radius);
  }
  return part > 0.0 && energy.carry(frame, axis, origin, radius, part, limit, sense, points) ? part : 0.0;
}

}  // namespace cmb
