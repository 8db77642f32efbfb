// Two bodies with all the scenes they are asked in.
#pragma once

#include <memory>
#include <vector>

#include "certificates.hpp"
#include "pair_answer.hpp"
#include "solids.hpp"

namespace cmb::stress {

struct Bodies {
  Solid a, b;
  Axes axes_a, axes_b;  // of boxes and hulls
  std::unique_ptr<Pair> pair, fcl, libccd;
  std::vector<std::vector<std::unique_ptr<Pair>>> parts;  // where A or B is a mesh or a compound: by parts of A and B
  // Meshes push a body's surface as far as it faces them: how deep an overlap surely carries. A body that is unloaded may
  // have no such surface.
  double range = 0.0;
  // A corner or an edge of a mesh is felt by an ellipsoid, cylinder or cone once it is deeper than the round surface is off
  // the pieces that stand for it: this part of the size at most.
  double late = 0.0;
};

inline bool is_single(const Solid &solid) { return solid.nature == Nature::convex; }
inline bool is_hull(const Solid &solid) { return is_single(solid) && solid.parts[0].form == Part::Form::points; }
inline bool is_sheet(const Solid &solid) {
  return solid.nature == Nature::flat_sheet || solid.nature == Nature::rough_sheet;
}
inline bool is_mesh(const Solid &solid) { return solid.nature == Nature::closed_mesh || is_sheet(solid); }
// Parts that stand for the body as far as its distance is concerned.
inline bool has_parts(const Solid &solid) { return !solid.parts.empty(); }
inline double size_of(const Bodies &bodies) { return 2.0 * std::max(bodies.a.radius, bodies.b.radius); }

// Throws std::string where the engine refuses a body.
std::unique_ptr<Bodies> make_bodies(const Kind &a, const Kind &b, Random &random);

}  // namespace cmb::stress
