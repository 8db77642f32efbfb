#include "manifold/revolved/passages.hpp"

#include <cmath>
#include <cstddef>

namespace cmb {

bool Passages::take_arc(double rounding, Arc &arc) {
  std::size_t first = 0;
  while (first < list_.size() && !list_[first].to_curve) ++first;
  if (first == list_.size()) return false;
  arc.from = list_[first];
  list_[first] = list_.back();
  list_.pop_back();
  // The nearest ahead; those that are behind come after all that are ahead, in their order.
  std::size_t best = list_.size();
  double nearest = HUGE_VAL;
  bool best_round = true;
  for (std::size_t k = 0; k < list_.size(); ++k) {
    if (list_[k].to_curve) continue;
    const double way = list_[k].key - arc.from.key;
    const bool round = way < -rounding;
    if ((best_round && !round) || (round == best_round && way < nearest)) best = k, nearest = way, best_round = round;
  }
  if (best == list_.size()) return false;
  arc.to = list_[best];
  arc.round = best_round;
  list_[best] = list_.back();
  list_.pop_back();
  arc.empty = !arc.round && nearest <= rounding;
  return true;
}

}  // namespace cmb
