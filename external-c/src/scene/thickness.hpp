// How thick bodies are.
#pragma once

#include "shape/shape.hpp"

namespace cmb {

// The least extent along its own axes of a body's thinnest shape, in m; infinity where that has none: of half-spaces, open
// meshes and bodies without shape.
double thickness_of(const BodyShapes &shapes);

}  // namespace cmb
