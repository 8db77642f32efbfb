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

WedgeEnergyScratch::Sums sums_of(const Part &part) {
  WedgeEnergyScratch::Sums sums{part.second.value(), part.fourth.value(), norm(part.second.gradient.force), 0.0, 0.0};
  if (part.load > 0.0) sums.depth_load = part.depth_load, sums.mean_load = part.depth_load * part.mean_depth();
  return sums;
}

double by(double numerator, double divisor) { return divisor > 0.0 ? numerator / divisor : 0.0; }

// Calls act(i, j, K) for all of two parts that are one in part, i = j included. Beside a part that stores next to nothing those of which it is
// apart may be 1e30 times as great: what is one is added, and nothing taken off. What has no content but surface, a side in the plane between two
// wedges, counts with those that it is one with.
template <typename Act>
void visit_together(const WedgeEnergyScratch &scratch, Act &&act) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < scratch.own.size(); ++i) {
    act(i, i, 1.0);
    for (std::size_t j = 0; j < i; ++j, ++at) {
      const double share = scratch.together[at];
      if (share > 0.0) act(i, j, share), act(j, i, share);
    }
  }
}

}  // namespace

void WedgeEnergy::add_all_together(WedgeEnergyScratch &scratch) {
  WedgeEnergyScratch::Sums all;
  for (const WedgeEnergyScratch::Sums &own : scratch.own) all.add(1.0, own);
  const std::size_t count = scratch.own.size();
  energy_ = 0.5 * factor_ * by(all.fourth, all.second);
  scratch.divisors.assign(count, all);
  scratch.by_fourth.assign(count, by(1.0, all.second));
  scratch.by_second.assign(count, -by(all.fourth, all.second * all.second));
}

void WedgeEnergy::add_apart(const WedgeIntegrals &overlap, WedgeEnergyScratch &scratch) {
  const FaceRelations &relations = overlap.mesh().face_relations();
  const std::vector<Part> &parts = overlap.parts();
  const std::size_t count = parts.size();
  scratch.together.clear();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < i; ++j) scratch.together.push_back(relations.together(parts[i].face, parts[j].face));
  }
  PartOwners &owners = scratch.owners;
  owners.assign(relations, parts, overlap.radius());
  scratch.owned.assign(count, {});
  scratch.joint.assign(count, {});
  scratch.divisors.assign(count, {});
  scratch.by_fourth.assign(count, 0.0);
  scratch.by_second.assign(count, 0.0);
  scratch.by_joint.assign(count, 0.0);
  owners.visit([&](std::size_t i, std::size_t j, double share) { scratch.owned[j].add(share, scratch.own[i]); });
  visit_together(scratch, [&](std::size_t i, std::size_t j, double share) { scratch.joint[i].add(share, scratch.owned[j]); });
  for (std::size_t i = 0; i < count; ++i) energy_ += 0.5 * factor_ * by(scratch.owned[i].fourth, scratch.joint[i].second);
  visit_together(scratch, [&](std::size_t i, std::size_t j, double share) {
    scratch.by_joint[i] += share * by(scratch.owned[j].fourth, scratch.joint[j].second * scratch.joint[j].second);
  });
  owners.visit([&](std::size_t i, std::size_t j, double share) {
    scratch.divisors[i].add(share, scratch.joint[j]);
    scratch.by_fourth[i] += share * by(1.0, scratch.joint[j].second);
    scratch.by_second[i] -= share * scratch.by_joint[j];
  });
  owners.add_derivatives(
      [&](std::size_t i, std::size_t j) {
        return by(scratch.own[i].fourth, scratch.joint[j].second) - scratch.own[i].second * scratch.by_joint[j];
      },
      scratch.by_second, scratch.by_fourth);
}

WedgeEnergy::WedgeEnergy(const WedgeIntegrals &overlap, WedgeEnergyScratch &scratch)
    : factor_(overlap.factor()), lowest_(overlap.lowest()) {
  const std::vector<Part> &parts = overlap.parts();
  const double most_carried = overlap.most_carried();
  scratch.own.clear();
  for (const Part &part : parts) scratch.own.push_back(sums_of(part));
  if (overlap.mesh().face_relations().all_together()) {
    add_all_together(scratch);
  } else {
    add_apart(overlap, scratch);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part &part = parts[i];
    const WedgeEnergyScratch::Sums &sums = scratch.divisors[i];
    if (!(sums.second > 0.0)) continue;
    const double known = known_part(2.0 * sums.second / (sums.surface * overlap.radius()), overlap.hardly_known());
    add(-0.5 * factor_ * known * scratch.by_fourth[i], part.fourth.gradient, wrench_);
    add(-0.5 * factor_ * known * scratch.by_second[i], part.second.gradient, wrench_);
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
