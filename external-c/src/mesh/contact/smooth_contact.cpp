#include <algorithm>
#include <cmath>

#include "math/pose_algebra.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "mesh/contact/nearest_triangle.hpp"
#include "mesh/contact/overlap_contact.hpp"
#include "mesh/contact/triangle_convex_distance.hpp"
#include "mesh/elastic/round_overlap.hpp"
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
    const NearestPoint nearest = mesh_.nearest(0.5 * (box_.low + box_.high));
    // A body that no triangle meets touches only what its middle is in, or nothing.
    if (!(nearest.distance < 0.0 && mesh_.closed()) && apart(nearest.triangle)) return;
    RoundOverlap overlap(body_, place_, mesh_, scratch_.round);
    const auto support = [&](const Vec3 &d) { return place_(convex::swept_support(body_, transposed_times(place_.rotation, d))); };
    mesh_.visit_wedges(box_, size_, support, [&](std::uint32_t t) { overlap.add(t); });
    if (!append_overlap_contact(overlap, sectioned_, mesh_, pose_, scratch_.elastic, result_)) apart(nearest.triangle);
  }

 private:
  // Whether no triangle meets the body; sets distance, normal and witness then. The search begins with triangle `first`.
  bool apart(std::uint32_t first) {
    NearestTriangle nearest(mesh_);
    Vec3 towards;  // from the body to the nearest triangle so far: most others are farther in this direction alone
    double reach = 0.0;
    const auto offer = [&](std::uint32_t t) {
      const Vec3 &a = mesh_.corner(t, 0), &b = mesh_.corner(t, 1), &c = mesh_.corner(t, 2);
      const double enough = nearest.distance();
      if (std::min({dot(towards, a), dot(towards, b), dot(towards, c)}) - reach > enough) return;
      // Of a capsule that to its axis, from which directions are known however near its surface is.
      TriangleGap gap = triangle_convex_gap(a, b, c, body_, place_, enough + body_.radius);
      gap.distance = std::max(0.0, gap.distance - body_.radius);
      if (!nearest.offer(gap, t)) return;
      towards = -nearest.direction();
      reach = sectioned_.reach(towards);
    };
    const bool none_meets = nearest.search(box_, first, offer);
    nearest.write(pose_, result_);
    result_.witness = result_.witness - (0.5 * body_.radius) * result_.normal;
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
