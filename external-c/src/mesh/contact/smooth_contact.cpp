#include <algorithm>
#include <cmath>

#include "math/pose_algebra.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/contact/nearest_triangle.hpp"
#include "mesh/contact/patch_load.hpp"
#include "mesh/contact/smooth_facets.hpp"
#include "mesh/contact/triangle_convex_distance.hpp"
#include "mesh/core/triangle_wedge.hpp"
#include "mesh/intersection/pierced_load.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

namespace {

// Everything in the mesh's frame but the result.
class SmoothQuery {
 public:
  SmoothQuery(const convex::ConvexBody &body, const Pose &body_in_mesh, const TriangleMesh &mesh, const Pose &pose,
              MeshContactScratch &scratch, ContactSet &result)
      : body_(body),
        place_(body_in_mesh),
        mesh_(mesh),
        pose_(pose),
        scratch_(scratch),
        result_(result),
        sectioned_(body, body_in_mesh, scratch.patch.polygon, scratch.patch.clipped),
        box_(sectioned_.bounds()) {
    size_ = 0.5 * norm(box_.high - box_.low);
  }

  void run() {
    const Vec3 center = 0.5 * (box_.low + box_.high);
    const NearestPoint nearest = mesh_.nearest(center);
    // A body that no triangle meets touches only what its middle is in, or nothing.
    if (!(nearest.distance < 0.0 && mesh_.closed()) && apart(nearest.triangle)) return;
    // No place of the body is deeper than this; what pushes it lies within twice that.
    const double deepest = size_ - nearest.distance;
    PatchLoad load(mesh_, pose_, center, scratch_.patch);
    if (deepest > 0.0) {
      const double farthest = std::fmin(size_, 2.0 * deepest);
      mesh_.hierarchy().visit_near(
          box_, [&] { return farthest * farthest; }, [&](std::uint32_t t) { triangle(t, load); });
    }
    const std::size_t begin = result_.points.size();
    if (load.touches()) load.finish(result_);
    const double carried =
        mesh_.closed() ? total_load(result_.points, begin) : limit_by_sections(sectioned_, mesh_, begin, result_);
    if (!complete_contact(sectioned_, mesh_, pose_, carried, result_)) apart(nearest.triangle);
  }

 private:
  void triangle(std::uint32_t t, PatchLoad &load) {
    const Vec3 &normal = mesh_.face_normal(t);
    if (!(sectioned_.reach(-normal) + dot(normal, mesh_.corner(t, 0)) > 0.0)) return;
    TriangleWedge wedge;
    if (!wedge.build_if_it_meets(mesh_, t, size_, 0.5 * (box_.low + box_.high), size_)) return;
    if (!wedge.may_be_reached([this](const Vec3 &d) { return sectioned_.reach(d); })) return;
    Vec3 corner[6];
    if (wedge.hull(corner) && are_parted(corner, body_, place_)) return;
    const Vec3 local = transposed_times(place_.rotation, normal);
    Facets &facets = scratch_.facets;
    const double factor = facets_below(body_, local, wedge.depth(place_.translation), facets);
    for (const Facets::Facet &facet : facets.facets) {
      if (!(dot(facet.normal, local) < 0.0)) continue;
      scratch_.patch.polygon.clear();
      for (std::size_t k = 0; k < facet.count; ++k) {
        scratch_.patch.polygon.push_back(place_(facets.corners[facet.first + k]));
      }
      load.push(wedge, place_.rotation * facet.normal, factor);
    }
  }

  // Whether no triangle meets the body; sets distance, normal and witness then. The search begins with triangle `first`.
  bool apart(std::uint32_t first) {
    NearestTriangle nearest(mesh_);
    Vec3 towards;  // from the body to the nearest triangle so far: most others are farther in this direction alone
    double reach = 0.0;
    const auto offer = [&](std::uint32_t t) {
      const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
      const double enough = nearest.distance();
      if (std::min({dot(towards, a), dot(towards, b), dot(towards, c)}) - reach > enough) return;
      if (!nearest.offer(triangle_convex_gap(a, b, c, body_, place_, enough), t)) return;
      towards = -nearest.direction();
      reach = sectioned_.reach(towards);
    };
    const bool none_meets = nearest.search(box_, first, offer);
    nearest.write(pose_, result_);
    return none_meets;
  }

  const convex::ConvexBody &body_;
  const Pose &place_;
  const TriangleMesh &mesh_;
  const Pose &pose_;
  MeshContactScratch &scratch_;
  ContactSet &result_;
  SectionedBody sectioned_;
  Bounds box_;
  double size_ = 0.0;
};

}  // namespace

void smooth_contact(const convex::ConvexBody &body, const Pose &body_pose, const TriangleMesh &mesh, const Pose &pose,
                    MeshContactScratch &scratch, ContactSet &result) {
  const Pose body_in_mesh = relative_pose(pose, body_pose);
  SmoothQuery(body, body_in_mesh, mesh, pose, scratch, result).run();
}

}  // namespace cmb::mesh
