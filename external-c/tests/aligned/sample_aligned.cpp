// Tables of how many poses of bodies that are level with each other fail what is asked of their contacts:
//
//   sample_aligned [--poses N] [--seed S] [--list | --pose number] [kind [kind]]
//
// By property: failures, and in brackets the worst error by what is allowed with the number of its pose. Kinds named restrict the table to
// pairs with them; --list names each pose that fails, too; --pose describes one pose of two kinds instead.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "aligned_samples.hpp"

namespace {

using namespace cmb::aligned;

int usage() {
  std::fprintf(stderr, "usage: sample_aligned [--poses N] [--seed S] [--list | --pose number] [kind [kind]]\nkinds:");
  for (const Kind &kind : all_kinds()) std::fprintf(stderr, " %s", kind.name);
  std::fprintf(stderr, "\n");
  return 2;
}

}  // namespace

int main(int argc, char **argv) {
  int poses = 400, pose = -1;
  bool list = false;
  std::uint64_t seed = 1;
  std::vector<const Kind *> named;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0) {
      named.push_back(find_kind(word));
      if (named.back() == nullptr || named.size() > 2) return usage();
      continue;
    }
    if (word == "--list") {
      list = true;
      continue;
    }
    if (++i == argc) return usage();
    if (word == "--poses") {
      poses = std::atoi(argv[i]);
    } else if (word == "--seed") {
      seed = std::strtoull(argv[i], nullptr, 10);
    } else if (word == "--pose") {
      pose = std::atoi(argv[i]);
    } else {
      return usage();
    }
  }
  std::printf("| pair | poses | apart |");
  for (int k = 0; k < property_count; ++k) std::printf(" %s |", name_of(static_cast<Property>(k)));
  std::printf("\n|---|---|---|");
  for (int k = 0; k < property_count; ++k) std::printf("---|");
  std::printf("\n");
  int failures = 0;
  for (const KindPair &pair : all_pairs()) {
    const auto is = [&](const Kind *first, const Kind *second) { return pair.a == first && pair.b == second; };
    if (named.size() == 1 && pair.a != named[0] && pair.b != named[0]) continue;
    if (named.size() == 2 && !is(named[0], named[1]) && !is(named[1], named[0])) continue;
    if (pose >= 0) {
      std::printf("%s", describe(pair, seed, pose).c_str());
      continue;
    }
    const Tally tally = sample_aligned(pair, poses, seed);
    std::printf("| %s, %s | %d | %d |", pair.a->name, pair.b->name, tally.poses, tally.apart);
    for (const Tally::Failures &of : tally.of) {
      failures += of.count;
      std::printf(" %d (%.1e, %d) |", of.count, of.worst, of.worst_pose);
    }
    std::printf("\n");
    for (int k = 0; list && k < property_count; ++k) {
      for (const Tally::Failures::Pose &failed : tally.of[k].poses) std::printf("%s %d %.2e\n", name_of(static_cast<Property>(k)), failed.number, failed.error);
    }
    std::fflush(stdout);
  }
  return failures == 0 ? 0 : 1;
}
