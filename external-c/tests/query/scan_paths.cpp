// Looks for rare jumps of load and moment along the random paths of test_curved_continuity:
//
//   scan_paths <kind of A> <kind of B> <first seed> <seeds> [samples a path [steepest followed]]
//
// Kinds are sphere, capsule, cylinder, cone, ellipsoid, box and hull. Prints every path that jumps by more than 1e-5 of
// its largest load, as a RarePath of the test takes it, and how many do.
#include <cstdio>
#include <cstdlib>

#include "support/path_sums.hpp"

int main(int argc, char **argv) {
  using namespace cmb::test;
  if (argc < 5) {
    std::fprintf(stderr, "usage: %s <kind of A> <kind of B> <first seed> <seeds> [samples [steepest]]\n", argv[0]);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[3], nullptr, 10), seeds = std::strtoull(argv[4], nullptr, 10);
  const int samples = argc > 5 ? std::atoi(argv[5]) : 600;
  const std::size_t steepest = argc > 6 ? std::strtoull(argv[6], nullptr, 10) : 15;
  int paths = 0, unloaded = 0, jumping = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    for (const double deep : {0.004, 0.04}) {
      random_bodies::Random random(seed);
      const std::string a = random_shape(argv[1], random), b = random_shape(argv[2], random);
      const PairScene scene(a, b);
      const PathSums sums = follow(scene, random_path(scene, random, deep), {}, samples, steepest);
      ++paths;
      unloaded += sums.largest_load > 0.0 ? 0 : 1;
      if (!(sums.largest_jump > 1e-5 * sums.largest_load)) continue;
      ++jumping;
      std::printf("{\"%s\", \"%s\"}, %llu, %g: jumps by %.3g of the load at %.17g\n", argv[1], argv[2],
                  static_cast<unsigned long long>(seed), deep, sums.largest_jump / sums.largest_load, sums.jump_at);
      std::fflush(stdout);
    }
  }
  std::printf("%s on %s: %d paths, %d of them without contact, %d with jumps\n", argv[1], argv[2], paths, unloaded, jumping);
  return jumping > 0 ? 1 : 0;
}
