#include "mesh/elastic/wedge_energy.hpp"

#include <cmath>

#include "math/smoothstep.hpp"

namespace cmb::mesh {

namespace {

using Part = WedgeIntegrals::Part;

void add(double part, const Wrench &wrench, Wrench &sum) {
  sum.force = sum.force + part * wrench.force;
  sum.torque = sum.torque + part * wrench.torque;
}

// From 0, where an overlap is so thin that its gradient is rounding, to 1.
double known_part(double thickness, double hardly_known) {
  if (!(hardly_known > 0.0)) return 1.0;
  constexpr double well_known = 10.0;
  return 1.0 - convex::falling_smoothstep(std::fmax(0.0, std::log(thickness / hardly_known) / std::log(well_known)));
}

// Of what goes on beyond the wedges, as of a body right through the mesh, hardly any surface faces a triangle: rounding may have sides upright on it do so.
double facing_part(const WedgeEnergyScratch::Sums &sums) {
  constexpr double enough = 0.1;
  return std::fmin(1.0, sums.depth_load / (enough * sums.second));
}

}  // namespace

WedgeEnergy::WedgeEnergy(const WedgeIntegrals &overlap, WedgeEnergyScratch &scratch)
    : factor_(overlap.factor()), lowest_(overlap.lowest()) {
  using Sums = WedgeEnergyScratch::Sums;
  const std::vector<Part> &parts = overlap.parts();
  const double most_carried = overlap.most_carried();
  const auto add_part = [&](double share, const Part &part, Sums &sums) {
    sums.second += share * part.second.value();
    sums.surface += share * norm(part.second.gradient.force);
    if (part.load > 0.0) sums.depth_load += share * part.depth_load, sums.mean_load += share * part.depth_load * part.mean_depth();
  };
  const FaceRelations &relations = overlap.mesh().face_relations();
  scratch.together.clear();
  for (std::size_t i = 0; i < parts.size() && !relations.all_together(); ++i) {
    for (std::size_t j = 0; j < i; ++j) scratch.together.push_back(relations.together(parts[i].face, parts[j].face));
  }
  // Calls act(part i, part j, K) for all of two that are one in part, i = j included. Beside a part that stores next to nothing those of which it is
  // apart may be 1e30 times as great: what is one is added, and nothing taken off. What has no content but surface, a side in the plane between two
  // wedges, counts with those that it is one with.
  const auto visit_pairs = [&](auto &&act) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      act(i, i, 1.0);
      for (std::size_t j = 0; j < i; ++j, ++at) {
        const double share = scratch.together[at];
        if (share > 0.0) act(i, j, share), act(j, i, share);
      }
    }
  };
  scratch.sums.assign(parts.size(), {});
  if (relations.all_together()) {
    Sums all;
    for (const Part &part : parts) add_part(1.0, part, all);
    for (const Part &part : parts) all.by_second += all.energy_by_second(part);
    scratch.sums.assign(parts.size(), all);
  } else {
    visit_pairs([&](std::size_t i, std::size_t j, double share) { add_part(share, parts[j], scratch.sums[i]); });
    visit_pairs([&](std::size_t i, std::size_t j, double share) {
      scratch.sums[i].by_second += share * scratch.sums[j].energy_by_second(parts[j]);
    });
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (scratch.sums[i].second > 0.0) energy_ += 0.5 * factor_ * parts[i].fourth.value() / scratch.sums[i].second;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part &part = parts[i];
    const Sums &sums = scratch.sums[i];
    if (!(sums.second > 0.0)) continue;
    const double known = known_part(2.0 * sums.second / (sums.surface * overlap.radius()), overlap.hardly_known());
    add(-0.5 * factor_ * known / sums.second, part.fourth.gradient, wrench_);
    add(0.5 * factor_ * known * sums.by_second, part.second.gradient, wrench_);
    if (!(part.load > 0.0 && sums.depth_load > 0.0)) continue;  // squares of the least depths are 0
    touches_ = overlap.deepest() > 0.0;
    const double by_area = most_carried * facing_part(sums) * (part.mean_depth() / sums.depth_load) * (sums.mean_load / sums.depth_load);
    patches_.add(by_area, part.patches);
    add((1.0 - known) * by_area, part.push, wrench_);
  }
}

double WedgeEnergy::carrying_depth() const {
  constexpr double part = 0.8;  // with more, bodies come to rest between the sides of a wall more often (test_pierced_mesh)
  return part * std::cbrt(2.0 * lowest_ * energy_) / std::sqrt(factor_);
}

}  // namespace cmb::mesh
