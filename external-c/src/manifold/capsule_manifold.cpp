#include "manifold/capsule_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/gauss_rule.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"

namespace cmb {

namespace {

// Two places of a rule at once.
typedef double Two __attribute__((vector_size(16)));
double total(Two x) { return x[0] + x[1]; }

// The axes of two capsules and the places where they are nearest.
struct NearestPlaces {
  Vec3 axis[2];
  double half[2];
  double at[2];    // the nearest places, along each axis from its middle
  double lean[2];  // the gap's part along each axis, from the other one towards it; 0 but at an end
  double cosine, sine2, reach, depth, apart;
  Vec3 normal;     // from B to A
  Vec3 place[2];   // the nearest places in the world
  double radius[2];
};

// The part of [first, last] where constant + 2 slope x + curvature x^2 is negative; curvature >= 0.
std::pair<double, double> negative_part(double constant, double slope, double curvature, double first, double last) {
  const double discriminant = slope * slope - curvature * constant;
  if (!(discriminant > 0.0)) return constant < 0.0 ? std::pair(first, last) : std::pair(0.0, 0.0);
  const double sum = -slope - std::copysign(std::sqrt(discriminant), slope);
  const double x = sum / curvature, y = constant / sum;  // without curvature x is infinite
  return {std::max(first, std::min(x, y)), std::min(last, std::max(x, y))};
}

// What the axis of one capsule stores against the axis of the other: integrals over the stretch of it whose balls are nearer
// than the reach. Places are measured from the nearest places, `x` along this axis, `y` along the other, and the depth is
// reach - |gap + x u - y v|. Each function of the distance alone, so its gradient by a ball's place is along the gap there.
class AxisEnergy {
 public:
  AxisEnergy(const NearestPlaces &nearest, int own)
      : nearest_(nearest), own_(own), other_(1 - own), gap_((own == 0 ? nearest.apart : -nearest.apart) * nearest.normal) {
    const double first = -nearest.half[own] - nearest.at[own], last = nearest.half[own] - nearest.at[own];
    const double low = -nearest.half[other_] - nearest.at[other_], high = nearest.half[other_] - nearest.at[other_];
    // The foot on the other's line is foot + cosine x; between these places it is on the axis itself.
    const double foot = -nearest.lean[other_];
    const double cosine = std::copysign(std::max(std::fabs(nearest.cosine), 1e-200), nearest.cosine);  // not 0
    double from = (low - foot) / cosine, to = (high - foot) / cosine, before = low, behind = high;
    if (from > to) std::swap(from, to), std::swap(before, behind);
    from = std::min(std::max(from, first), last), to = std::min(std::max(to, first), last);
    add_opposite_end(before, first, from);
    add_opposite_line(foot, from, to);
    add_opposite_end(behind, to, last);
  }

  // Appends two points on the surface along this axis that carry the gradient of half the energy.
  void carry(std::vector<ContactPoint> &points) const {
    const double cube = total(cube_), by_sum = 1.0 / total(sum_);
    if (!(cube > 0.0)) return;
    const double energy = 0.5 * cube * by_sum;
    const auto loads = [&](Two squares, Two ones) { return 0.5 * by_sum * total(3.0 * squares - 2.0 * energy * ones); };
    const Vec3 &u = nearest_.axis[own_], &v = nearest_.axis[other_];
    const double along = loads(square_.x, one_.x);
    const Vec3 force = loads(square_.one, one_.one) * gap_ + along * u - loads(square_.y, one_.y) * v;
    // Of its first moment along the axis the part across it alone turns the body.
    Vec3 moment = along * gap_ - loads(square_.xy, one_.xy) * v;
    moment = moment - dot(moment, u) * u;
    const Vec3 across = force - dot(force, u) * u;
    const double across2 = norm2(across), middle = total(first_) * by_sum;
    const double place = across2 > 0.0 ? dot(moment, across) / across2 : middle;
    const double spread = std::sqrt(std::max(0.0, total(second_) * by_sum - middle * middle) + (place - middle) * (place - middle));
    const Vec3 difference = spread > 0.0 ? (1.0 / spread) * (moment - middle * across) : Vec3{};
    const Vec3 forces[2] = {0.5 * (force - difference), 0.5 * (force + difference)};
    const double lengths[2] = {norm(forces[0]), norm(forces[1])}, load = lengths[0] + lengths[1];
    if (!(load > 0.0)) return;
    const double depth = std::min(2.0 * energy / load, nearest_.reach);
    for (int k = 0; k < 2; ++k) {
      if (!(lengths[k] > 0.0)) continue;
      const Vec3 normal = (1.0 / lengths[k]) * forces[k];  // from the other to this one
      const double x = middle + (k == 0 ? -spread : spread);
      const Vec3 position = nearest_.place[own_] + x * u - (nearest_.radius[own_] - 0.5 * depth) * normal;
      points.push_back({depth, 0.5 * lengths[k] / depth, own_ == 0 ? normal : -normal, position});
    }
  }

