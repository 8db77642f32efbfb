#include "shape/face_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/index.hpp"

namespace cmb {

namespace {

using Face = convex::Polytope::Face;

// Calls visit(place) for the corners of the faces.
template <typename Visit>
void visit_corners(const convex::Polytope &polytope, const FaceClusters::Faces &faces, Visit &&visit) {
  for (const std::int32_t f : faces) {
    const Face &face = polytope.faces()[index(f)];
    for (std::int32_t k = face.first; k < face.first + face.count; ++k) visit(polytope.vertices()[index(polytope.face_vertices()[index(k)])]);
  }
}

// Far, and its square is finite.
constexpr double nowhere = 1e100;

// Sorts the faces so that each `size` of them look much the same way: halves them along the axis on which their normals are spread most.
void group(const std::vector<Face> &faces, std::size_t *begin, std::size_t *end) {
  const auto groups = (static_cast<std::size_t>(end - begin) + FaceClusters::size - 1) / FaceClusters::size;
  if (groups < 2) return;
  int widest = 0;
  double width = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(begin, end, [&](std::size_t f, std::size_t g) {
      return faces[f].normal[axis] < faces[g].normal[axis];
    });
    const double here = faces[*high].normal[axis] - faces[*low].normal[axis];
    if (here > width) width = here, widest = axis;
  }
  std::size_t *const middle = begin + groups / 2 * FaceClusters::size;
  std::sort(begin, end, [&](std::size_t f, std::size_t g) {
    const double of_f = faces[f].normal[widest], of_g = faces[g].normal[widest];
    return of_f < of_g || (of_f == of_g && f < g);
  });
  group(faces, begin, middle);
  group(faces, middle, end);
}

}  // namespace

FaceClusters::FaceClusters(const convex::Polytope &polytope) : center_(polytope.center()) {
  const std::vector<Face> &faces = polytope.faces();
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  group(faces, order.data(), order.data() + order.size());
  const std::size_t groups = (faces.size() + size - 1) / size, room = groups * size;
  planes_.assign(4 * room, 0.0);
  std::fill(planes_.begin() + static_cast<std::ptrdiff_t>(3 * room), planes_.end(), nowhere);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Face &face = faces[order[k]];
    planes_[k] = face.normal.x, planes_[room + k] = face.normal.y, planes_[2 * room + k] = face.normal.z;
    planes_[3 * room + k] = face.offset;
  }
  middles_.resize(3 * groups);
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t first = g * size, last = std::min(first + size, faces.size());
    Vec3 middle;
    for (std::size_t k = first; k < last; ++k) middle = middle + (1.0 / static_cast<double>(last - first)) * faces[order[k]].normal;
    double radius = 0.0, nearest = HUGE_VAL;
    for (std::size_t k = first; k < last; ++k) {
      const Face &face = faces[order[k]];
      radius = std::max(radius, norm(face.normal - middle));
      nearest = std::min(nearest, face.offset - dot(face.normal, center_));
    }
    middles_[g] = middle.x, middles_[groups + g] = middle.y, middles_[2 * groups + g] = middle.z;
    radius_.push_back(radius);
    nearest_.push_back(nearest);
    begin_.push_back(first);
  }
  begin_.push_back(faces.size());
  for (const std::size_t f : order) order_.push_back(static_cast<std::int32_t>(f));
  balls_.resize(4 * groups);
  for (std::size_t g = 0; g < groups; ++g) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    visit_corners(polytope, this->faces(g), [&](const Vec3 &p) {
      for (int axis = 0; axis < 3; ++axis) low.set(axis, std::min(low[axis], p[axis])), high.set(axis, std::max(high[axis], p[axis]));
    });
    const Vec3 center = 0.5 * (low + high);
    double radius = 0.0;
    visit_corners(polytope, this->faces(g), [&](const Vec3 &p) { radius = std::max(radius, norm(p - center)); });
    balls_[g] = center.x, balls_[groups + g] = center.y, balls_[2 * groups + g] = center.z, balls_[3 * groups + g] = radius;
  }
}

void FaceClusters::find_bounds(const Vec3 &place, double *__restrict bounds) const {
  const std::size_t groups = count();
  const Vec3 way = place - center_;
  const double length = norm(way), way_x = way.x, way_y = way.y, way_z = way.z;
  const double *__restrict x = middles_.data(), *__restrict y = x + groups, *__restrict z = y + groups;
  const double *__restrict radius = radius_.data(), *__restrict nearest = nearest_.data();
  for (std::size_t g = 0; g < groups; ++g) {
    bounds[g] = nearest[g] - (x[g] * way_x + y[g] * way_y + z[g] * way_z) - length * radius[g];
  }
}

}  // namespace cmb
