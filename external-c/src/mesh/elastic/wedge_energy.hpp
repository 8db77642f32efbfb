// What the overlaps behind all faces of a mesh store together.
#pragma once

#include <cstddef>
#include <vector>

#include "mesh/elastic/direction_patches.hpp"
#include "mesh/elastic/part_owners.hpp"
#include "mesh/elastic/wedge_integrals.hpp"

namespace cmb::mesh {

// Room for the sums; grows in the first calls.
struct WedgeEnergyScratch {
  // Of one part, or of several as far as they are one.
  struct Sums {
    double second = 0.0, fourth = 0.0;  // I2 and I4
    double surface = 0.0, depth_load = 0.0, mean_load = 0.0;

    void add(double share, const Sums &other) {
      second += share * other.second, fourth += share * other.fourth, surface += share * other.surface;
      depth_load += share * other.depth_load, mean_load += share * other.mean_load;
    }
  };
  std::vector<Sums> own, owned;   // of each part, and of what counts as it (PartOwners)
  std::vector<Sums> joint;        // of all that is one with that
  std::vector<Sums> divisors;     // of each part, the means of these over what it counts as
  std::vector<double> by_second, by_fourth;  // the energy's derivatives by the parts' I2 and I4, by factor/2
  std::vector<double> by_joint;   // minus that by what counts as each part
  std::vector<double> together;   // K of parts i and j < i, at i (i - 1) / 2 + j; none where it is 1 for all
  PartOwners owners;
};

// The overlap of body and mesh stores
//
//   E = factor/2 sum_f I4_f / N_f,   N_f = sum_g K_fg I2_g,
//
// K_fg of faces f and g being FaceRelations' together(f, g), I2_f and I4_f integrals over what counts as f (PartOwners). Where all are, that is factor times the integral of s^3 by that of s: by factor 1 a face
// pressed in flat stores d^2/2, whatever its area. A floor and a wall store what each does alone. K is the mesh's own: the gradient is that of the
// integrals, exact for any wedges and any K. Both begin with the square of the depth, so that the force is continuous where a flat side of the body
// comes to a flat side of the mesh all at once: with I3 and I1 the volume would grow by all of it, and the energy have an edge there.
//
// What faces the triangles, as patches, counts the same way: faces that are one carry the mean of their depths, each place counting by its depth and each
// face by its part of the depth's square. (By area a wide side that hardly touches would take away the load of an edge beside it.)
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
  void add_all_together(WedgeEnergyScratch &scratch);
  void add_apart(const WedgeIntegrals &overlap, WedgeEnergyScratch &scratch);

  double factor_, lowest_, energy_ = 0.0;
  bool touches_ = false;
  Wrench wrench_;
  DirectionPatches patches_;
};

}  // namespace cmb::mesh