 private:
  // Integrals of a load by the gap: times 1, x, y and x y.
  struct Moments {
    Two one{}, x{}, y{}, xy{};
    void add(Two load, Two at, Two opposite) {
      one += load, x += load * at, y += load * opposite, xy += load * at * opposite;
    }
  };

  // The balls from `first` to `last` are nearest to the end `y` of the other axis.
  void add_opposite_end(double y, double first, double last) {
    if (!(last > first)) return;
    const double u_lean = nearest_.lean[own_], v_lean = nearest_.lean[other_];
    add(y, 0.0, y * (y + 2.0 * v_lean), u_lean - nearest_.cosine * y, 1.0, first, last);
  }

  // The balls from `first` to `last` are nearest to the line of the other axis.
  void add_opposite_line(double foot, double first, double last) {
    if (!(last > first)) return;
    const double u_lean = nearest_.lean[own_], cosine = nearest_.cosine;
    add(foot, cosine, -foot * foot, u_lean - foot * cosine, nearest_.sine2, first, last);
  }

  // The place opposite x is y0 + slope x, and the gap squared apart^2 + constant + 2 linear x + curvature x^2.
  void add(double y0, double slope, double constant, double linear, double curvature, double first, double last) {
    const double reach = nearest_.reach, shallow = constant - nearest_.depth * (reach + nearest_.apart);
    const auto [from, to] = negative_part(shallow, linear, curvature, first, last);
    if (!(to > from)) return;
    // Where the axes nearly meet, the distance bends at the nearest place: no rule goes over it.
    if (nearest_.apart < 0.8 * reach && from < 0.0 && to > 0.0) {
      integrate(y0, slope, shallow, linear, curvature, from, 0.0);
      integrate(y0, slope, shallow, linear, curvature, 0.0, to);
    } else {
      integrate(y0, slope, shallow, linear, curvature, from, to);
    }
  }

  void integrate(double y0, double slope, double shallow, double linear, double curvature, double from, double to) {
    static constexpr int count = 8;
    const auto &rule = overlap::gauss_rule<count>;
    const double reach = nearest_.reach, length = to - from;
    for (std::size_t k = 0; k < count; k += 2) {
      const Two x = from + length * Two{rule.node[k], rule.node[k + 1]}, y = y0 + slope * x;
      const Two below = shallow + x * (2.0 * linear + curvature * x);  // the gap squared, less the reach squared
      const Two gap2 = reach * reach + below, gap{std::sqrt(std::max(gap2[0], 1e-300)), std::sqrt(std::max(gap2[1], 1e-300))};
      // By one division: that of gap * (reach + gap).
      const Two both = reach + gap, inverse = 1.0 / (gap * both), deep = -below * gap * inverse;
      const Two depth = deep > 0.0 ? deep : Two{}, weight = length * Two{rule.weight[k], rule.weight[k + 1]};
      const Two part = weight * depth, square = depth * depth, by_gap = weight * both * inverse;
      sum_ += part, first_ += part * x, second_ += part * x * x, cube_ += part * square;
      one_.add(by_gap, x, y);
      square_.add(by_gap * square, x, y);
    }
  }

