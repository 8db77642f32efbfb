#include "mesh/elastic/part_owners.hpp"

#include <algorithm>
#include <cmath>

#include "math/smoothstep.hpp"

namespace cmb::mesh {

namespace {

// A square of about how deep a part is, I4/I2, and whether its content tells; where it is next to rounding its surface does.
struct SquareOfDepth {
  double value = 0.0;
  bool of_content = false;

  SquareOfDepth(const WedgeIntegrals::Part &part, double radius) {
    constexpr double rounding = 1e-13;
    const double second = part.second.value(), surface = norm(part.second.gradient.force);
    of_content = second > rounding * surface * radius;
    if (of_content) {
      value = part.fourth.value() / second;
    } else if (surface > 0.0) {
      value = norm(part.fourth.gradient.force) / surface;
    }
  }
};

}  // namespace

void PartOwners::assign(const FaceRelations &relations, const std::vector<WedgeIntegrals::Part> &parts, double radius) {
  own_.assign(parts.size(), {});
  given_.clear();
  double most = 0.0;
  for (const WedgeIntegrals::Part &part : parts) most = std::max(most, part.second.value());
  if (!(most > 0.0)) return;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double second = parts[i].second.value(), fourth = parts[i].fourth.value();
    own_[i].content = second / most;
    if (second > 0.0) own_[i].by_second = 1.0 / second;
    if (fourth > 0.0) own_[i].by_fourth = 1.0 / fourth;
    for (std::size_t j = 0; j < i; ++j) {
      if (!relations.go_over(parts[i].face, parts[j].face)) continue;
      given_.push_back({i, j}), given_.push_back({j, i});
      own_[i].beside += own_[j].content * own_[j].content;
      own_[j].beside += own_[i].content * own_[i].content;
    }
  }
  constexpr double least = 1e-200;  // of which nothing can be divided
  for (Own &own : own_) {
    if (!(own.beside > least)) continue;
    const double ratio = own.content * own.content / own.beside;
    own.little = convex::falling_smoothstep(ratio);
    own.slope = convex::falling_smoothstep_slope(ratio);
  }
  given_.erase(std::remove_if(given_.begin(), given_.end(), [&](const Given &given) { return !(own_[given.from].little > 0.0); }), given_.end());
  for (Given &given : given_) {
    constexpr double unlike = 0.1;  // a third as deep
    const SquareOfDepth from(parts[given.from], radius), to(parts[given.to], radius);
    if (!(to.value > 0.0)) continue;
    const double ratio = from.value / (unlike * to.value);
    given.alike = 1.0 - convex::falling_smoothstep(ratio);
    if (from.of_content && to.of_content) given.slope = -convex::falling_smoothstep_slope(ratio) * ratio;
    own_[given.from].kept -= share_of(given);
  }
}

}  // namespace cmb::mesh
