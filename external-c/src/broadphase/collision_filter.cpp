#include "broadphase/collision_filter.hpp"

#include <algorithm>

namespace cmb {

CollisionFilter::CollisionFilter(std::vector<FilterEntry> bodies,
                                 const std::vector<std::pair<std::size_t, std::size_t>> &excluded)
    : bodies_(std::move(bodies)), first_(bodies_.size() + 1, 0), partners_(2 * excluded.size()) {
  for (const auto &[a, b] : excluded) {
    ++first_[a + 1];
    ++first_[b + 1];
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) first_[i + 1] += first_[i];
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (const auto &[a, b] : excluded) {
    partners_[next[a]++] = b;
    partners_[next[b]++] = a;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    std::sort(partners_.begin() + static_cast<std::ptrdiff_t>(first_[i]),
              partners_.begin() + static_cast<std::ptrdiff_t>(first_[i + 1]));
  }
}

bool CollisionFilter::may_touch(std::size_t a, std::size_t b) const {
  if (a == b) return false;
  const FilterEntry &one = bodies_[a], &other = bodies_[b];
  if (one.fixed && other.fixed) return false;
  if ((one.group & other.mask) == 0 || (other.group & one.mask) == 0) return false;
  return !std::binary_search(partners_.begin() + static_cast<std::ptrdiff_t>(first_[a]),
                             partners_.begin() + static_cast<std::ptrdiff_t>(first_[a + 1]), b);
}

}  // namespace cmb
