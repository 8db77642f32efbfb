#include "volume/mesh_overlap.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/core/triangle_mesh.hpp"

namespace cmb::overlap {

namespace {

using mesh::Bounds;

constexpr double margin_part = 1e-3;

// Calls visit(corners) for the triangles of leaves that reach into the columns, in their axes.
template <typename Visit>
void visit_triangles(const mesh::TriangleMesh &mesh, const Pose &pose, const Columns &columns, Visit &&visit) {
  const auto &nodes = mesh.hierarchy().nodes();
  std::uint32_t stack[64];
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const auto &node = nodes[stack[--size]];
    const Bounds box = moved(node.bounds, pose);
    if (box.high.z < columns.low || box.high.x < columns.x[0] || box.low.x > columns.x[1] || box.high.y < columns.y[0] ||
        box.low.y > columns.y[1]) {
      continue;
    }
    if (node.count == 0) {
      stack[size++] = node.first + 1;
      stack[size++] = node.first;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t t = mesh.hierarchy().order()[i];
      const Vec3 corner[3] = {pose(mesh.corner(t, 0)), pose(mesh.corner(t, 1)), pose(mesh.corner(t, 2))};
      visit(corner);
    }
  }
}

void add_mesh(const mesh::TriangleMesh &mesh, const Pose &pose, const Columns &columns, FaceSet &faces) {
  faces.clear();
  visit_triangles(mesh, pose, columns, [&](const Vec3 (&corner)[3]) { faces.add(corner, 3, columns); });
}

void add_polytope(const convex::Polytope &polytope, const Pose &pose, const Columns &columns, std::vector<Vec3> &corners,
                  FaceSet &faces) {
  faces.clear();
  for (const auto &face : polytope.faces()) {
    corners.clear();
    for (std::int32_t k = 0; k < face.count; ++k) {
      const std::int32_t v = polytope.face_vertices()[static_cast<std::size_t>(face.first + k)];
      corners.push_back(pose(polytope.vertices()[static_cast<std::size_t>(v)]));
    }
    faces.add(corners.data(), face.count, columns);
  }
}

Bounds bounds_in(const Shape &shape, const Pose &pose) {
  if (shape.mesh) return moved(shape.mesh->hierarchy().bounds(), pose);
  if (RoundSolid::is_round(shape)) {
    const RoundSolid solid(shape, pose);
    return {solid.low(), solid.high()};
  }
  const auto &vertices = shape.polytope->geometry().vertices();
  Bounds box{pose(vertices[0]), pose(vertices[0])};
  for (const Vec3 &vertex : vertices) include(box, pose(vertex));
  return box;
}

// The part of a round shape in a closed mesh: of what lies below each triangle, with a sign.
SolidSums round_part(const Shape &shape, const Pose &pose, const mesh::TriangleMesh &mesh, const Pose &mesh_pose,
                     const Columns &columns, MeshOverlapScratch &scratch) {
  const RoundSolid solid(shape, pose);
  const Vec3 margin = margin_part * (solid.high() - solid.low());
  convex::OverlapScratch &base = scratch.base, &flat = scratch.curved.flat;
  base.start_box(solid.low() - margin, solid.high() + margin);
  solid.visit_flat_ends([&](const Vec3 &normal, double offset) { base.cut(normal, offset, -1, false); });
  constexpr std::int32_t triangle_face = 1;
  SolidSums sums;
  visit_triangles(mesh, mesh_pose, columns, [&](const Vec3 (&corner)[3]) {
    const Vec3 area = cross(corner[1] - corner[0], corner[2] - corner[0]);
    if (!(std::fabs(area.z) > 1e-14 * norm(area))) return;
    const double sign = area.z > 0.0 ? 1.0 : -1.0;
    const Vec3 up = normalized(sign * area);
    flat = base;
    for (int k = 0; k < 3 && !flat.faces().empty(); ++k) {
      const Vec3 side = sign * (corner[(k + 1) % 3] - corner[k]);
      const Vec3 outward = normalized(Vec3{side.y, -side.x, 0.0});
      flat.cut(outward, dot(outward, corner[k]), -1, false);
    }
    if (!flat.faces().empty()) flat.cut(up, dot(up, corner[0]), triangle_face, false);
    if (flat.faces().empty()) return;
    const SlicedSums part = scratch.curved.slices.measure({&flat, &solid, 1, triangle_face}, nullptr, 0, 1e-8);
    sums.add(part.solid, sign);
    if (sign < 0.0) {
      // The triangle itself belongs to the lower side.
      sums.upper.add(part.marked, 1.0);
      sums.lower.add(part.marked, 1.0);
    }
  });
  return sums;
}

}  // namespace

ShapeOverlap mesh_and_halfspace(const Shape &mesh, const Pose &pose, const Pose &plane, MeshOverlapScratch &scratch) {
  const Vec3 normal = plane.rotation.column(2), center = pose(mesh.bound_center);
  const Vec3 origin = center - dot(normal, center - plane.translation) * normal;
  const Pose axes = seen_along(normal, plane.rotation.column(1), origin);
  const Pose in_axes = relative_pose(axes, pose);
  const Bounds box = bounds_in(mesh, in_axes);
  if (box.low.z >= 0.0) return {};
  const Vec3 margin = box.high - box.low;
  // Faces at the bottom count as sides: the columns begin below.
  const Columns columns{{box.low.x, box.high.x}, {box.low.y, box.high.y}, box.low.z - margin_part * margin.z};
  const Vec3 low = box.low - margin, high = box.high + margin;
  const Vec3 corner[4] = {{low.x, low.y, 0.0}, {high.x, low.y, 0.0}, {high.x, high.y, 0.0}, {low.x, high.y, 0.0}};
  add_mesh(*mesh.mesh, in_axes, columns, scratch.a);
  scratch.b.clear();
  scratch.b.add(corner, 4, columns);
  return shape_overlap(scratch.columns.common_part(scratch.b, scratch.a, columns), axes);
}

ShapeOverlap mesh_overlap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const Vec3 &normal,
                          const Vec3 &near, MeshOverlapScratch &scratch) {
  const Pose axes = seen_along(normal, cross(normal, straight_axis(a, pose_a)), near);
  const Pose a_in_axes = relative_pose(axes, pose_a), b_in_axes = relative_pose(axes, pose_b);
  const Bounds box_a = bounds_in(a, a_in_axes), box_b = bounds_in(b, b_in_axes);
  const double height = std::min(box_a.high.z - box_a.low.z, box_b.high.z - box_b.low.z);
  const Columns columns{{std::max(box_a.low.x, box_b.low.x), std::min(box_a.high.x, box_b.high.x)},
                        {std::max(box_a.low.y, box_b.low.y), std::min(box_a.high.y, box_b.high.y)},
                        std::max(box_a.low.z, box_b.low.z) - margin_part * height};
  if (!(columns.x[0] < columns.x[1]) || !(columns.y[0] < columns.y[1])) return {};
  if (!(columns.low < std::min(box_a.high.z, box_b.high.z))) return {};
  if (RoundSolid::is_round(a)) {
    return shape_overlap(round_part(a, a_in_axes, *b.mesh, b_in_axes, columns, scratch), axes);
  }
  add_mesh(*b.mesh, b_in_axes, columns, scratch.b);
  if (a.mesh) {
    add_mesh(*a.mesh, a_in_axes, columns, scratch.a);
  } else {
    add_polytope(a.polytope->geometry(), a_in_axes, columns, scratch.corners, scratch.a);
  }
  return shape_overlap(scratch.columns.common_part(scratch.a, scratch.b, columns), axes);
}

}  // namespace cmb::overlap
