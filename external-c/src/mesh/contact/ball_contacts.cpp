#include "mesh/contact/ball_contacts.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

// Lengths of the mesh's scale below which places count as one.
double place_tolerance(const TriangleMesh &mesh) { return 1e-9 * mesh.bound_radius(); }

bool is_rim(const TriangleMesh &mesh, std::uint32_t v) {
  for (std::uint32_t i = mesh.vertex_begin(v); i < mesh.vertex_begin(v + 1); ++i) {
    const std::uint32_t t = mesh.vertex_triangles()[i];
    const std::size_t corner = mesh.triangles()[t][0] == v ? 0 : (mesh.triangles()[t][1] == v ? 1 : 2);
    if (mesh.neighbour(t, corner) < 0 || mesh.neighbour(t, (corner + 2) % 3) < 0) return true;
  }
  return false;
}

// Whether the point `off` beyond a point of an edge or vertex has it as nearest point of the triangles around it, and is before them,
// or beside a rim of which both sides count.
bool edge_is_nearest(const TriangleMesh &mesh, std::uint32_t t, std::size_t side, const Vec3 &off, double slack, bool both_sides) {
  const Vec3 along = normalized(mesh.corner(t, side + 1) - mesh.corner(t, side));
  if (dot(off, cross(mesh.face_normal(t), along)) > slack) return false;
  const std::int32_t other = mesh.neighbour(t, side);
  if (other >= 0 && dot(off, cross(along, mesh.face_normal(static_cast<std::uint32_t>(other)))) > slack) return false;
  return (both_sides && other < 0) || dot(off, mesh.edge_normal(t, side)) > 0.0;
}

bool vertex_is_nearest(const TriangleMesh &mesh, std::uint32_t v, const Vec3 &off, double slack, bool both_sides) {
  for (std::uint32_t i = mesh.vertex_begin(v); i < mesh.vertex_begin(v + 1); ++i) {
    for (const std::uint32_t w : mesh.triangles()[mesh.vertex_triangles()[i]]) {
      if (w != v && dot(off, normalized(mesh.vertices()[w] - mesh.vertices()[v])) > slack) return false;
    }
  }
  return dot(off, mesh.vertex_normal(v)) > 0.0 || (both_sides && is_rim(mesh, v));
}

// Whether the nearest place lies on the rim of a sheet.
bool is_rim(const TriangleMesh &mesh, const NearestPoint &nearest) {
  if (nearest.feature == TriangleFeature::face) return false;
  return nearest.feature == TriangleFeature::edge ? mesh.neighbour(nearest.triangle, nearest.index) < 0
                                                  : is_rim(mesh, mesh.triangles()[nearest.triangle][nearest.index]);
}

// Where a rim pushes that is freed along `normal`: there, but to the sheet's front.
Vec3 to_front(const Vec3 &normal, const Vec3 &front) {
  return normal + (2.0 * std::fmax(0.0, -dot(normal, front))) * front;
}

// Whether the point whose offset from corner 0 is `off` lies over the triangle.
bool over_face(const TriangleMesh &mesh, std::uint32_t t, const Vec3 &p, double slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = normalized(mesh.corner(t, k + 1) - mesh.corner(t, k));
    if (dot(p - mesh.corner(t, k), cross(mesh.face_normal(t), along)) < -slack) return false;
  }
  return true;
}

// A ball that has gone from where it is to `center`, and how far places are looked for. Beside the rim of a sheet both of its sides count.
struct MovedBall {
  Vec3 center, from;
  double radius, reach;
  bool beside_rim;
};

