// Times the contact of every pair of kinds of bodies: the engine, through its C interface and with its manifold, beside coal's
// collide with contact patch and FCL's collide. No pair is chosen.
//
//   bench_pairs [poses a row [kind [kind]]]
//
// Bodies are about 1 m large. Columns: 1 mm, 10 cm and 30 cm deep (empty where the bodies do not allow it); 5 cm apart, where all are
// asked whether they touch; the same, asked how far apart they are; each query another pose; and poses that follow each other as in a
// simulation, 1 cm deep. The contestants take turns. Printed, as Markdown: the engine's median of processor time by the quicker
// peer's, and its microseconds; then how many ratios are above 1, and the worst.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "bench_support.hpp"
#include "contact_peer.hpp"
#include "contact_multibody.h"
#include "scene/descriptor.hpp"
#include "support/engine_calls.hpp"
#include "support/mesh_text.hpp"

namespace {

using namespace cmb;
using namespace cmb::bench;
using random_bodies::Random;

constexpr double most_of_a_row = 1e5;  // microseconds, beyond the first sweeps

struct Kind {
  const char *name;
  std::string text;
  bool ground = false;  // lies below: others come from above
};

std::vector<Kind> all_kinds() {
  const auto hills = [](double x, double y) { return 0.08 * std::sin(2.1 * x) * std::cos(1.7 * y) + 0.02 * std::sin(5 * y); };
  return {{"half-space", "cmb/1 halfspace", true},
          {"sphere", "cmb/1 sphere radius=0.5"},
          {"ellipsoid", "cmb/1 ellipsoid size=0.6,0.8,1"},
          {"capsule", "cmb/1 capsule radius=0.2 length=0.6"},
          {"cylinder", "cmb/1 cylinder radius=0.4 length=0.7"},
          {"cone", "cmb/1 cone radius=0.4 length=0.8"},
          {"box", "cmb/1 box size=0.6,0.8,1"},
          {"hull-20", hull_descriptor(20)},
          {"hull-100", hull_descriptor(100)},
          {"hull-1000", hull_descriptor(1000)},
          {"box-mesh-12", mesh_samples::mesh_text(mesh_samples::box_mesh({0.6, 0.8, 1}, 1))},
          {"box-mesh-768", mesh_samples::mesh_text(mesh_samples::box_mesh({0.6, 0.8, 1}, 8))},
          {"sphere-mesh-1280", mesh_samples::mesh_text(mesh_samples::sphere_mesh(0.5, 3))},
          {"height-field-2048", mesh_samples::height_field_text(4.0, 33, hills), true}};
}

enum class Question { contact, touch, distance };

// At which distance what is asked, and whether poses follow each other.
struct Column {
  const char *name;
  double distance;
  Question question;
  bool coherent;
};

constexpr Column columns[] = {{"1 mm", -1e-3, Question::contact, false},  {"10 cm", -0.1, Question::contact, false},
                              {"30 cm", -0.3, Question::contact, false},  {"apart", 0.05, Question::touch, false},
                              {"distance", 0.05, Question::distance, false}, {"coherent", -0.01, Question::contact, true}};

// Two kinds as a scene that tells the distance anywhere.
class Placer {
 public:
  Placer(const Kind &a, const Kind &b) : ground_(b.ground) {
    const char *geometry[] = {a.text.c_str(), b.text.c_str()};
    const int pairs[] = {1, 2};
    if (cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene_) != CMB_OK) {
      std::fprintf(stderr, "%s\n", cmb_last_error());
      std::exit(1);
    }
  }
  ~Placer() { cmb_release_scene(scene_); }
  Placer(const Placer &) = delete;
  Placer &operator=(const Placer &) = delete;

