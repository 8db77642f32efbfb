// What the overlaps behind all faces of a mesh store together.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/elastic/direction_patches.hpp"
#include "mesh/elastic/wedge_integrals.hpp"

namespace cmb::mesh {

// Room for the sums; grows in the first calls.
struct WedgeEnergyScratch {
  // What a part counts by: sums over all parts, as far as they are one with it.
  struct Sums {
    double volume = 0.0, surface = 0.0, patch_area = 0.0;
    double by_volume = 0.0;  // of all parts' energy_by_volume

    // Minus the derivative of the part's energy by its volume sum, but for factor/2.
    double energy_by_volume(const WedgeIntegrals::Part &part) const { return part.third.integral / (volume * volume); }
  };
  struct Apart {
    std::size_t i, j;
    double apart;  // 1 - K
  };
  std::vector<Sums> sums;
  std::vector<Apart> apart;
};

// The overlap of body and mesh stores
//
//   E = factor/2 sum_f I3_f / N_f,   N_f = sum_g K_fg I1_g,
//
// K_fg of faces f and g being FaceRelations' together(f, g). Where all are, that is factor 3/2 (mean of s^2): by factor 1 a face pressed in flat
// stores d^2/2, whatever its area. A floor and a wall store what each does alone. K is the mesh's own: the gradient is that of the
// integrals, exact for any wedges and any K.
//
// What faces the triangles, as patches, counts the same way: a load by the area of all that are one with it.
class WedgeEnergy {
 public:
  WedgeEnergy(const WedgeIntegrals &overlap, WedgeEnergyScratch &scratch);

  // Whether the mesh's front pushes surface that faces it.
  bool touches() const { return touches_; }
  double energy() const { return energy_; }
  // On the body; torque about the integrals' origin. Of what is so thin that its gradient is rounding that of its patches.
  const Wrench &wrench() const { return wrench_; }
  // By depth and area.
  const DirectionPatches &patches() const { return patches_; }

  // About how deep the body's surface lies in the mesh's, between its deepest place and its mean: of a corner the first, which what passes
  // through a body is compared with, is much more.
  double carrying_depth() const;

 private:
  double factor_, deepest_, energy_ = 0.0;
  bool touches_ = false;
  Wrench wrench_;
  DirectionPatches patches_;
};

}  // namespace cmb::mesh
