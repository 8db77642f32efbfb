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

}  // namespace

void merge_points(std::vector<ContactPoint> &points, std::size_t capacity) {
  while (points.size() > capacity) {
    std::size_t first = 0, second = 1;
    double least = -1.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double load_i = points[i].weight * points[i].depth;
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        const double load_j = points[j].weight * points[j].depth;
        const double cost = load_i * load_j / (load_i + load_j) * norm2(points[i].position - points[j].position);
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