  // Appends so many poses at the distance, or as many as are found.
  void place(const Column &column, std::size_t poses, PosedPair &pair) const {
    Random random(5);
    Pose a, b;
    Vec3 way, from;
    for (std::size_t attempt = 0; pair.pose_a.size() < poses && attempt < 4 * poses; ++attempt) {
      if (column.coherent && !pair.pose_a.empty()) {
        const Vec3 axis = random.direction();
        const Mat3 turn = random_bodies::rotation_about(axis, between), &old = a.rotation;
        a.rotation = convex::transposed({{turn * old.column(0), turn * old.column(1), turn * old.column(2)}});
        if (!ground_) way = convex::normalized(way + between * random.direction(), way);
      } else {
        a.rotation = random_bodies::random_rotation(random);
        if (!ground_) b.rotation = random_bodies::random_rotation(random);
        way = ground_ ? Vec3{0, 0, 1} : random.direction();
        if (ground_) from = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -1.5};
      }
      if (!approach(a, b, from, way, column.distance)) continue;
      pair.pose_a.push_back(a);
      pair.pose_b.push_back(b);
    }
  }

 private:
  static constexpr double between = 1e-3;  // rad, of poses that follow each other

  double distance(const Pose &a, const Pose &b) const {
    double position[6], rotation[18], found = 0.0, depth[8], weight[8], normal[24], point[24];
    const Pose *poses[] = {&a, &b};
    for (int body = 0; body < 2; ++body) {
      for (int i = 0; i < 3; ++i) {
        position[3 * body + i] = poses[body]->translation[i];
        for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * i + j] = poses[body]->rotation.row[j][i];
      }
    }
    cmb::test::query_scene(scene_, position, rotation, 2, 1, 8, &found, depth, weight, normal, point);
    return found;
  }

  // Moves A from `from` along `way` to where the distance is the wanted one; false where it is nowhere.
  bool approach(Pose &a, const Pose &b, const Vec3 &from, const Vec3 &way, double wanted) const {
    const auto found = [&](double s) {
      a.translation = from + s * way;
      return distance(a, b);
    };
    double far = 4.0;
    if (!(found(far) > wanted)) return false;
    // Downwards, for a sheet pushes from its front alone.
    constexpr double stride = 0.05;
    while (far > stride && found(far - stride) > wanted) far -= stride;
    double near = far - stride;
    if (!(found(near) < wanted)) return false;
    for (int step = 0; step < 18; ++step) {
      const double middle = 0.5 * (near + far);
      (found(middle) < wanted ? near : far) = middle;
    }
    return std::fabs(found(far) - wanted) < 0.2 * std::fabs(wanted);
  }

  bool ground_;
  cmb_scene scene_{};
};

struct Contestant {
  std::unique_ptr<ContactPeer> peer;
  std::vector<double> times;  // of a query in each sweep, microseconds
  double median() {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
  }
};

struct Ratio {
  std::string row;
  double value, engine, peer;
};

// Who is asked: the engine and its peers.
std::array<Contestant, 3> contestants_for(const PosedPair &pair, Question question) {
  std::array<Contestant, 3> result;
  const bool distance = question == Question::distance;
  result[0].peer = question == Question::touch ? make_engine_within_bounds(pair) : make_engine(pair);
  result[1].peer = distance ? make_coal_distance(pair) : make_coal_collide(pair, true);
  result[2].peer = distance ? make_fcl_distance(pair) : make_fcl_collide(pair);
  return result;
}

// Whether the answer is one to the column's question. A peer that knows no contact of such a pair says that there is none, and one that
// knows no distance another one.
bool is_answer(double answer, const Column &column) {
  constexpr double tolerance = 0.1;  // by the distance
  switch (column.question) {
    case Question::contact: return std::isfinite(answer);
    case Question::touch: return !(answer < 0.0);
    default: return std::fabs(answer - column.distance) < tolerance * column.distance;
  }
}

// Of the engine to the quicker peer at the pair's poses; 0 where no peer answers.
Ratio measure(const PosedPair &pair, const Column &column) {
  std::array<Contestant, 3> contestants = contestants_for(pair, column.question);
  const std::size_t poses = pair.pose_a.size();
  for (Contestant &one : contestants) {
    if (!one.peer) continue;
    std::size_t answers = 0;
    for (std::size_t k = 0; k < poses; ++k) answers += is_answer(one.peer->ask(k), column) ? 1 : 0;  // also warms up
    if (&one != contestants.data() && 2 * answers < poses) one.peer.reset();
  }
  double spent = 0.0;
  for (int sweep = 0; sweep < 31 && (sweep < 3 || spent < most_of_a_row); ++sweep) {
    for (Contestant &one : contestants) {
      if (!one.peer) continue;
      const double begin = processor_microseconds();
      for (std::size_t k = 0; k < poses; ++k) one.peer->ask(k);
      const double taken = processor_microseconds() - begin;
      one.times.push_back(taken / static_cast<double>(poses));
      spent += taken;
    }
  }
  Ratio result{"", 0.0, contestants[0].median(), HUGE_VAL};
  for (Contestant *one : {&contestants[1], &contestants[2]}) {
    if (one->peer) result.peer = std::min(result.peer, one->median());
  }
  if (std::isfinite(result.peer)) result.value = result.engine / result.peer;
  return result;
}

