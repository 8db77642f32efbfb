// The places at which a mesh touches a ball.
#pragma once

#include "mesh/contact/shared_load.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// Fills `shared` with the contacts of the ball, all in the mesh's frame, and solves it; returns the signed distance of
// its surface from the mesh. `nearest` is mesh.nearest(center). Normals are those at the nearest place where the ball is free, depths how far it has to
// go along them: half the square of the way there is an energy, and the way its gradient. With normals at the ball's own place, which turn as it moves about an
// edge, the way would be none.
double ball_contacts(const Vec3 &center, double radius, const TriangleMesh &mesh, const NearestPoint &nearest,
                     SharedLoad &shared);

}  // namespace cmb::mesh
