// The work of a force around a closed path.
#pragma once

#include <functional>

namespace cmb::quality {

// At a place s of a path with period 1.
struct PathPlace {
  double power, energy;  // the work by s, and what is stored there
};

struct ClosedWork {
  double work = 0.0, largest_energy = 0.0;
};

// The integral of the power over a period, known to about 1e-6 of the largest energy where the power is continuous. Where it is smooth by `steps` equal steps, that is
// to rounding; where it is not, by their fourth differences, a step is halved until its sum and that of its halves agree.
ClosedWork closed_work(const std::function<PathPlace(double)> &at, int steps);

}  // namespace cmb::quality
