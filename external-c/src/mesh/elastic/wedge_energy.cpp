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

}  // namespace

WedgeEnergy::WedgeEnergy(const WedgeIntegrals &overlap, WedgeEnergyScratch &scratch)
    : factor_(overlap.factor()), deepest_(overlap.deepest()) {
  using Sums = WedgeEnergyScratch::Sums;
  const std::vector<Part> &parts = overlap.parts();
  const double uncarried = 1.0 - overlap.most_carried();
  Sums all;
  const auto add_part = [&](double share, const Part &part, Sums &sums) {
    sums.volume += share * part.first.integral;
    sums.surface += share * norm(part.first.gradient.force);
    sums.patch_area += share * (part.carrying_area + uncarried * part.area);
  };
  for (const Part &part : parts) {
    if (part.first.integral > 0.0) add_part(1.0, part, all);
  }
  scratch.sums.assign(parts.size(), all);
  scratch.apart.clear();
  const FaceRelations &relations = overlap.mesh().face_relations();
  for (std::size_t i = 0; i < parts.size() && !relations.all_together(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = 1.0 - relations.together(parts[i].face, parts[j].face);
      if (!(apart > 0.0) || !(parts[i].first.integral > 0.0) || !(parts[j].first.integral > 0.0)) continue;
      scratch.apart.push_back({i, j, apart});
      add_part(-apart, parts[i], scratch.sums[j]);
      add_part(-apart, parts[j], scratch.sums[i]);
    }
  }
  double by_volume = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!(parts[i].first.integral > 0.0)) continue;
    Sums &sums = scratch.sums[i];
    // Of its own share rounding of the others' takes nothing.
    Sums own;
    add_part(1.0, parts[i], own);
    sums.volume = std::fmax(sums.volume, own.volume);
    sums.surface = std::fmax(sums.surface, own.surface);
    sums.patch_area = std::fmax(sums.patch_area, own.patch_area);
    energy_ += 0.5 * factor_ * parts[i].third.integral / sums.volume;
    by_volume += sums.energy_by_volume(parts[i]);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) scratch.sums[i].by_volume = by_volume;
  for (const WedgeEnergyScratch::Apart &pair : scratch.apart) {
    scratch.sums[pair.i].by_volume -= pair.apart * scratch.sums[pair.j].energy_by_volume(parts[pair.j]);
    scratch.sums[pair.j].by_volume -= pair.apart * scratch.sums[pair.i].energy_by_volume(parts[pair.i]);
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part &part = parts[i];
    if (!(part.first.integral > 0.0)) continue;
    const Sums &sums = scratch.sums[i];
    const double known = known_part(sums.volume / (sums.surface * overlap.radius()), overlap.hardly_known());
    add(-0.5 * factor_ * known / sums.volume, part.third.gradient, wrench_);
    add(0.5 * factor_ * known * sums.by_volume, part.first.gradient, wrench_);
    if (!(part.load > 0.0)) continue;
    touches_ = deepest_ > 0.0;
    patches_.add(1.0 / sums.patch_area, part.patches);
    add((1.0 - known) / sums.patch_area, part.push, wrench_);
  }
}

double WedgeEnergy::carrying_depth() const { return std::sqrt(deepest_ * std::sqrt(2.0 * energy_) / factor_); }

}  // namespace cmb::mesh
