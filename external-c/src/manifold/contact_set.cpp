#include "manifold/contact_set.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

double total_load(const std::vector<ContactPoint> &points, std::size_t begin) {
  double load = 0.0;
  for (std::size_t i = begin; i < points.size(); ++i) load += points[i].weight * points[i].depth;
  return load;
}

namespace {

// Up to this many points the best of all pairs is united.
constexpr std::size_t points_for_all_pairs = 16;

ContactPoint united(const ContactPoint &a, const ContactPoint &b) {
  const double load_a = a.weight * a.depth, load_b = b.weight * b.depth, load = load_a + load_b;
  ContactPoint result;
  // Corners of hardly any depth would drag a mean by weight to the surface.
  result.depth = (load_a * a.depth + load_b * b.depth) / load;
  result.weight = load / result.depth;
  result.position = (1.0 / load) * (load_a * a.position + load_b * b.position);
  result.normal = normalized(load_a * a.normal + load_b * b.normal, load_a >= load_b ? a.normal : b.normal);
  return result;
}

// What uniting two points adds to the second moment of the load that is lost.
double union_cost(const ContactPoint &a, const ContactPoint &b) {
  const double load_a = a.weight * a.depth, load_b = b.weight * b.depth;
  return load_a * load_b / (load_a + load_b) * norm2(a.position - b.position);
}

// Leaves the `capacity` points of greatest load; each of the others is united with the one that is cheapest.
void keep_heaviest(std::vector<ContactPoint> &points, std::size_t capacity) {
  std::sort(points.begin(), points.end(), [](const ContactPoint &x, const ContactPoint &y) {
    return x.weight * x.depth > y.weight * y.depth;
  });
  for (std::size_t k = capacity; k < points.size(); ++k) {
    std::size_t partner = 0;
    double least = union_cost(points[k], points[0]);
    for (std::size_t i = 1; i < capacity; ++i) {
      const double cost = union_cost(points[k], points[i]);
      if (cost < least) least = cost, partner = i;
    }
    points[partner] = united(points[partner], points[k]);
  }
  points.resize(capacity);
}

// Unites the cheapest pair of all again and again. Each point knows the cheapest of those behind it. The comparisons are
// written to be compiled without branches, which would be guessed wrong.
class CheapestPairs {
 public:
  explicit CheapestPairs(std::vector<ContactPoint> &points) : points_(points), count_(points.size()) {
    for (std::size_t i = 0; i < count_; ++i) place(i);
    for (std::size_t i = 0; i < count_; ++i) look_behind(i);
  }

  void unite_cheapest() {
    std::size_t first = 0;
    double least = cost_[0];
    for (std::size_t i = 1; i < count_; ++i) {
      const bool cheaper = cost_[i] < least;
      least = cheaper ? cost_[i] : least;
      first = cheaper ? i : first;
    }
    const std::size_t second = partner_[first];
    points_[first] = united(points_[first], points_[second]);
    place(first);
    gone_[second] = true;
    cost_[second] = at_[second].x = HUGE_VAL;  // too far for any other one
    look_behind(first);
    for (std::size_t i = 0; i < second; ++i) {
      if (gone_[i] || i == first) continue;
      if (partner_[i] == first || partner_[i] == second) {
        look_behind(i);
      } else if (i < first) {
        const double cost = cost_of(i, first);
        const bool cheaper = cost < cost_[i] || (cost == cost_[i] && first < partner_[i]);
        cost_[i] = cheaper ? cost : cost_[i];
        partner_[i] = cheaper ? first : partner_[i];
      }
    }
  }

  // Leaves the points that are left.
  void finish() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (gone_[i]) continue;
      if (kept != i) points_[kept] = points_[i];
      ++kept;
    }
    points_.resize(kept);
  }

 private:
  void place(std::size_t i) {
    load_[i] = points_[i].weight * points_[i].depth;
    at_[i] = points_[i].position;
    gone_[i] = false;
  }
  double cost_of(std::size_t i, std::size_t j) const {
    return load_[i] * load_[j] / (load_[i] + load_[j]) * norm2(at_[i] - at_[j]);
  }
  void look_behind(std::size_t i) {
    double least = HUGE_VAL;
    std::size_t partner = count_;
    for (std::size_t j = i + 1; j < count_; ++j) {
      const double cost = cost_of(i, j);
      const bool cheaper = cost < least;
      least = cheaper ? cost : least;
      partner = cheaper ? j : partner;
    }
    cost_[i] = least;
    partner_[i] = partner;
  }

  std::vector<ContactPoint> &points_;
  std::size_t count_;
  Vec3 at_[points_for_all_pairs];
  double load_[points_for_all_pairs], cost_[points_for_all_pairs];
  std::size_t partner_[points_for_all_pairs];
  bool gone_[points_for_all_pairs];
};

}  // namespace

void merge_points(std::vector<ContactPoint> &points, std::size_t capacity) {
  if (points.size() <= capacity) return;
  if (points.size() > std::max(capacity, points_for_all_pairs)) {
    keep_heaviest(points, std::max(capacity, points_for_all_pairs));
  }
  if (points.size() <= capacity) return;
  CheapestPairs pairs(points);
  for (std::size_t left = points.size(); left > capacity; --left) pairs.unite_cheapest();
  pairs.finish();
}

}  // namespace cmb
