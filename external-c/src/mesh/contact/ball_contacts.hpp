// The places at which a mesh touches a ball.
#pragma once

#include "mesh/contact/shared_load.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// Lengths of the mesh's scale below which places count as one.
inline double place_tolerance(const TriangleMesh &mesh) { return 1e-9 * mesh.bound_radius(); }

// Whether the point `off` beyond a point of an edge or vertex has it as nearest point of the triangles around it.
bool edge_is_nearest(const TriangleMesh &mesh, std::uint32_t t, std::size_t side, const Vec3 &off, double slack);
bool vertex_is_nearest(const TriangleMesh &mesh, std::uint32_t v, const Vec3 &off, double slack);

// What an edge or vertex carries of a load along the unit `direction`: less than 1 beside the rim of a sheet only,
// falling to 0 perpendicular to the sheet's normal.
double edge_share(const TriangleMesh &mesh, std::uint32_t t, std::size_t side, const Vec3 &direction);
double vertex_share(const TriangleMesh &mesh, std::uint32_t v, const Vec3 &direction);

// The share of the nearest place, as edge_share and vertex_share.
double nearest_share(const TriangleMesh &mesh, const NearestPoint &nearest);

// Fills `shared` with the contacts of the ball, all in the mesh's frame, and solves it; returns the signed distance of
// its surface from the mesh. `nearest` is mesh.nearest(center).
double ball_contacts(const Vec3 &center, double radius, const TriangleMesh &mesh, const NearestPoint &nearest,
                     SharedLoad &shared);

}  // namespace cmb::mesh