// Prints the row of a pair and keeps its ratios.
void run(const Kind &a, const Kind &b, std::size_t poses, std::vector<Ratio> &ratios) {
  PosedPair pair;
  pair.descriptor_a = a.text;
  pair.descriptor_b = b.text;
  pair.a = parse_descriptor(a.text)[0];
  pair.b = parse_descriptor(b.text)[0];
  const Placer placer(a, b);
  std::printf("| %s, %s |", a.name, b.name);
  for (const Column &column : columns) {
    pair.pose_a.clear();
    pair.pose_b.clear();
    placer.place(column, pair.has_mesh() ? std::max<std::size_t>(poses / 4, 4) : poses, pair);
    if (pair.pose_a.size() < 4) {
      std::printf(" |");
      continue;
    }
    Ratio ratio = measure(pair, column);
    if (ratio.value > 0.0) {
      std::printf(" %.2f (%.3g) |", ratio.value, ratio.engine);
      ratio.row = std::string(a.name) + ", " + b.name + ", " + column.name;
      ratios.push_back(std::move(ratio));
    } else {
      std::printf(" (%.3g) |", ratio.engine);
    }
  }
  std::printf("\n");
  std::fflush(stdout);
}

void print_summary(std::vector<Ratio> &ratios) {
  if (ratios.empty()) return;
  std::sort(ratios.begin(), ratios.end(), [](const Ratio &x, const Ratio &y) { return x.value > y.value; });
  double logarithms = 0.0;
  std::size_t slower = 0;
  for (const Ratio &ratio : ratios) {
    logarithms += std::log(ratio.value);
    slower += ratio.value > 1.0 ? 1 : 0;
  }
  std::printf("\n%zu of %zu ratios are above 1, their geometric mean is %.2f, the median %.2f. The worst:\n\n", slower, ratios.size(),
              std::exp(logarithms / static_cast<double>(ratios.size())), ratios[ratios.size() / 2].value);
  std::printf("| pair | ratio | engine (us) | peer (us) |\n|---|---|---|---|\n");
  for (std::size_t k = 0; k < std::min<std::size_t>(ratios.size(), 20); ++k) {
    std::printf("| %s | %.2f | %.3g | %.3g |\n", ratios[k].row.c_str(), ratios[k].value, ratios[k].engine, ratios[k].peer);
  }
}

}  // namespace

int main(int argc, char **argv) {
  const std::size_t poses = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 64;
  const std::vector<Kind> kinds = all_kinds();
  const auto is_known = [&](const char *name) {
    return std::any_of(kinds.begin(), kinds.end(), [&](const Kind &kind) { return std::strcmp(kind.name, name) == 0; });
  };
  if (poses < 4 || argc > 4 || (argc > 2 && !is_known(argv[2])) || (argc > 3 && !is_known(argv[3]))) {
    std::fprintf(stderr, "usage: bench_pairs [poses a row, 4 or more [kind [kind]]]\nkinds:");
    for (const Kind &kind : kinds) std::fprintf(stderr, " %s", kind.name);
    std::fprintf(stderr, "\n");
    return 2;
  }
  std::printf("| pair |");
  for (const Column &column : columns) std::printf(" %s |", column.name);
  std::printf("\n|---|---|---|---|---|---|---|\n");
  std::vector<Ratio> ratios;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t j = i; j < kinds.size(); ++j) {
      const Kind &a = kinds[i].ground ? kinds[j] : kinds[i], &b = kinds[i].ground ? kinds[i] : kinds[j];
      const auto is = [](const Kind &kind, const char *name) { return std::strcmp(kind.name, name) == 0; };
      const bool wanted = argc <= 2 || (argc == 3 ? is(a, argv[2]) || is(b, argv[2])
                                                  : (is(a, argv[2]) && is(b, argv[3])) || (is(a, argv[3]) && is(b, argv[2])));
      if (wanted && !a.ground) run(a, b, poses, ratios);
    }
  }
  print_summary(ratios);
  return 0;
}
