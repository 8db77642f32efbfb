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
};

inline bool is_single(const Solid &solid) { return solid.nature == Nature::convex; }
inline bool is_hull(const Solid &solid) { return is_single(solid) && solid.parts[0].form == Part::Form::points; }
inline bool is_sheet(const Solid &solid) {
  return solid.nature == Nature::flat_sheet || solid.nature == Nature::rough_sheet;
}
// Parts that stand for the body as far as its distance is concerned.
inline bool has_parts(const Solid &solid) { return !solid.parts.empty(); }
inline double size_of(const Bodies &bodies) { return 2.0 * std::max(bodies.a.radius, bodies.b.radius); }

// Throws std::string where the engine refuses a body.
std::unique_ptr<Bodies> make_bodies(const Kind &a, const Kind &b, Random &random);

}  // namespace cmb::stress