  const NearestPlaces &nearest_;
  const int own_, other_;
  const Vec3 gap_;  // from the other's nearest place to this one's
  Two sum_{}, first_{}, second_{}, cube_{};  // of depth, times x, x^2; of depth^3
  Moments one_, square_;                     // of 1 / gap and depth^2 / gap
};

// Appends what the axes of two capsules carry, half of it each.
void carry(const NearestPlaces &nearest, std::vector<ContactPoint> &points) {
  const std::size_t begin = points.size();
  for (int own = 0; own < 2; ++own) AxisEnergy(nearest, own).carry(points);
  if (points.size() > begin) return;
  // As deep as rounding alone.
  const Vec3 surface = nearest.place[0] - (nearest.radius[0] - 0.5 * nearest.depth) * nearest.normal;
  points.push_back({nearest.depth, 1.0, nearest.normal, surface});
}

}  // namespace

bool capsule_on_capsule(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                        std::vector<ContactPoint> &points) {
  const double radius_a = a.body.radius, radius_b = b.body.radius, reach = radius_a + radius_b;
  const double depth = -answer.distance, apart = reach - depth;
  if (!(apart > 1e-9 * reach)) return false;
  const Vec3 axis_a = pose_a.rotation.column(2), axis_b = pose_b.rotation.column(2), &normal = answer.normal;
  const Vec3 place_a = answer.point_a + radius_a * normal, place_b = answer.point_b - radius_b * normal;
  const NearestPlaces nearest{{axis_a, axis_b},
                              {a.body.half.z, b.body.half.z},
                              {dot(place_a - pose_a.translation, axis_a), dot(place_b - pose_b.translation, axis_b)},
                              {apart * dot(normal, axis_a), -apart * dot(normal, axis_b)},
                              dot(axis_a, axis_b),
                              norm2(cross(axis_a, axis_b)),
                              reach,
                              depth,
                              apart,
                              normal,
                              {place_a, place_b},
                              {radius_a, radius_b}};
  carry(nearest, points);
  return true;
}

bool capsule_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, ContactSet &result) {
  const double radius_a = a.body.radius, radius_b = b.body.radius, reach = radius_a + radius_b;
  const Vec3 axis_a = pose_a.rotation.column(2), axis_b = pose_b.rotation.column(2);
  const double half_a = a.body.half.z, half_b = b.body.half.z;
  const Vec3 between = pose_b.translation - pose_a.translation;
  const convex::NearestOnSegments on = convex::nearest_on_segments(axis_a, half_a, axis_b, half_b, between);
  const Vec3 place_a = on.place_a * axis_a, place_b = between + on.place_b * axis_b, gap = place_a - place_b;
  const double apart = norm(gap), depth = reach - apart;
  // Where the axes meet, there is no direction from one to the other.
  if (!(apart > 1e-9 * reach)) return false;
  const Vec3 normal = (1.0 / apart) * gap;
  result.distance = -depth;
  result.normal = normal;
  result.witness = pose_a.translation + 0.5 * (place_a + place_b) - (0.5 * (radius_a - radius_b)) * normal;
  if (!(depth > 0.0)) return true;
  const NearestPlaces nearest{{axis_a, axis_b},
                              {half_a, half_b},
                              {on.place_a, on.place_b},
                              {on.place_a - (on.place_b * on.cosine + on.foot_a),
                               on.place_b - (on.place_a * on.cosine + on.foot_b)},
                              on.cosine,
                              norm2(cross(axis_a, axis_b)),
                              reach,
                              depth,
                              apart,
                              normal,
                              {pose_a.translation + place_a, pose_a.translation + place_b},
                              {radius_a, radius_b}};
  carry(nearest, result.points);
  return true;
}

}  // namespace cmb
