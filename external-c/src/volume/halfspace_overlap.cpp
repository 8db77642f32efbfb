#include "volume/halfspace_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/gauss_rule.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

using overlap::gauss_rule;

// Calls visit(x, weight) at the nodes of a rule on each of the stretches that the places in between cut [begin, end] into.
// Towards the ends of a stretch nodes crowd, so that roots there do no harm.
template <typename Visit>
void integrate(double begin, double end, std::array<double, 6> between, int count, Visit visit) {
  const auto &rule = gauss_rule<20>;
  for (int k = 1; k < count; ++k) {  // in order; there are few
    for (int j = k; j > 0 && between[static_cast<std::size_t>(j)] < between[static_cast<std::size_t>(j - 1)]; --j) {
      std::swap(between[static_cast<std::size_t>(j)], between[static_cast<std::size_t>(j - 1)]);
    }
  }
  double from = begin;
  for (int piece = 0; piece <= count; ++piece) {
    const double to = piece < count ? std::clamp(between[static_cast<std::size_t>(piece)], from, end) : end;
    const double length = to - from;
    if (length > 0.0) {
      for (std::size_t k = 0; k < rule.node.size(); ++k) {
        const double s = rule.node[k];
        visit(from + length * s * s * (3.0 - 2.0 * s), length * rule.weight[k] * 6.0 * s * (1.0 - s));
      }
    }
    from = to;
  }
}

// Places where a cosine has a given value, in (0, pi).
struct Angles {
  std::array<double, 6> at{};
  int count = 0;
  void add(double over, double under) {
    if (std::fabs(over) < std::fabs(under)) at[static_cast<std::size_t>(count++)] = std::acos(over / under);
  }
};

// Adds up a surface, element by element.
class Surface {
 public:
  Surface(const Vec3 &origin, const Vec3 &up) : origin_(origin), up_(up) {}

  double height(const Vec3 &p) const { return dot(p - origin_, up_); }

  // The element of outward area `area` at p counts as the solid's border, and, where it looks down, as that of its shadow.
  void add(const Vec3 &p, const Vec3 &area, bool of_solid = true, bool of_shadow = true) {
    const Vec3 from = p - origin_;
    const double h = dot(from, up_), upward = dot(area, up_);
    const Vec3 level = from - h * up_;
    if (of_solid) {
      // div(h up) = 1 and so on; these fields vanish in the plane.
      sums.volume += h * upward;
      sums.volume_moment = sums.volume_moment + (h * upward) * (level + (0.5 * h) * up_);
    }
    if (of_shadow && upward < 0.0) {
      sums.shadow -= upward;
      sums.shadow_moment = sums.shadow_moment - upward * level;
      sums.lower_height -= upward * h;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) sums.shadow_second[i][j] -= upward * level[i] * level[j];
      }
    }
  }

  SolidBelowPlane sums;

 private:
  Vec3 origin_, up_;
};

// Sine of an angle that counts as none: rounding of unit vectors.
constexpr double least_slant = 1e-15;

// Axes of a body of revolution: `aside` lies in the plane of its axis and the plane's normal, which has the sine `slant`
// along it.
struct Axes {
  Vec3 axis, aside, across;
  double cosine, slant;
  Axes(const Vec3 &body_axis, const Vec3 &up) : axis(body_axis), cosine(dot(body_axis, up)) {
    // What is left of the normal is as small as rounding where both are parallel, and then has a part along the axis: taken
    // away twice. Below, its direction means nothing.
    Vec3 level = up - cosine * axis;
    level = level - dot(level, axis) * axis;
    slant = norm(level);
    const bool parallel = slant < least_slant;
    aside = parallel ? convex::any_perpendicular(axis) : normalized(level);
    if (parallel) slant = 0.0;
    across = cross(axis, aside);
  }
};

// The surface that a straight line sweeps about the axis, from radius r0 at z0 to r1 at z1, outward on the right-hand side
// of that way: a side, a mantle, an end.
void add_swept_line(const Vec3 &center, const Axes &axes, double r0, double z0, double r1, double z1, Surface &surface) {
  const auto &rule = gauss_rule<3>;  // cubic along the line
  const double dr = r1 - r0, dz = z1 - z0;
  const double h0 = surface.height(center + z0 * axes.axis), h1 = surface.height(center + z1 * axes.axis);
  Angles angles;
  angles.add(-h0, r0 * axes.slant);
  angles.add(-h1, r1 * axes.slant);
  angles.add(dr * axes.cosine, dz * axes.slant);  // where it looks level
  integrate(0.0, pi, angles.at, angles.count, [&](double angle, double weight) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double begin_height = h0 + r0 * axes.slant * c, end_height = h1 + r1 * axes.slant * c;
    double begin = 0.0, end = 1.0;
    if (begin_height >= 0.0 && end_height >= 0.0) return;
    if (begin_height > 0.0) begin = begin_height / (begin_height - end_height);
    if (end_height > 0.0) end = begin_height / (begin_height - end_height);
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double t = begin + (end - begin) * rule.node[k], r = r0 + t * dr, z = z0 + t * dz;
      const double size = weight * (end - begin) * rule.weight[k] * r;
      for (const double side : {s, -s}) {
        const Vec3 outward = c * axes.aside + side * axes.across;
        surface.add(center + r * outward + z * axes.axis, size * (dz * outward - dr * axes.axis));
      }
    }
  });
}

