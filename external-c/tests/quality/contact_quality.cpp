// Tables of what contact forces are like, over random paths and poses of all pairs of kinds of bodies:
//
//   contact_quality loops|jumps|frames|points [--paths N] [--steps N] [--seed S] [--deep part] [kind [kind]]
//
// loops: work around closed paths as a part of the largest elastic energy, mean and worst, at 1 % and 10 % of the size.
// jumps: jumps of load and moment along paths, as a part of the largest load; how many paths jump by more than 1e-4.
// frames: how much the forces change when both bodies are moved together, as a part of the load.
// points: how many points lie farther than 1.5, 3 and 10 radii from the smaller body's middle; the farthest, and its part of the load.
// Kinds named restrict the table to pairs with them. The table is Markdown.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "quality_samples.hpp"

namespace {

using namespace cmb::quality;

struct Options {
  std::string table;
  int paths = 40, steps = 0;
  std::uint64_t seed = 1;
  double deep = 0.2;
  std::vector<const Kind *> kinds;
};

int usage() {
  std::fprintf(stderr, "usage: contact_quality loops|jumps|frames|points [--paths N] [--steps N] [--seed S] [--deep part] [kind [kind]]\n");
  std::fprintf(stderr, "kinds:");
  for (const Kind &kind : all_kinds()) std::fprintf(stderr, " %s", kind.name);
  std::fprintf(stderr, "\n");
  return 2;
}

bool parse(int argc, char **argv, Options &options) {
  if (argc < 2) return false;
  options.table = argv[1];
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0) {
      options.kinds.push_back(find_kind(word));
      if (options.kinds.back() == nullptr || options.kinds.size() > 2) return false;
      continue;
    }
    if (++i == argc) return false;
    if (word == "--paths") {
      options.paths = std::atoi(argv[i]);
    } else if (word == "--steps") {
      options.steps = std::atoi(argv[i]);
    } else if (word == "--seed") {
      options.seed = std::strtoull(argv[i], nullptr, 10);
    } else if (word == "--deep") {
      options.deep = std::atof(argv[i]);
    } else {
      return false;
    }
  }
  return options.paths > 0 && options.deep > 0.0;
}

// Each unordered pair once, ground second; not ground with ground, which has no closed answer to sample.
std::vector<KindPair> pairs_of(const Options &options) {
  std::vector<KindPair> pairs;
  for (std::size_t i = 0; i < all_kinds().size(); ++i) {
    for (std::size_t j = i; j < all_kinds().size(); ++j) {
      const Kind *a = &all_kinds()[i], *b = &all_kinds()[j];
      if (a->ground && b->ground) continue;
      if (a->ground) std::swap(a, b);
      if (options.kinds.size() == 1 && a != options.kinds[0] && b != options.kinds[0]) continue;
      const bool named = options.kinds.size() == 2 && ((a == options.kinds[0] && b == options.kinds[1]) ||
                                                       (a == options.kinds[1] && b == options.kinds[0]));
      if (options.kinds.size() == 2 && !named) continue;
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

void print_loops(const Options &options) {
  std::printf("| pair | 1 %%: mean | worst | 10 %%: mean | worst |\n|---|---|---|---|---|\n");
  const int steps = options.steps > 0 ? options.steps : 2000;
  for (const KindPair &pair : pairs_of(options)) {
    const LoopWork small = sample_loops(pair, 0.01, 0.01, options.paths, steps, options.seed);
    const LoopWork large = sample_loops(pair, 0.1, 0.5, options.paths, steps, options.seed);
    std::printf("| %s, %s | %.1e | %.1e | %.1e | %.1e |\n", pair.a->name, pair.b->name, small.mean, small.worst, large.mean,
                large.worst);
    std::fflush(stdout);
  }
}

void print_jumps(const Options &options) {
  std::printf("| pair | paths | jump | worst | its path, place |\n|---|---|---|---|---|\n");
  const int steps = options.steps > 0 ? options.steps : 600;
  for (const KindPair &pair : pairs_of(options)) {
    const Jumps jumps = sample_jumps(pair, options.deep, options.paths, steps, options.seed);
    std::printf("| %s, %s | %d | %d | %.1e | %llu, %.17g |\n", pair.a->name, pair.b->name, jumps.paths, jumps.jumping,
                jumps.worst, static_cast<unsigned long long>(jumps.worst_seed), jumps.worst_place);
    std::fflush(stdout);
  }
}

void print_frames(const Options &options) {
  std::printf("| pair | poses | worst change |\n|---|---|---|\n");
  for (const KindPair &pair : pairs_of(options)) {
    const FrameError frames = sample_frames(pair, options.paths, options.seed);
    std::printf("| %s, %s | %d | %.1e |\n", pair.a->name, pair.b->name, frames.poses, frames.worst);
    std::fflush(stdout);
  }
}

void print_points(const Options &options) {
  std::printf("| pair | poses | points | > 1.5 | > 3 | > 10 | farthest | its load | its pose |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const KindPair &pair : pairs_of(options)) {
    const FarPoints far = sample_far_points(pair, options.paths, options.seed);
    std::printf("| %s, %s | %d | %d | %d | %d | %d | %.2g | %.1e | %llu |\n", pair.a->name, pair.b->name, far.poses, far.points, far.beyond[0],
                far.beyond[1], far.beyond[2], far.farthest, far.load_there, static_cast<unsigned long long>(far.worst_seed));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char **argv) {
  Options options;
  if (!parse(argc, argv, options)) return usage();
  if (options.table == "loops") {
    print_loops(options);
  } else if (options.table == "jumps") {
    print_jumps(options);
  } else if (options.table == "frames") {
    print_frames(options);
  } else if (options.table == "points") {
    print_points(options);
  } else {
    return usage();
  }
  return 0;
}
