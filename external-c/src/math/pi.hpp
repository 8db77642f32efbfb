// The number pi.
#pragma once

namespace cmb {

constexpr double pi = 3.14159265358979323846;

}  // namespace cmb
