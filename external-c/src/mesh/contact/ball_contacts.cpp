#include "mesh/contact/ball_contacts.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

// Lengths of the mesh's scale below which places count as one.
double place_tolerance(const TriangleMesh &mesh) { return 1e-9 * mesh.bound_radius(); }

// Whether the point `off` beyond a point of an edge or vertex has it as nearest point of the triangles around it.
bool edge_is_nearest(const TriangleMesh &mesh, std::uint32_t t, std::size_t side, const Vec3 &off, double slack) {
  const Vec3 along = normalized(mesh.corner(t, side + 1) - mesh.corner(t, side));
  if (dot(off, cross(mesh.face_normal(t), along)) > slack) return false;
  const std::int32_t other = mesh.neighbour(t, side);
  if (other >= 0 && dot(off, cross(along, mesh.face_normal(static_cast<std::uint32_t>(other)))) > slack) return false;
  return dot(off, mesh.edge_normal(t, side)) > 0.0;
}

bool vertex_is_nearest(const TriangleMesh &mesh, std::uint32_t v, const Vec3 &off, double slack) {
  for (std::uint32_t i = mesh.vertex_begin(v); i < mesh.vertex_begin(v + 1); ++i) {
    for (const std::uint32_t w : mesh.triangles()[mesh.vertex_triangles()[i]]) {
      if (w != v && dot(off, normalized(mesh.vertices()[w] - mesh.vertices()[v])) > slack) return false;
    }
  }
  return dot(off, mesh.vertex_normal(v)) > 0.0;
}

// What an edge or vertex carries of a load along the unit `direction`: less than 1 beside the rim of a sheet only,
// falling to 0 perpendicular to the sheet's normal.
double edge_share(const TriangleMesh &mesh, std::uint32_t t, std::size_t side, const Vec3 &direction) {
  if (mesh.neighbour(t, side) >= 0) return 1.0;
  return std::fmin(1.0, std::fmax(0.0, dot(direction, mesh.face_normal(t))));
}

double vertex_share(const TriangleMesh &mesh, std::uint32_t v, const Vec3 &direction) {
  for (std::uint32_t i = mesh.vertex_begin(v); i < mesh.vertex_begin(v + 1); ++i) {
    const std::uint32_t t = mesh.vertex_triangles()[i];
    const std::size_t corner = mesh.triangles()[t][0] == v ? 0 : (mesh.triangles()[t][1] == v ? 1 : 2);
    if (mesh.neighbour(t, corner) < 0 || mesh.neighbour(t, (corner + 2) % 3) < 0) {
      return std::fmin(1.0, std::fmax(0.0, dot(direction, mesh.vertex_normal(v))));
    }
  }
  return 1.0;
}

// Whether the point whose offset from corner 0 is `off` lies over the triangle.
bool over_face(const TriangleMesh &mesh, std::uint32_t t, const Vec3 &p, double slack) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = normalized(mesh.corner(t, k + 1) - mesh.corner(t, k));
    if (dot(p - mesh.corner(t, k), cross(mesh.face_normal(t), along)) < -slack) return false;
  }
  return true;
}

// A ball that has gone from where it is to `center`, and how far places are looked for.
struct MovedBall {
  Vec3 center, from;
  double radius, reach;
};

// Places as seen from the ball's centre, as deep as the ball has to go along their normal from where it is.
void add_places(const MovedBall &ball, const TriangleMesh &mesh, std::uint32_t t, SharedLoad &shared) {
  const Vec3 &center = ball.center;
  const double same = place_tolerance(mesh), slack = 1e-3 * same, radius = ball.reach;
  const auto add = [&](const Vec3 &place, const Vec3 &normal, double distance, double share) {
    const double depth = ball.radius - distance + dot(normal, center - ball.from);
    if (depth > 0.0 && share > 0.0) shared.add({depth, share, normal, place}, same);
  };
  const Vec3 &normal = mesh.face_normal(t);
  const double height = dot(normal, center - mesh.corner(t, 0));
  if (height >= 0.0 && height < radius && over_face(mesh, t, center, slack)) {
    add(center - height * normal, normal, height, 1.0);
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
          if (edge_is_nearest(mesh, t, k, off, slack)) add(place, direction, distance, edge_share(mesh, t, k, direction));
          // Of a concave edge each side reaches on over the other, the less the farther.
          const Vec3 &beyond = other < 0 ? normal : mesh.face_normal(static_cast<std::uint32_t>(other));
          const Vec3 inward = cross(along, beyond);
          if (norm2(beyond - normal) > 1e-18 && dot(normal, inward) > 0.0) {
            if (dot(off, inward) > 0.0 && dot(off, cross(normal, along)) < 0.0) add(place, normal, distance, 1.0);
            if (dot(off, inward) < 0.0 && dot(off, cross(normal, along)) > 0.0) add(place, beyond, distance, 1.0);
          }
        }
      }
    }
    const std::uint32_t v = mesh.triangles()[t][k];
    if (mesh.vertex_triangles()[mesh.vertex_begin(v)] != t) continue;  // each vertex once
    const Vec3 off = center - from;
    const double distance = norm(off);
    if (distance < radius && distance > same && vertex_is_nearest(mesh, v, off, slack)) {
      const Vec3 direction = (1.0 / distance) * off;
      add(from, direction, distance, vertex_share(mesh, v, direction));
    }
  }
}

// The share of the nearest place.
double nearest_share(const TriangleMesh &mesh, const NearestPoint &nearest) {
  const std::uint32_t t = nearest.triangle;
  const TrianglePoint at = nearest_on_triangle(nearest.point, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
  if (at.feature == TriangleFeature::face) return 1.0;
  return at.feature == TriangleFeature::edge ? edge_share(mesh, t, at.index, nearest.normal)
                                             : vertex_share(mesh, mesh.triangles()[t][at.index], nearest.normal);
}

}  // namespace

double ball_contacts(const Vec3 &center, double radius, const TriangleMesh &mesh, const NearestPoint &nearest,
                     SharedLoad &shared) {
  shared.clear();
  const double same = place_tolerance(mesh);
  const double distance = (mesh.closed() ? nearest.distance : std::fabs(nearest.distance)) - radius;
  if (!(distance < 0.0)) return distance;
  if (nearest.distance > same) {
    constexpr int rounds = 40;
    constexpr double settled = 1e-12;
    MovedBall ball{center, center, radius, radius};
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
    shared.add({-distance, nearest_share(mesh, nearest), nearest.normal, nearest.point}, same);
    shared.solve();
  }
  return distance;
}

}  // namespace cmb::mesh
