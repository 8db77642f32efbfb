// Runs a fuzz target without libFuzzer: on the files named, or else on inputs made from a seed.
//
//   replay [--inputs N] [--seed S] [file ...]
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace {

// Text that a descriptor may begin as, so that mutations reach beyond its first word.
const char *const seeds[] = {
    "cmb/1 sphere radius=0.5",
    "cmb/1 box size=1,2,3 position=0,0,1 rotation=1,0,0,0,1,0,0,0,1;cmb/1 halfspace",
    "cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,0,0,1,1,1,1",
    "cmb/1 capsule radius=0.1 length=1 ; cmb/1 cone radius=1 length=2;cmb/1 ellipsoid size=1,1,2"};

std::vector<std::uint8_t> made_input(std::mt19937 &random) {
  std::vector<std::uint8_t> input;
  if (random() % 2 == 0) {
    const char *seed = seeds[random() % std::size(seeds)];
    input.assign(seed, seed + std::strlen(seed));
    for (unsigned changes = random() % 4; changes > 0 && !input.empty(); --changes) {
      const std::size_t at = random() % input.size();
      switch (random() % 4) {
        case 0: input[at] = static_cast<std::uint8_t>(random()); break;
        case 1: input.erase(input.begin() + static_cast<std::ptrdiff_t>(at)); break;
        case 2: input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), "0123456789.,;=-e "[random() % 17]); break;
        default: input.resize(at); break;
      }
    }
  } else {
    input.resize(random() % 120);
    for (std::uint8_t &byte : input) byte = static_cast<std::uint8_t>(random());
  }
  return input;
}

}  // namespace

int main(int count, char **arguments) {
  unsigned long inputs = 2000;
  unsigned seed = 1;
  bool from_files = false;
  for (int i = 1; i < count; ++i) {
    if (std::strcmp(arguments[i], "--inputs") == 0 && i + 1 < count) {
      inputs = std::strtoul(arguments[++i], nullptr, 10);
    } else if (std::strcmp(arguments[i], "--seed") == 0 && i + 1 < count) {
      seed = static_cast<unsigned>(std::strtoul(arguments[++i], nullptr, 10));
    } else {
      std::ifstream file(arguments[i], std::ios::binary);
      const std::vector<char> text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(text.data()), text.size());
      from_files = true;
    }
  }
  std::mt19937 random(seed);
  for (unsigned long i = 0; !from_files && i < inputs; ++i) {
    const std::vector<std::uint8_t> input = made_input(random);
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  return 0;
}
