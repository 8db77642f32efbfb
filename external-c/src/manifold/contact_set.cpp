#include "manifold/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace cmb {

double total_load(const std::vector<ContactPoint> &points, std::size_t begin) {
  double load = 0.0;
  for (std::size_t i = begin; i < points.size(); ++i) load += points[i].weight * points[i].depth;
  return load;
}

Vec3 net_load(const std::vector<ContactPoint> &points, std::size_t begin) {
  Vec3 sum;
  for (std::size_t k = begin; k < points.size(); ++k) sum = sum + (points[k].weight * points[k].depth) * points[k].normal;
  return sum;
}

namespace {

// Of so many points the best of all pairs is united.
constexpr std::size_t points_for_all_pairs = 16;

double load_of(const ContactPoint &point) { return point.weight * point.depth; }

// What uniting two loads adds to the second moment of the load that is lost.
double union_cost(double load_a, double load_b, double distance2) {
  return load_a * load_b / (load_a + load_b) * distance2;
}

void unite(ContactPoint &point, const ContactPoint &other) {
  const double load = load_of(point), other_load = load_of(other), sum = load + other_load;
  const double part = other_load / sum;
  // By load: corners of hardly any depth would drag a mean by weight to the surface.
  point.depth += part * (other.depth - point.depth);
  point.weight = sum / point.depth;
  point.position = point.position + part * (other.position - point.position);
  point.normal = normalized(point.normal + part * (other.normal - point.normal), point.normal);
}

// Leaves the `capacity` points of greatest load; each of the others is united with the one that is cheapest.
void keep_heaviest(std::vector<ContactPoint> &points, std::size_t capacity) {
  std::sort(points.begin(), points.end(),
            [](const ContactPoint &x, const ContactPoint &y) { return load_of(x) > load_of(y); });
  for (std::size_t k = capacity; k < points.size(); ++k) {
    std::size_t partner = 0;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < capacity; ++i) {
      const double cost =
          union_cost(load_of(points[k]), load_of(points[i]), norm2(points[k].position - points[i].position));
      if (cost < least) least = cost, partner = i;
    }
    unite(points[partner], points[k]);
  }
  points.resize(capacity);
}

// The pairs of up to `points_for_all_pairs` points, those of the first n points first, for every n.
struct PairTable {
  static constexpr std::size_t count = points_for_all_pairs * (points_for_all_pairs - 1) / 2;
  std::uint8_t first[count] = {}, second[count] = {};

  constexpr PairTable() {
    std::size_t pair = 0;
    for (std::size_t j = 1; j < points_for_all_pairs; ++j) {
      for (std::size_t i = 0; i < j; ++i, ++pair) {
        first[pair] = static_cast<std::uint8_t>(i);
        second[pair] = static_cast<std::uint8_t>(j);
      }
    }
  }
};

// Finds the cheapest pair again and again, in one loop without a branch: which pair it is, is unpredictable.
class CheapestPair {
 public:
  explicit CheapestPair(std::vector<ContactPoint> &points) : points_(points) {
    for (std::size_t i = 0; i < points.size(); ++i) note(i);
  }

  void unite_cheapest() {
    static constexpr PairTable pairs;
    const std::size_t count = points_.size() * (points_.size() - 1) / 2;
    double least = HUGE_VAL;
    std::size_t cheapest = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double cost = cost_of(pairs.first[k], pairs.second[k]);
      cheapest = cost < least ? k : cheapest;
      least = cost < least ? cost : least;
    }
    const std::size_t first = pairs.first[cheapest], second = pairs.second[cheapest];
    unite(points_[first], points_[second]);
    note(first);
    points_[second] = points_.back();
    points_.pop_back();
    if (second < points_.size()) note(second);
  }

 private:
  void note(std::size_t i) {
    const ContactPoint &point = points_[i];
    noted_[i] = {load_of(point), point.position.x, point.position.y, point.position.z};
  }
  double cost_of(std::size_t i, std::size_t j) const {
    const Noted &p = noted_[i], &q = noted_[j];
    const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    return union_cost(p.load, q.load, x * x + y * y + z * z);
  }

  struct Noted {
    double load, x, y, z;
  };
  std::vector<ContactPoint> &points_;
  Noted noted_[points_for_all_pairs];
};

}  // namespace

void merge_points(std::vector<ContactPoint> &points, std::size_t capacity) {
  if (points.size() <= capacity) return;
  const std::size_t most = std::max(capacity, points_for_all_pairs);
  if (points.size() > most) keep_heaviest(points, most);
  if (points.size() <= capacity) return;
  CheapestPair pair(points);
  while (points.size() > capacity) pair.unite_cheapest();
}

}  // namespace cmb
