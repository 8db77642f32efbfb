/* contact_multibody_modelica.h - the engine as Modelica's external "C" calls it.
 *
 * Arrays come row-major as Modelica passes them. Errors are reported through ModelicaFormatError,
 * which does not return. */
#ifndef CONTACT_MULTIBODY_MODELICA_H
#define CONTACT_MULTIBODY_MODELICA_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Interns a scene and returns its handle. pairs is [pair_count][2], 1-based.
 * backend: 0 auto, 1 analytic, 2 libccd, 3 FCL (see contact_multibody.h). */
int cmb_modelica_intern(const char **geometry, size_t body_count, const int *pairs, size_t pair_count, int backend);

/* The thickness of the thinner body of each pair, [pair_count]; see cmb_pair_thickness. */
void cmb_modelica_pair_thickness(int scene, size_t pair_count, double *thickness);

/* Evaluates all pairs, cheaper those farther apart than exact_within (m, > 0; infinity or a number that large: exact
 * everywhere); see cmb_query_scene. */
void cmb_modelica_query_within(int scene, double exact_within, const double *position, size_t body_count,
                               const double *rotation, size_t pair_count, size_t point_capacity, double *distance,
                               double *depth, double *weight, double *normal, double *point);

/* Evaluates the overlap of all pairs as four points each, for forces proportional to the volume: the points of a pair have
 * one depth (m); their weights (m2) times the depth sum to the volume, and times half the squared depth to the integral
 * of half the squared depth over the area, exactly so where one side of the overlap is flat. Their mean is the volume's
 * centroid; they lie as far from it as the patch's second moment says. All arrays have four slots a pair; distance has
 * one. Pairs whose overlap the engine does not know (see cmb_overlap) are an error.
 * exact_within: as of cmb_modelica_query_within, of distances; overlaps are the same. */
void cmb_modelica_query_volume_within(int scene, double exact_within, const double *position, size_t body_count,
                                      const double *rotation, size_t pair_count, double *distance, double *depth,
                                      double *weight, double *normal, double *point);

/* Bodies that pass through each other between the ends of an integrator's step; see cmb_find_passage. For the integrator of an
 * FMU.
 * pair    receives their 1-based numbers; 0: there are none
 * number  receives the share of the step, the thickness of the thinner one, and how fast they come nearer there */
void cmb_modelica_find_passage(int scene, size_t body_count, double duration, const double *begin, const double *end,
                               int (*at)(void *context, double share, double *motion), void *context, int *pair,
                               double *number);

#ifdef __cplusplus
}
#endif

#endif
