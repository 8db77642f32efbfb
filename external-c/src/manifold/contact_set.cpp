#include "manifold/contact_set.hpp"

#include <algorithm>

namespace cmb {

double total_load(const std::vector<ContactPoint> &points, std::size_t begin) {
  double load = 0.0;
  for (std::size_t i = begin; i < points.size(); ++i) load += points[i].weight * points[i].depth;
  return load;
}

void limit_load(std::vector<ContactPoint> &points, std::size_t begin) {
  double deepest = 0.0;
  for (std::size_t i = begin; i < points.size(); ++i) deepest = std::max(deepest, points[i].depth);
  const double load = total_load(points, begin);
  if (!(load > deepest)) return;
  for (std::size_t i = begin; i < points.size(); ++i) points[i].weight *= deepest / load;
}

namespace {

// Up to this many points the best of all pairs is united.
constexpr std::size_t points_for_all_pairs = 32;

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

// The point that is cheapest to unite with points[k], and the cost.
std::size_t cheapest_partner(const std::vector<ContactPoint> &points, std::size_t k, std::size_t begin, double &cost) {
  std::size_t partner = k;
  for (std::size_t j = begin; j < points.size(); ++j) {
    if (j == k) continue;
    const double candidate = union_cost(points[k], points[j]);
    if (partner == k || candidate < cost) {
      cost = candidate;
      partner = j;
    }
  }
  return partner;
}

void unite(std::vector<ContactPoint> &points, std::size_t first, std::size_t second) {
  points[first] = united(points[first], points[second]);
  points.erase(points.begin() + static_cast<std::ptrdiff_t>(second));
}

}  // namespace

void merge_points(std::vector<ContactPoint> &points, std::size_t capacity) {
  // Very many points: the least loaded one goes first, which takes one pass instead of one over all pairs.
  while (points.size() > std::max(capacity, points_for_all_pairs)) {
    const auto least = std::min_element(points.begin(), points.end(), [](const ContactPoint &x, const ContactPoint &y) {
      return x.weight * x.depth < y.weight * y.depth;
    });
    const auto first = static_cast<std::size_t>(least - points.begin());
    double cost = 0.0;
    const std::size_t partner = cheapest_partner(points, first, 0, cost);
    unite(points, std::min(first, partner), std::max(first, partner));
  }
  while (points.size() > capacity) {
    std::size_t first = 0, second = 1;
    double least = -1.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      double cost = 0.0;
      const std::size_t partner = cheapest_partner(points, i, i + 1, cost);
      if (least < 0.0 || cost < least) {
        least = cost;
        first = i;
        second = partner;
      }
    }
    unite(points, first, second);
  }
}

}  // namespace cmb