// The part of the unit sphere below a height (of unit normal `up`) that lies on the side of `pole` (unit): visit(point,
// area).
template <typename Visit>
void visit_sphere(double height, const Vec3 &up, const Vec3 &pole, Visit visit) {
  if (height <= -1.0) return;
  const auto &rule = gauss_rule<20>;
  const Axes axes(up, pole);  // circles of equal height, seen from the pole's side
  const double deepest = std::acos(std::fmin(height, 1.0));  // angle from the top to the plane
  // Angles from the lowest point; on the pole's side the circle's angle ends where its height's cotangent says.
  std::array<double, 6> between{};
  int count = 0;
  const double tilt = std::acos(std::clamp(-axes.cosine, -1.0, 1.0));  // of the pole from the lowest point
  between[static_cast<std::size_t>(count++)] = std::fabs(0.5 * pi - tilt);
  between[static_cast<std::size_t>(count++)] = pi - std::fabs(0.5 * pi - tilt);
  between[static_cast<std::size_t>(count++)] = 0.5 * pi;
  integrate(0.0, pi - deepest, between, count, [&](double angle, double weight) {
    const double c = std::cos(angle), s = std::sin(angle);
    // -c cosine + s slant cos(turn) >= 0
    const double over = c * axes.cosine, under = s * axes.slant;
    double widest = pi;
    if (over >= under) return;
    if (over > -under) widest = std::acos(over / under);
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double turn = widest * rule.node[k];
      for (const double side : {1.0, -1.0}) {
        const Vec3 point = s * std::cos(turn) * axes.aside + side * s * std::sin(turn) * axes.across - c * up;
        visit(point, (weight * widest * rule.weight[k] * s) * point);
      }
    }
  });
}

void add_ellipsoid(const Vec3 &half, const Pose &pose, const Vec3 &up, Surface &surface) {
  const Vec3 local_up = transposed_times(pose.rotation, up);
  // In the body's frame, stretched to the unit sphere.
  const Vec3 stretched{half.x * local_up.x, half.y * local_up.y, half.z * local_up.z};
  const Vec3 squeezed{local_up.x / half.x, local_up.y / half.y, local_up.z / half.z};
  const double reach = norm(stretched), volume = half.x * half.y * half.z;
  const double plane = -surface.height(pose.translation) / reach;  // the plane's height on the unit sphere
  const auto add = [&](bool of_solid, bool of_shadow) {
    return [&, of_solid, of_shadow](const Vec3 &point, const Vec3 &area) {
      surface.add(pose({half.x * point.x, half.y * point.y, half.z * point.z}),
                  volume * (pose.rotation * Vec3{area.x / half.x, area.y / half.y, area.z / half.z}), of_solid, of_shadow);
    };
  };
  // What looks down is on one side of a plane through the middle.
  const Vec3 pole = normalized(squeezed);
  visit_sphere(plane, (1.0 / reach) * stretched, pole, add(true, false));
  visit_sphere(plane, (1.0 / reach) * stretched, -pole, add(true, true));
}

}  // namespace

SolidBelowPlane solid_below_plane(const Shape &shape, const Pose &pose, const Vec3 &origin, const Vec3 &up) {
  Surface surface(origin, up);
  const Vec3 &center = pose.translation, &half = shape.body.half;
  const Axes axes(pose.rotation.column(2), up);
  switch (shape.kind) {
    case ShapeKind::cylinder:
      add_swept_line(center, axes, 0.0, -half.z, half.x, -half.z, surface);
      add_swept_line(center, axes, half.x, -half.z, half.x, half.z, surface);
      add_swept_line(center, axes, half.x, half.z, 0.0, half.z, surface);
      break;
    case ShapeKind::cone:
      add_swept_line(center, axes, 0.0, -half.z, half.x, -half.z, surface);
      add_swept_line(center, axes, half.x, -half.z, 0.0, half.z, surface);
      break;
    case ShapeKind::capsule: {
      const double r = shape.body.radius;
      add_swept_line(center, axes, r, -half.z, r, half.z, surface);
      for (const double end : {1.0, -1.0}) {
        const Vec3 middle = center + (end * half.z) * axes.axis;
        visit_sphere(-surface.height(middle) / r, up, end * axes.axis, [&](const Vec3 &point, const Vec3 &area) {
          surface.add(middle + r * point, (r * r) * area);
        });
      }
      break;
    }
    default:
      add_ellipsoid(half, pose, up, surface);
      break;
  }
  return surface.sums;
}

}  // namespace cmb
