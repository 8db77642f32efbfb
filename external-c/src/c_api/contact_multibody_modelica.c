#include "contact_multibody_modelica.h"

#include <math.h>

#include "contact_multibody.h"
#include "c_api/passage_numbers.h"

/* Supplied by the Modelica tool (ModelicaUtilities.h of the Modelica specification); does not return. */
extern void ModelicaFormatError(const char *string, ...);

static void report(cmb_status status) {
  if (status != CMB_OK) {
    ModelicaFormatError("ContactMultiBody: %s: %s\n", cmb_status_text(status), cmb_last_error());
  }
}

/* A model is trusted as code is: it may name any file. */
static const char *const all_files = "/";

int cmb_modelica_intern(const char **geometry, size_t body_count, const int *pairs, size_t pair_count, int backend) {
  const cmb_scene_source source = {.geometry = (const char *const *)geometry,
                                   .body_count = body_count,
                                   .pairs = pairs,
                                   .pair_count = pair_count,
                                   .backend = (cmb_backend)backend,
                                   .folder = all_files};
  cmb_scene scene = {0};
  report(cmb_intern(&source, &scene));
  return scene.number;
}

void cmb_modelica_pair_thickness(int scene, size_t pair_count, double *thickness) {
  for (size_t i = 0; i < pair_count; ++i) report(cmb_pair_thickness((cmb_scene){scene}, i + 1, &thickness[i]));
}

void cmb_modelica_query_within(int scene, double exact_within, const double *position, size_t body_count,
                               const double *rotation, size_t pair_count, size_t point_capacity, double *distance,
                               double *depth, double *weight, double *normal, double *point) {
  const cmb_poses poses = {body_count, position, rotation};
  const cmb_contact_points points = {pair_count, point_capacity, distance, depth, weight, normal, point};
  report(cmb_query_scene((cmb_scene){scene}, &poses, exact_within, &points));
}

enum { volume_points = 4 };

/* Four points about the centroid, in the plane of the normal: plus and minus sqrt(2) times the columns of a factor L of
 * the patch's second moment by its area, L L^T, so that the points have that second moment too. */
static void place_points(const cmb_overlap *overlap, const double *n, double *point) {
  double u[3] = {0, 0, 0}, v[3], w[3];
  const size_t least = fabs(n[0]) <= fabs(n[1]) && fabs(n[0]) <= fabs(n[2]) ? 0 : fabs(n[1]) <= fabs(n[2]) ? 1 : 2;
  u[least] = 1.0;
  const double along = n[least];
  for (size_t k = 0; k < 3; ++k) u[k] -= along * n[k];
  const double length = sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
  for (size_t k = 0; k < 3; ++k) u[k] /= length;
  for (size_t k = 0; k < 3; ++k) v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
  double uu = 0.0, uv = 0.0, vv = 0.0;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < 3; ++j) {
      const double moment = overlap->patch_moment[3 * i + j] / overlap->patch_area;
      uu += u[i] * moment * u[j];
      uv += u[i] * moment * v[j];
      vv += v[i] * moment * v[j];
    }
  }
  const double l11 = sqrt(fmax(uu, 0.0)), l21 = l11 > 0.0 ? uv / l11 : 0.0, l22 = sqrt(fmax(vv - l21 * l21, 0.0));
  for (size_t k = 0; k < 3; ++k) {
    w[k] = sqrt(2.0) * l22 * v[k];
    u[k] = sqrt(2.0) * (l11 * u[k] + l21 * v[k]);
    point[k] = overlap->centroid[k] + u[k];
    point[3 + k] = overlap->centroid[k] - u[k];
    point[6 + k] = overlap->centroid[k] + w[k];
    point[9 + k] = overlap->centroid[k] - w[k];
  }
}

void cmb_modelica_query_volume_within(int scene, double exact_within, const double *position, size_t body_count,
                                      const double *rotation, size_t pair_count, double *distance, double *depth,
                                      double *weight, double *normal, double *point) {
  cmb_modelica_query_within(scene, exact_within, position, body_count, rotation, pair_count, volume_points, distance,
                            depth, weight, normal, point);
  const cmb_poses poses = {body_count, position, rotation};
  for (size_t i = 0; i < pair_count; ++i) {
    double *const pair_depth = depth + volume_points * i, *const pair_weight = weight + volume_points * i;
    double *const pair_normal = normal + 3 * volume_points * i, *const pair_point = point + 3 * volume_points * i;
    for (size_t k = 0; k < volume_points; ++k) pair_depth[k] = pair_weight[k] = 0.0;
    for (size_t k = 3; k < 3 * volume_points; ++k) {
      pair_normal[k] = pair_normal[k % 3];
      pair_point[k] = pair_point[k % 3];
    }
    if (distance[i] >= 0.0) continue;
    cmb_overlap overlap;
    report(cmb_query_overlap((cmb_scene){scene}, i + 1, &poses, &overlap));
    if (!overlap.known) {
      ModelicaFormatError(
          "ContactMultiBody: the overlap of pair %u is not known: open meshes and height fields have no volume; close the "
          "mesh or use the ContactManager\n",
          (unsigned)(i + 1));
    }
    if (overlap.volume <= 0.0 || overlap.patch_area <= 0.0) continue;
    /* Twice the mean depth of the volume. The mean of a side lies volume/(2 area) from patch_centroid. */
    double rise = 0.0;
    for (size_t k = 0; k < 3; ++k) rise += pair_normal[k] * (overlap.patch_centroid[k] - overlap.centroid[k]);
    const double mean = overlap.volume / overlap.patch_area + 2.0 * fabs(rise);
    for (size_t k = 0; k < volume_points; ++k) {
      pair_depth[k] = mean;
      pair_weight[k] = overlap.volume / mean / volume_points;
    }
    place_points(&overlap, pair_normal, pair_point);
  }
}

void cmb_modelica_find_passage(int scene, size_t body_count, double duration, const double *begin, const double *end,
                               int (*at)(void *context, double share, double *motion), void *context, int *pair,
                               double *number) {
  const cmb_step step = {body_count, duration, begin, end, at, context};
  cmb_passage passage;
  report(cmb_find_passage((cmb_scene){scene}, &step, &passage));
  cmb_tell_passage(&passage, pair, number);
}
