// Pairs of boxes that may overlap, kept as long as the boxes move little.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "broadphase/hierarchical_grid.hpp"
#include "shape/bounds.hpp"

namespace cmb {

// An integrator asks for poses that follow each other. So pairs are looked for among boxes that are a little larger than
// asked for, and as long as every box lies in its larger one, no other pair can overlap. What is kept saves time and
// changes no answer: the pairs that overlap are those of the boxes at hand, in an order that may differ.
class NearPairs {
 public:
  // Calls visit(i, j) once for each pair of overlapping boxes that `wanted(i, j)` takes, which must always answer the same for
  // one `owner`: pairs of another owner are forgotten.
  template <typename Wanted, typename Visit>
  void visit_overlaps(const std::shared_ptr<const void> &owner, const std::vector<Bounds> &boxes, Wanted &&wanted, Visit &&visit) {
    if (!holds(owner, boxes)) {
      // Poses that jumped may jump again: then nothing is gained by larger boxes.
      if (!is_of(owner) || (!wide_.empty() && uses_ == 0)) {
        forget(owner);
        grid_.visit_overlaps(boxes, [&](std::uint32_t i, std::uint32_t j) {
          if (wanted(i, j)) visit(i, j);
        });
        return;
      }
      widen(boxes);
      grid_.visit_overlaps(wide_, [&](std::uint32_t i, std::uint32_t j) {
        if (wanted(i, j)) pairs_.emplace_back(i, j);
      });
    } else {
      ++uses_;
    }
    for (const auto &[i, j] : pairs_) {
      if (overlap(boxes[i], boxes[j])) visit(i, j);
    }
  }

 private:
  bool is_of(const std::shared_ptr<const void> &owner) const;
  bool holds(const std::shared_ptr<const void> &owner, const std::vector<Bounds> &boxes) const;
  void forget(const std::shared_ptr<const void> &owner);
  void widen(const std::vector<Bounds> &boxes);

  HierarchicalGrid grid_;
  std::weak_ptr<const void> owner_;
  std::vector<Bounds> wide_;  // empty where nothing is kept
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
  std::size_t uses_ = 0;  // of the pairs, beside the search that found them
};

}  // namespace cmb
