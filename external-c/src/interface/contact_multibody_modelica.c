#include "contact_multibody_modelica.h"

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
