// Contact along a line: of capsules, and of cylinders and cones that lie on their side, with bounded convex shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"
#include "shape/shape.hpp"

namespace cmb {

// The line of a capsule, cylinder or cone that is the farthest along a direction.
class ContactLine {
 public:
  // `towards` (unit, world axes) points to the other shape.
  ContactLine(const Shape &shape, const Pose &pose, const Vec3 &towards);

  Vec3 operator()(double along) const { return middle_ + along * step_; }
  double half() const { return half_; }      // `along` runs from -half() to half()
  const Vec3 &step() const { return step_; }
  double radius() const { return radius_; }  // of the shape about it, roughly
  // Where along the line a point's foot is.
  double place(const Vec3 &p) const;

 private:
  Vec3 middle_, step_;
  double half_ = 0.0, radius_ = 0.0;
  double per_step2_ = 1.0;  // 1 / |step|^2
};

// Room that lines' contacts are made in; one for each thread.
struct LineManifoldScratch {
  // A corner of the depth's graph over the line.
  struct Station {
    double along = 0.0;  // m
    double depth = 0.0;  // may be negative
    Vec3 normal, position;  // where depth > 0
  };
  // A height above the line that changes evenly along it.
  struct Slope {
    double height, rate;
    double at(double along) const { return height - rate * along; }
  };
  std::vector<Station> stations;
  std::vector<Slope> roofs, floors;
  std::vector<std::int32_t> faces;
};

// Sine of the inclination at which a cylinder or cone no longer touches with its flat end, and with its side: a sixth of a
// right angle, but no more than the angle between a blunt cone's base and side. So the parts of both never exceed 1 together,
// and on the axis, where the side has no lowest line, the side's is 0.
double way_sine(const Shape &shape);

// How far a shape lies along a line on an obstacle in the direction `towards` (unit, in the shape's frame): 1 for a
// capsule, always; for a cylinder or cone 1 with its side flat, fading to 0 where that is inclined by more than
// way_sine tells; 0 for all others. `gradient` receives its derivative by `towards`.
double line_part(const Shape &shape, const Vec3 &towards, Vec3 &gradient);

// The following append what a line carries that lies, seen along the contact normal `normal` (unit, from the other shape to
// the line's), over another shape: how deep it is in there is a concave function of the place, and a corner's weight
// is the part of all inclinations under which it would be the deepest; the weights sum to 1. `deepest` is a
// point of the line's shape at the deepest place. The points' normals are `normal` times `sense`.

// There the line is `depth` (m) below the polytope's surface.
void line_on_polytope(const ContactLine &line, const convex::Polytope &other, const Pose &other_pose, const Vec3 &deepest,
                      double depth, const Vec3 &normal, double sense, LineManifoldScratch &scratch,
                      std::vector<ContactPoint> &points);

// `center`, `axis` (unit, outward) and `radius` are those of the other shape's flat end.
void line_on_disc(const ContactLine &line, const Vec3 &center, const Vec3 &axis, double radius, const Vec3 &deepest,
                  const Vec3 &normal, double sense, LineManifoldScratch &scratch, std::vector<ContactPoint> &points);

// Depths are those of spheres along the line in a capsule along the other: both of the shapes' radii.
void line_on_line(const ContactLine &line, const ContactLine &other, const Vec3 &deepest, const Vec3 &normal, double sense,
                  LineManifoldScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
