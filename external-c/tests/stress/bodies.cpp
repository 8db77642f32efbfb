#include "bodies.hpp"

namespace cmb::stress {

std::unique_ptr<Bodies> make_bodies(const Kind &kind_a, const Kind &kind_b, Random &random) {
  auto bodies = std::make_unique<Bodies>();
  bodies->a = kind_a.make(random);
  bodies->b = kind_b.make(random);
  const Solid &a = bodies->a, &b = bodies->b;
  bodies->pair = std::make_unique<Pair>(a.text, b.text);
  if (is_single(a) && is_single(b)) {
    bodies->fcl = std::make_unique<Pair>(a.text, b.text, CMB_BACKEND_FCL);
    bodies->libccd = std::make_unique<Pair>(a.text, b.text, CMB_BACKEND_LIBCCD);
  }
  if (is_hull(a) && is_hull(b)) {
    bodies->axes_a = axes_of(a.parts[0].points);
    bodies->axes_b = axes_of(b.parts[0].points);
  }
  if (has_parts(a) && has_parts(b) && !(is_single(a) && is_single(b))) {
    for (const Part &part : a.parts) {
      bodies->parts.emplace_back();
      for (const Part &other : b.parts) bodies->parts.back().push_back(std::make_unique<Pair>(part.text, other.text));
    }
  }
  return bodies;
}

}  // namespace cmb::stress
