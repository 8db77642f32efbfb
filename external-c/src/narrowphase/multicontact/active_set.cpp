#include "narrowphase/multicontact/active_set.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// Directions of which three are independent: the volume that they span.
constexpr double independent = 1e-12;

// The candidates for the centre.
class Centre {
 public:
  explicit Centre(const ActiveSet &active) : planes_(active.planes), count_(active.count), radius_(active.radius) {
    for (int i = 0; i < count_; ++i) {
      const int one[] = {i};
      const double alone[] = {lack(i)};
      consider(one, alone, 1);
      for (int j = 0; j < i; ++j) {
        consider_two(i, j);
        for (int k = 0; k < j; ++k) consider_three(i, j, k);
      }
    }
  }

  double excess() const { return best_excess_; }
  const Vec3 &value() const { return best_; }
  double multiplier(int k) const { return best_multiplier_[k]; }

 private:
  double lack(int k) const { return radius_ - planes_[k].height; }

  // The centre that is determined by these planes alone.
  void consider(const int *which, const double *multiplier, int active) {
    Vec3 p;
    for (int k = 0; k < active; ++k) {
      if (multiplier[k] < 0.0) return;
      p = p - multiplier[k] * planes_[which[k]].direction;
    }
    double excess = 0.0;
    for (int k = 0; k < count_; ++k) excess = std::max(excess, dot(planes_[k].direction, p) + lack(k));
    if (excess >= best_excess_) return;
    best_excess_ = excess;
    best_ = p;
    std::fill_n(best_multiplier_, ActiveSet::most, 0.0);
    for (int k = 0; k < active; ++k) best_multiplier_[which[k]] = multiplier[k];
  }

  void consider_two(int i, int j) {
    // Accurate where both are nearly one direction, too: of a difference and a cross product, not of a cosine near 1.
    const Vec3 &u = planes_[i].direction, &v = planes_[j].direction;
    const double apart = 0.5 * norm2(v - u), sine2 = norm2(cross(u, v));  // 1 less the cosine
    if (!(sine2 > 1e-20)) return;
    const int which[] = {i, j};
    const double more = lack(i) - lack(j), multiplier[] = {(more + apart * lack(j)) / sine2, (apart * lack(i) - more) / sine2};
    consider(which, multiplier, 2);
  }

  void consider_three(int i, int j, int k) {
    const Vec3 &u = planes_[i].direction, &v = planes_[j].direction, &m = planes_[k].direction;
    const Vec3 vm = cross(v, m), mu = cross(m, u), uv = cross(u, v);
    const double volume = dot(u, vm);
    if (!(std::fabs(volume) > independent)) return;
    const Vec3 p = (-1.0 / volume) * (lack(i) * vm + lack(j) * mu + lack(k) * uv);
    const int which[] = {i, j, k};
    const double multiplier[] = {-dot(p, vm) / volume, -dot(p, mu) / volume, -dot(p, uv) / volume};
    consider(which, multiplier, 3);
  }

  const SupportingPlane *planes_;
  int count_;
  double radius_, best_excess_ = INFINITY;
  Vec3 best_;
  double best_multiplier_[ActiveSet::most] = {0, 0, 0, 0};
};

}  // namespace

bool ActiveSet::project_origin() {
  const Centre found(*this);
  if (!(found.excess() <= slack)) return false;
  centre = found.value();
  int kept = 0;
  for (int k = 0; k < count; ++k) {
    if (!(found.multiplier(k) > 0.0)) continue;
    planes[kept] = planes[k];
    planes[kept++].multiplier = found.multiplier(k);
  }
  count = kept;
  return count > 0;
}

bool ActiveSet::intersection(double first, double second, double third, Vec3 &p) const {
  const Vec3 &u = planes[0].direction, &v = planes[1].direction, &m = planes[2].direction;
  const Vec3 vm = cross(v, m);
  const double volume = dot(u, vm);
  if (count != 3 || !(std::fabs(volume) > independent)) return false;
  p = (1.0 / volume) * (first * vm + second * cross(m, u) + third * cross(u, v));
  return true;
}

}  // namespace cmb::convex