// Places as seen from the ball's centre, as deep as the ball has to go along their normal from where it is.
void add_places(const MovedBall &ball, const TriangleMesh &mesh, std::uint32_t t, SharedLoad &shared) {
  const Vec3 &center = ball.center;
  const double same = place_tolerance(mesh), slack = 1e-3 * same, radius = ball.reach;
  const auto add = [&](const Vec3 &place, const Vec3 &normal, double distance, const Vec3 &push) {
    const double depth = ball.radius - distance + dot(normal, center - ball.from);
    if (depth > 0.0) shared.add({depth, normal, push, place}, same);
  };
  const Vec3 &normal = mesh.face_normal(t);
  const double height = dot(normal, center - mesh.corner(t, 0));
  if (height >= 0.0 && height < radius && over_face(mesh, t, center, slack)) {
    add(center - height * normal, normal, height, normal);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = mesh.corner(t, k);
    const std::int32_t other = mesh.neighbour(t, k);
    if (other < 0 || static_cast<std::uint32_t>(other) > t) {
      const Vec3 along = mesh.corner(t, k + 1) - from;
      const double part = dot(center - from, along) / norm2(along);
      if (part > 0.0 && part < 1.0) {
        const Vec3 place = from + part * along, off = center - place;
        const double distance = norm(off);
        if (distance < radius && distance > same) {
          const Vec3 direction = (1.0 / distance) * off;
          if (edge_is_nearest(mesh, t, k, off, slack, ball.beside_rim)) {
            add(place, direction, distance, other < 0 ? to_front(direction, normal) : direction);
          }
          // Of a concave edge each side reaches on over the other, the less the farther.
          const Vec3 &beyond = other < 0 ? normal : mesh.face_normal(static_cast<std::uint32_t>(other));
          const Vec3 inward = cross(along, beyond);
          if (norm2(beyond - normal) > 1e-18 && dot(normal, inward) > 0.0) {
            if (dot(off, inward) > 0.0 && dot(off, cross(normal, along)) < 0.0) add(place, normal, distance, normal);
            if (dot(off, inward) < 0.0 && dot(off, cross(normal, along)) > 0.0) add(place, beyond, distance, beyond);
          }
        }
      }
    }
    const std::uint32_t v = mesh.triangles()[t][k];
    if (mesh.vertex_triangles()[mesh.vertex_begin(v)] != t) continue;  // each vertex once
    const Vec3 off = center - from;
    const double distance = norm(off);
    if (distance < radius && distance > same && vertex_is_nearest(mesh, v, off, slack, ball.beside_rim)) {
      const Vec3 direction = (1.0 / distance) * off;
      add(from, direction, distance, to_front(direction, mesh.vertex_normal(v)));
    }
  }
}

}  // namespace

double ball_contacts(const Vec3 &center, double radius, const TriangleMesh &mesh, const NearestPoint &nearest,
                     SharedLoad &shared) {
  shared.clear();
  const double same = place_tolerance(mesh);
  const double distance = (mesh.closed() ? nearest.distance : std::fabs(nearest.distance)) - radius;
  if (!(distance < 0.0)) return distance;
  const bool beside_rim = !mesh.closed() && std::fabs(nearest.distance) > same && is_rim(mesh, nearest);
  if (nearest.distance > same || beside_rim) {
    constexpr int rounds = 40;
    constexpr double settled = 1e-12;
    MovedBall ball{center, center, radius, radius, beside_rim};
    for (int round = 0; round < rounds; ++round) {
      shared.clear();
      mesh.hierarchy().visit_near(
          {ball.center, ball.center}, [&] { return ball.reach * ball.reach; },
          [&](std::uint32_t t) { add_places(ball, mesh, t, shared); });
      if (shared.size() == 0) break;
      shared.solve();
      const Vec3 freed = center + shared.translation();
      const double step = norm(freed - ball.center);
      if (!(step > settled * radius)) return distance;
      ball.center = freed;
      ball.reach = radius - distance;
    }
  }
  // With the centre in or below the surface only the nearest place tells the exit direction.
  if (shared.size() == 0) {
    shared.add({-distance, nearest.normal, nearest.normal, nearest.point}, same);
    shared.solve();
  }
  return distance;
}

}  // namespace cmb::mesh
