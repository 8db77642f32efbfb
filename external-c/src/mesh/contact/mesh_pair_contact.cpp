#include <cmath>
#include <utility>

#include "math/pose_algebra.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/contact/patch_load.hpp"
#include "mesh/contact/sheet_patches.hpp"
#include "mesh/distance/mesh_pair_distance.hpp"
#include "mesh/elastic/elastic_points.hpp"
#include "mesh/elastic/pair_overlap.hpp"
#include "mesh/intersection/interior_points.hpp"
#include "mesh/intersection/mesh_crossings.hpp"
#include "mesh/intersection/pierced_load.hpp"

namespace cmb::mesh {

namespace {

// The middle of what the meshes' boxes have in common; moves steadily. In the first mesh's frame.
Vec3 common_center(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place) {
  const Bounds &one = mesh.hierarchy().bounds(), other = moved(body.hierarchy().bounds(), place);
  Vec3 center;
  for (int k = 0; k < 3; ++k) {
    center.set(k, 0.5 * (std::fmax(one.low[k], other.low[k]) + std::fmin(one.high[k], other.high[k])));
  }
  return center;
}

struct PlacedMesh {
  const TriangleMesh &mesh;
  const Pose &pose;
};

// Appends what the overlap with the closed `other`, whose pose in the frame of `one` is `place`, stores behind the triangles of `one`;
// normals point out of `one`.
CarriedLoad push(const PlacedMesh &one, const TriangleMesh &other, const Pose &place, const PlacedVertices &vertices,
            MeshContactScratch &scratch, ContactSet &result) {
  PairOverlap overlap(one.mesh, other, place, vertices, scratch.pair_overlap);
  // Of parts that hang together with nothing that comes through a sheet nothing says that they are behind it.
  if (!one.mesh.closed()) {
    scratch.components.assign(other.component_count(), 0);
    for (const Crossings::Cut &cut : scratch.crossings.cuts) scratch.components[other.component_of(cut.pair.facet)] = 1;
    overlap.count_only(scratch.components);
  }
  overlap.add_all();
  const WedgeEnergy stored(overlap, scratch.elastic.energy);
  if (!stored.touches()) return 0.0;
  const std::size_t begin = result.points.size();
  const double load = append_elastic_points(overlap, stored, one.pose, scratch.elastic.points, result);
  // Where a wide shallow contact joins a narrow deep one, it pushes less than what faces it carries, and lacks nothing; not so where it
  // hardly pushes.
  constexpr double most_lost = 5.0;
  const double counted = std::fmin(load, most_lost * total_load(result.points, begin));
  return {counted, std::fmin(counted, norm(net_load(result.points, begin))), stored.carrying_depth()};
}

// Appends what the triangles of the sheet `one` push of the sheet `other`, whose pose in its frame is `place`; normals point
// out of `one`. Leaves their crossings in `scratch`.
void push_sheet(const PlacedMesh &one, const TriangleMesh &other, const Pose &place, MeshContactScratch &scratch, ContactSet &result) {
  const PlacedVertices vertices(other, place, scratch.placed);
  find_crossings(one.mesh, other, place, vertices, scratch.crossings);
  PatchLoad load(one.pose, common_center(one.mesh, other, place), scratch.patch);
  push_sheet_patches(one.mesh, other, place, vertices, scratch.crossings, scratch.sheets, scratch.patch, load);
  if (load.touches()) load.finish(result);
}

// Multiplies the load of the points from `begin` on by `part`.
void scale(std::vector<ContactPoint> &points, std::size_t begin, double part) {
  for (std::size_t k = begin; k < points.size(); ++k) points[k].weight *= part;
}

// Adds the contact in `from`, reversed, its load and depth multiplied by `part`.
void add_reversed(ContactSet &from, double part, ContactSet &result) {
  reverse(from);
  scale(from.points, 0, part);
  for (const ContactPoint &point : from.points) {
    if (point.weight > 0.0) result.points.push_back(point);
  }
  if (!(part * from.distance < result.distance)) return;
  result.distance = part * from.distance;
  result.normal = from.normal;
  result.witness = from.witness;
}

// The contact of two meshes, not both sheets, of which `one` pushes and whose crossings are in `scratch`; normals point out of `one`.
// Of what is behind a sheet it carries least_load_part times what crosses at most. Where it carries too little of what crosses, or lies in
// the other, the other one pushes too, unless `one` is a sheet, and if it cannot either, the crossing triangles and the interior points do.
// `place`: the other's pose in its frame. Returns whether the meshes touch.
bool push_out(const PlacedMesh &one, const PlacedMesh &other, const Pose &place, const PlacedVertices &vertices, MeshContactScratch &scratch,
              ContactSet &result) {
  const std::size_t begin = result.points.size();
  const double nothing = rounding_of_crossings(one.mesh, other.mesh);
  CarriedLoad carried = push(one, other.mesh, place, vertices, scratch, result);
  if (!one.mesh.closed() && carried.load > 0.0) {
    const double depths =
        depths_of_crossings(one.mesh, other.mesh, place, scratch.crossings, nothing, carried.load / least_load_part);
    const double load = total_load(result.points, begin);
    carried.scale(limit_load(least_load_part * depths / carried.load * load, begin, result) / load);
  }
  const double enough = carried.enough();
  const double crossing = deepest_crossing(one.mesh, other.mesh, place, scratch.crossings, std::fmax(nothing, enough));
  if (!one.mesh.closed() && carried.load > 0.0 && crossing == 0.0) return true;
  // Places inside each may lie in the other; so it is where one has swallowed the other, whether or not they are flush.
  const Pose back = place.inverse();
  const InteriorPoints in_one(one.mesh, other.mesh, place, enough), in_other(other.mesh, one.mesh, back, enough);
  const double depth = std::fmax(crossing, std::fmax(in_one.depth(), in_other.depth()));
  if (carried.load > 0.0 && !(depth > enough)) return true;
  if (!(depth > 0.0)) return false;
  if (!(carried.load > 0.0)) result.distance = 0.0;
  PiercedLoad pierced(common_center(one.mesh, other.mesh, place));
  push_crossings(one.mesh, other.mesh, place, scratch.crossings, pierced);
  ContactSet &reaction = scratch.reaction;
  const double through = one.mesh.closed() ? depth : crossing;
  const double lacking = carried.load > 0.0 ? lacking_part(carried.counted(through), through) : 1.0;
  // A sheet pushes to its front alone, whatever the sides of the body that passes through it would do.
  if (one.mesh.closed()) {
    reaction.points.clear();
    reaction.distance = 0.0;
    const CarriedLoad by_other = push(other, one.mesh, back, PlacedVertices(one.mesh, back, scratch.placed), scratch, reaction);
    add_reversed(reaction, lacking, result);
    const double both = carried.load + lacking * by_other.load;
    carried = {both, std::fmin(both, norm(net_load(result.points, begin))), std::fmax(carried.depth, by_other.depth)};
  }
  const double part = lacking * lacking_part(carried.counted(depth), depth);
  pierced.finish(part, one.pose, result);
  in_one.push_out(crossing, part, one.pose, result);
  reaction.points.clear();
  reaction.distance = 0.0;
  in_other.push_out(std::fmax(crossing, in_one.depth()), part, other.pose, reaction);
  add_reversed(reaction, 1.0, result);
  return result.distance < 0.0;
}

// Whether two meshes have anything in common: surfaces that do not cross part all of one from all of the other, or hold it.
bool may_overlap(const PlacedMesh &one, const PlacedMesh &other, const Pose &place, const Crossings &crossings) {
  return any_meet(one.mesh, other.mesh, place, crossings) || may_hold_component(one.mesh, other.mesh, place) || may_hold_component(other.mesh, one.mesh, place.inverse());
}

// The contact of two meshes, not both sheets, of which `one` pushes; normals point out of it. Returns whether they touch.
bool contact(const PlacedMesh &one, const PlacedMesh &other, MeshContactScratch &scratch, ContactSet &result) {
  const Pose place = relative_pose(one.pose, other.pose);
  const PlacedVertices vertices(other.mesh, place, scratch.placed);
  find_crossings(one.mesh, other.mesh, place, vertices, scratch.crossings);
  return may_overlap(one, other, place, scratch.crossings) && push_out(one, other, place, vertices, scratch, result);
}

// The same of two closed meshes of which neither is the larger one: both push, half each, so that none is told from the other.
bool contact_of_equals(const PlacedMesh &one, const PlacedMesh &other, MeshContactScratch &scratch, ContactSet &result) {
  const Pose place = relative_pose(one.pose, other.pose), back = relative_pose(other.pose, one.pose);
  const std::size_t begin = result.points.size();
  const auto push_half = [&](const PlacedMesh &from, const PlacedMesh &to, const Pose &to_in_from, const PlacedVertices &vertices, std::size_t first,
                             ContactSet &half) {
    const bool touches = push_out(from, to, to_in_from, vertices, scratch, half);
    if (!touches) half.points.resize(first), half.distance = 0.0;
    scale(half.points, first, 0.5);
    half.distance *= 0.5;
    return touches;
  };
  const PlacedVertices vertices(other.mesh, place, scratch.placed);
  find_crossings(one.mesh, other.mesh, place, vertices, scratch.crossings);
  if (!may_overlap(one, other, place, scratch.crossings)) return false;
  const bool touches = push_half(one, other, place, vertices, begin, result);
  for (Crossings::Cut &cut : scratch.crossings.cuts) std::swap(cut.pair.triangle, cut.pair.facet);
  ContactSet &opposite = scratch.opposite;
  opposite.points.clear();
  opposite.distance = 0.0;
  const bool opposite_touches = push_half(other, one, back, PlacedVertices(one.mesh, back, scratch.placed), 0, opposite);
  const double distance = result.distance + opposite.distance;
  add_reversed(opposite, 1.0, result);
  result.distance = distance;
  return touches || opposite_touches;
}

// The contact of two sheets; normals point out of `one`. Both push, half each, what of the other's front is behind their own.
// Nothing says where behind a sheet that ends. But sheets that touch from elsewhere than their fronts have hardly come through
// at first, and those that have come through nearly altogether hardly hang together any more: their crossings are small.
// So the load is least_load_part times what these are deep together, at most. Where it is too little for the deepest of them,
// the crossing triangles push as well. Returns whether the sheets touch, which is whether they cross.
bool sheet_contact(const PlacedMesh &one, const PlacedMesh &other, MeshContactScratch &scratch, ContactSet &result) {
  const std::size_t begin = result.points.size();
  const Pose place = relative_pose(one.pose, other.pose), back = relative_pose(other.pose, one.pose);
  result.distance = 0.0;
  push_sheet(one, other.mesh, place, scratch, result);
  PiercedLoad pierced(common_center(one.mesh, other.mesh, place)), piercing(common_center(other.mesh, one.mesh, back));
  push_sheet_crossings(one.mesh, other.mesh, place, scratch.crossings, rounding_of_crossings(one.mesh, other.mesh), pierced, piercing);
  const double crossing = pierced.deepest();
  if (!(crossing > 0.0)) {
    result.points.resize(begin);
    return false;
  }
  ContactSet &reaction = scratch.reaction;
  reaction.points.clear();
  reaction.distance = 0.0;
  push_sheet(other, one.mesh, back, scratch, reaction);
  scale(result.points, begin, 0.5);
  scale(reaction.points, 0, 0.5);
  const double load = total_load(result.points, begin) + total_load(reaction.points);
  const double limit = least_load_part * pierced.depths(), part = load > limit ? limit / load : 1.0;
  scale(result.points, begin, part);
  result.distance *= part;
  add_reversed(reaction, part, result);
  const double lacking = lacking_part(part * load, crossing), count = pierced.count() + piercing.count();
  pierced.finish(lacking, one.pose, result, pierced.count() / count);
  reaction.points.clear();
  reaction.distance = 0.0;
  piercing.finish(lacking, other.pose, reaction, piercing.count() / count);
  add_reversed(reaction, 1.0, result);
  return true;
}

// Closed meshes as large as each other, to rounding of their coordinates: which of them is larger, a body's name and place would decide.
bool are_equals(const TriangleMesh &one, const TriangleMesh &other) {
  constexpr double rounding = 1e-9;
  return one.closed() && other.closed() &&
         std::fabs(one.bound_radius() - other.bound_radius()) <= rounding * (one.bound_radius() + other.bound_radius());
}

// Whether the first mesh pushes the second one's surface rather than the other way round: sheets do, which have no
// inside, and the larger body, whose surface is likely to be the flatter one.
bool pushes(const TriangleMesh &one, const TriangleMesh &other) {
  if (one.closed() != other.closed()) return !one.closed();
  return one.bound_radius() > other.bound_radius();
}

}  // namespace

bool mesh_pair_touch(const TriangleMesh &a, const Pose &pose_a, const TriangleMesh &b, const Pose &pose_b,
                     MeshContactScratch &scratch, ContactSet &result) {
  const PlacedMesh first{a, pose_a}, second{b, pose_b};
  const auto touch = are_equals(a, b) ? contact_of_equals : a.closed() || b.closed() ? contact : sheet_contact;
  if (!pushes(a, b)) return touch(second, first, scratch, result);
  if (!touch(first, second, scratch, result)) return false;
  reverse(result);
  return true;
}

void mesh_pair_contact(const TriangleMesh &a, const Pose &pose_a, const TriangleMesh &b, const Pose &pose_b,
                       MeshContactScratch &scratch, ContactSet &result) {
  if (mesh_pair_touch(a, pose_a, b, pose_b, scratch, result)) return;
  const TrianglePair nearest = mesh_pair_distance(a, b, relative_pose(pose_a, pose_b));
  result.distance = nearest.distance;
  result.normal =
      normalized(pose_a.rotation * (nearest.on_a - nearest.on_b), pose_b.rotation * b.face_normal(nearest.b));
  result.witness = pose_a(0.5 * (nearest.on_a + nearest.on_b));
}

}  // namespace cmb::mesh
