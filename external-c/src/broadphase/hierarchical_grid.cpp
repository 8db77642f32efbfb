#include "broadphase/hierarchical_grid.hpp"

namespace cmb {

void HierarchicalGrid::prepare(const std::vector<Bounds> &boxes) {
  entries_.resize(boxes.size());
  order_.resize(boxes.size());
  levels_.clear();
  if (boxes.empty()) return;

  int smallest = 0, largest = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Vec3 extent = boxes[i].high - boxes[i].low;
    int exponent = 0;
    std::frexp(std::fmax(extent.x, std::fmax(extent.y, extent.z)), &exponent);  // extent < 2^exponent
    smallest = i == 0 ? exponent : std::min(smallest, exponent);
    largest = i == 0 ? exponent : std::max(largest, exponent);
    const double size = std::ldexp(1.0, exponent);
    const Vec3 center = 0.5 * (boxes[i].low + boxes[i].high);
    entries_[i] = {{cell_of(center.x, size), cell_of(center.y, size), cell_of(center.z, size)}, exponent, none};
  }

  const std::size_t level_count = static_cast<std::size_t>(largest - smallest) + 1;
  level_begin_.assign(level_count + 1, 0);
  for (const Entry &entry : entries_) ++level_begin_[static_cast<std::size_t>(largest - entry.exponent) + 1];
  for (std::size_t k = 0; k < level_count; ++k) {
    if (level_begin_[k + 1] > 0) {
      const int exponent = largest - static_cast<int>(k);
      levels_.push_back(
          {exponent, std::ldexp(1.0, exponent), level_begin_[k], level_begin_[k] + level_begin_[k + 1]});
    }
    level_begin_[k + 1] += level_begin_[k];
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    order_[level_begin_[static_cast<std::size_t>(largest - entries_[i].exponent)]++] = static_cast<std::uint32_t>(i);
  }

  std::size_t bucket_count = 2;
  bucket_shift_ = 63;
  while (bucket_count < 2 * boxes.size()) {
    bucket_count *= 2;
    --bucket_shift_;
  }
  buckets_.assign(bucket_count, none);
}

}  // namespace cmb
