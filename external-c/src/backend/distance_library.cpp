#include "backend/distance_backend.hpp"

namespace cmb {

const DistanceLibrary *distance_library(cmb_backend backend) {
  static constexpr DistanceLibrary libccd{libccd_distance, nullptr}, fcl{fcl_distance, make_fcl_shape},
      coal{coal_distance, make_coal_shape};
  switch (backend) {
    case CMB_BACKEND_LIBCCD: return &libccd;
    case CMB_BACKEND_FCL: return &fcl;
    case CMB_BACKEND_COAL: return &coal;
    default: return nullptr;
  }
}

}  // namespace cmb
