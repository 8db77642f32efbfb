#include "contact_multibody_modelica.h"

#include <math.h>

#include "contact_multibody.h"

/* Supplied by the Modelica tool (ModelicaUtilities.h of the Modelica specification); does not return. */
extern void ModelicaFormatError(const char *string, ...);

/* A model is trusted as code is: it may name any file. */
static const char *const all_files = "/";

int cmb_modelica_intern(const char **geometry, size_t body_count, const int *pairs, size_t pair_count, int backend) {
  cmb_scene scene = 0;
  const cmb_status status =
      cmb_intern_with_files((const char *const *)geometry, body_count, pairs, pair_count, (cmb_backend)backend,
                            all_files, &scene);
  if (status != CMB_OK) {
    ModelicaFormatError("ContactMultiBody: %s: %s\n", cmb_status_text(status), cmb_last_error());
  }
  return scene;
}

void cmb_modelica_query(int scene, const double *position, size_t body_count, const double *rotation,
                        size_t pair_count, size_t point_capacity, double *distance, double *depth,
                        double *weight, double *normal, double *point) {
  const cmb_status status = cmb_query_scene(scene, position, rotation, body_count, pair_count, point_capacity,
                                            distance, depth, weight, normal, point);
  if (status != CMB_OK) {
    ModelicaFormatError("ContactMultiBody: %s: %s\n", cmb_status_text(status), cmb_last_error());
  }
}

void cmb_modelica_query_volume(int scene, const double *position, size_t body_count, const double *rotation,
                               size_t pair_count, double *distance, double *depth, double *weight, double *normal,
                               double *point) {
  cmb_modelica_query(scene, position, body_count, rotation, pair_count, 1, distance, depth, weight, normal, point);
  for (size_t i = 0; i < pair_count; ++i) {
    depth[i] = 0.0;
    weight[i] = 0.0;
    if (distance[i] >= 0.0) continue;
    cmb_overlap overlap;
    const cmb_status status = cmb_query_overlap(scene, i, position, rotation, body_count, &overlap);
    if (status != CMB_OK) {
      ModelicaFormatError("ContactMultiBody: %s: %s\n", cmb_status_text(status), cmb_last_error());
    }
    if (!overlap.known) {
      ModelicaFormatError(
          "ContactMultiBody: the overlap of pair %u has no volume law: give boxes or hulls, or spheres on half-spaces "
          "up to their middle, or use the ContactManager\n",
          (unsigned)(i + 1));
    }
    if (overlap.volume <= 0.0 || overlap.patch_area <= 0.0) continue;
    /* Twice the mean depth of the volume. A side's mean lies volume/(2 area) from patch_centroid. */
    double rise = 0.0;
    for (size_t k = 0; k < 3; ++k) {
      rise += normal[3 * i + k] * (overlap.patch_centroid[k] - overlap.centroid[k]);
      point[3 * i + k] = overlap.centroid[k];
    }
    depth[i] = overlap.volume / overlap.patch_area + 2.0 * fabs(rise);
    weight[i] = overlap.volume / depth[i];
  }
}
