#include "manifold/polytope/flush_boxes.hpp"

#include <algorithm>
#include <cmath>

#include "math/pi.hpp"

namespace cmb {

namespace {

// Up to this slope a face is in the contact plane: what rotation matrices are off by rounding.
constexpr double rounding_slope = 1e-14;
// Edges at a smaller angle (its sine) do not cross: such a crossing's part is as small.
constexpr double parallel_sine = 1e-9;

struct Place {
  double x, y;
};
Place operator+(const Place &p, const Place &q) { return {p.x + q.x, p.y + q.y}; }
Place operator*(double s, const Place &p) { return {s * p.x, s * p.y}; }
double dot(const Place &p, const Place &q) { return p.x * q.x + p.y * q.y; }
double cross(const Place &p, const Place &q) { return p.x * q.y - p.y * q.x; }
double component(const Place &p, int axis) { return axis == 0 ? p.x : p.y; }

class Rectangle {
 public:
  Place middle, half[2];  // half edges

  Rectangle() = default;
  Rectangle(const Place &center, const Place &u, const Place &v)
      : middle(center), half{u, v}, gradient_{(1.0 / dot(u, u)) * u, (1.0 / dot(v, v)) * v} {}

  Place corner(double s, double t) const { return middle + s * half[0] + t * half[1]; }
  // A point's coordinates, -1 to 1 inside; and how they change along a way.
  Place coordinates(const Place &p) const { return change({p.x - middle.x, p.y - middle.y}); }
  Place change(const Place &way) const { return {dot(way, gradient_[0]), dot(way, gradient_[1])}; }

 private:
  Place gradient_[2];  // of the coordinates
};

bool is_inside(const Place &coordinates) { return std::fabs(coordinates.x) < 1.0 && std::fabs(coordinates.y) < 1.0; }

// The face in the contact plane; false where there is none.
bool level_face(const Vec3 &half, const Pose &box, Rectangle &face) {
  const Vec3 slope{std::fabs(box.rotation.row[2].x), std::fabs(box.rotation.row[2].y), std::fabs(box.rotation.row[2].z)};
  const auto set = [&](int i, int j) {
    const Vec3 u = half[i] * box.rotation.column(i), v = half[j] * box.rotation.column(j);
    face = {{box.translation.x, box.translation.y}, {u.x, u.y}, {v.x, v.y}};
    return true;
  };
  if (slope.x + slope.y <= rounding_slope) return set(0, 1);
  if (slope.y + slope.z <= rounding_slope) return set(1, 2);
  if (slope.z + slope.x <= rounding_slope) return set(2, 0);
  return false;
}

Rectangle perturbed(const Rectangle &face, const Perturbation &perturbation) {
  const auto turned = [&](const Place &v) { return Place{v.x - perturbation.turn.z * v.y, v.y + perturbation.turn.z * v.x}; };
  return {turned(face.middle) + Place{perturbation.shift.x, perturbation.shift.y}, turned(face.half[0]), turned(face.half[1])};
}

// The angles between outward normals of A's and B's edges: all follow from one.
class NormalAngles {
 public:
  NormalAngles(const Rectangle &a, const Rectangle &b) {
    const double angle = std::atan2(std::fabs(cross(a.half[0], b.half[0])), dot(a.half[0], b.half[0]));
    const double other = std::fabs(0.5 * pi - angle);
    angle_[0][0] = angle;
    angle_[0][1] = dot(a.half[0], b.half[1]) < 0.0 ? pi - other : other;
    angle_[1][0] = dot(a.half[1], b.half[0]) < 0.0 ? pi - other : other;
    angle_[1][1] = (dot(a.half[1], b.half[1]) < 0.0) == (dot(a.half[0], b.half[0]) < 0.0) ? angle : pi - angle;
  }
  // Between the directions sense_a half[i] of A and sense_b half[j] of B.
  double between(int i, double sense_a, int j, double sense_b) const {
    return sense_a * sense_b < 0.0 ? pi - angle_[i][j] : angle_[i][j];
  }

 private:
  double angle_[2][2];
};

// A stretch [from, to] of a line, and the borders of a rectangle that bound it.
struct Stretch {
  double from = 0.0, to = 1.0;
  int from_axis = -1, to_axis = -1;  // of the rectangle's coordinates

  // Narrows it to where |x + t dx| <= 1.
  void narrow(double x, double dx, int axis) {
    const double inverse = 1.0 / dx, sense = std::copysign(1.0, dx);
    const double enter = (-sense - x) * inverse, leave = (sense - x) * inverse;
    from_axis = enter > from ? axis : from_axis;
    from = enter > from ? enter : from;
    to_axis = leave < to ? axis : to_axis;
    to = leave < to ? leave : to;
  }
};

}  // namespace

bool FlushBoxes::find(const Vec3 &half_a, const Pose &a, const Vec3 &half_b, const Pose &b, const Perturbation &perturbation) {
  constexpr double senses[2] = {-1.0, 1.0};
  count_ = 0;
  Rectangle face_a, face_b;
  if (!level_face(half_a, a, face_a) || !level_face(half_b, b, face_b)) return false;
  const Rectangle seen_b = perturbed(face_b, perturbation);
  const auto add = [&](const Place &p, double part) {
    Corner &corner = corners_[count_++];
    corner.x = p.x, corner.y = p.y, corner.part = part;
  };
  for (const double s : senses) {
    for (const double t : senses) {
      if (is_inside(seen_b.coordinates(face_a.corner(s, t)))) add(face_a.corner(s, t), 0.25);
    }
  }
  for (const double s : senses) {
    for (const double t : senses) {
      if (is_inside(face_a.coordinates(seen_b.corner(s, t)))) add(face_b.corner(s, t), 0.25);
    }
  }
  const NormalAngles normals(face_a, face_b);
  for (int along = 0; along < 2; ++along) {
    const Place whole = 2.0 * face_a.half[along], way = face_b.change(whole), seen_way = seen_b.change(whole);
    const double limit2 = parallel_sine * parallel_sine * dot(whole, whole);
    for (const double sense : senses) {
      const Place start = face_a.middle + (-1.0) * face_a.half[along] + sense * face_a.half[1 - along];
      const Place begin = face_b.coordinates(start), seen_begin = seen_b.coordinates(start);
      Stretch stretch;
      stretch.narrow(seen_begin.x, seen_way.x, 0);
      stretch.narrow(seen_begin.y, seen_way.y, 1);
      if (!(stretch.from < stretch.to)) continue;
      const auto add_crossing = [&](int axis, double direction) {  // -1: where the edge enters B's face, 1: where it leaves
        const double fall = component(way, axis), border = std::copysign(direction, direction * fall);
        if (axis < 0 || !(fall * fall * dot(face_b.half[axis], face_b.half[axis]) > limit2)) return;
        const double t = std::clamp((border - component(begin, axis)) / fall, 0.0, 1.0);
        add(start + t * whole, normals.between(1 - along, sense, axis, border) * (0.5 / pi));
      };
      add_crossing(stretch.from_axis, -1.0);
      add_crossing(stretch.to_axis, 1.0);
    }
  }
  return true;
}

}  // namespace cmb
