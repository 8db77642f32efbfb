/* fmurt_nominal.c - see fmurt_nominal.h.
 *
 * Positions are known to a tenth of a micrometre at best where their size is taken for 1 m. A ball of a millimetre gets as
 * deep into a floor as that in an impact, and what it comes back with is then left to chance. */
#include "fmurt_nominal.h"

#include <math.h>
#include <string.h>

/* Bodies thinner than this, in m, are small; the share of their thickness by which they may overlap. */
static const double small = 0.1, overlap = 0.01;

void fmurt_fit_nominals(fmurt_values *values) {
  if (fmurt_model.state_count == 0) return;
  memcpy(values->state_nominal, fmurt_model.state_nominal, fmurt_model.state_count * sizeof *values->state_nominal);
  double least = HUGE_VAL;
  for (size_t k = 0; k < fmurt_model.thickness_count; ++k) {
    const double thickness = values->real[fmurt_model.thickness[k]];
    if (thickness > 0.0 && thickness < least) least = thickness;
  }
  if (!(least < small) || fmurt_model.is_length == NULL) return;
  for (size_t i = 0; i < fmurt_model.state_count; ++i) {
    if (fmurt_model.is_length[i]) values->state_nominal[i] = overlap * least;
  }
}
