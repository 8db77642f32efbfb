#include "manifold/contact_set.hpp"

#include <algorithm>

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

}  // namespace

void merge_points(std::vector<ContactPoint> &points, std::size_t capacity) {
  if (points.size() <= capacity) return;
  const std::size_t few = std::max(capacity, points_for_all_pairs);
  if (points.size() > few) keep_heaviest(points, few);
  while (points.size() > capacity) {
    std::size_t first = 0, second = 1;
    double least = -1.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        const double cost = union_cost(points[i], points[j]);
        if (least < 0.0 || cost < least) {
          least = cost;
          first = i;
          second = j;
        }
      }
    }
    points[first] = united(points[first], points[second]);
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

}  // namespace cmb
