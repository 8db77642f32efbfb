// Bodies of round lengths with what others may be level with: faces, edges, corners, axes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stress/solids.hpp"

namespace cmb::aligned {

using random_bodies::Random;
using stress::Part;
using convex::Mat3;
using convex::Vec3;
using convex::normalized;

// A place of the surface with a way out of the body there (unit): the normal of a face or of a mantle, what is between the normals at an
// edge, a rim or a corner.
struct Feature {
  Vec3 place, outward;
};

struct Body {
  std::string text;                // descriptor
  std::vector<Part> parts;         // whose reach is the body's, in the body's frame
  std::vector<Feature> features;
  std::vector<Vec3> ways;          // unit, along edges, axes and normals
  double size = 1.0;               // a length that motions are measured by, m
  double thickness = 1.0;          // the least width of what it is made of, m
  Vec3 middle;                     // of a ball that holds it,
  double radius = 1.0;             // so large
  std::function<bool(const Vec3 &)> swallows;  // of ground: whether a place is below its surface
};

struct Kind {
  const char *name;
  bool ground;         // second in its pairs: others come from above
  double least_depth;  // by the thinner body's thickness: less deep, what rounding does to the pose is no small part of the overlap (docs/engine/limits.md)
  double part;         // of the poses that others get, as its queries take longer
  Body (*make)(Random &random);
};

const std::vector<Kind> &all_kinds();
// Null where no kind has the name.
const Kind *find_kind(const std::string &name);

}  // namespace cmb::aligned
