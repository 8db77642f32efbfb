#include "broadphase/near_pairs.hpp"

#include <cmath>

namespace cmb {

namespace {

// By how much of its longest side a box grows at each side.
constexpr double margin = 0.05;

bool lies_in(const Bounds &box, const Bounds &wide) {
  return (box.low.x >= wide.low.x) & (box.low.y >= wide.low.y) & (box.low.z >= wide.low.z) & (box.high.x <= wide.high.x) &
         (box.high.y <= wide.high.y) & (box.high.z <= wide.high.z);
}

}  // namespace

bool NearPairs::is_of(const std::shared_ptr<const void> &owner) const {
  return !owner_.owner_before(owner) && !owner.owner_before(owner_);
}

bool NearPairs::holds(const std::shared_ptr<const void> &owner, const std::vector<Bounds> &boxes) const {
  if (wide_.size() != boxes.size() || !is_of(owner)) return false;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!lies_in(boxes[i], wide_[i])) return false;
  }
  return true;
}

void NearPairs::forget(const std::shared_ptr<const void> &owner) {
  owner_ = owner;
  wide_.clear();
  pairs_.clear();
  uses_ = 0;
}

void NearPairs::widen(const std::vector<Bounds> &boxes) {
  wide_.clear();
  pairs_.clear();
  uses_ = 0;
  for (const Bounds &box : boxes) {
    const Vec3 extent = box.high - box.low;
    const double more = margin * std::fmax(extent.x, std::fmax(extent.y, extent.z));
    const Vec3 grown{more, more, more};
    wide_.push_back({box.low - grown, box.high + grown});
  }
}

}  // namespace cmb
