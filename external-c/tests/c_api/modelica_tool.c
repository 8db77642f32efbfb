/* What a Modelica tool generates, more or less: C, linked by a C compiler with the archive alone. */
#include <math.h>
#include <setjmp.h>
#include <stdio.h>

#include "contact_multibody_modelica.h"

void ModelicaFormatError(const char *format, ...);

static jmp_buf caller;

void ModelicaFormatError(const char *format, ...) {
  (void)format;
  longjmp(caller, 1);
}

/* The descriptor's error is thrown and caught within the engine. */
static int refuses(const char *descriptor) {
  const char *geometry[] = {descriptor};
  if (setjmp(caller) != 0) return 1;
  cmb_modelica_intern(geometry, 1, NULL, 0, 0);
  return 0;
}

int main(void) {
  const char *geometry[] = {"cmb/1 box size=1,1,1", "cmb/1 halfspace"};
  const int pairs[] = {1, 2};
  const double position[] = {0, 0, 0.49, 0, 0, 0};
  const double rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  double distance, depth[4], weight[4], normal[12], point[12], load = 0.0;
  int scene, i;
  if (!refuses("cmb/1 sphere radius=-1")) return puts("no error"), 2;
  scene = cmb_modelica_intern(geometry, 2, pairs, 1, 0);
  cmb_modelica_query_within(scene, HUGE_VAL, position, 2, rotation, 1, 4, &distance, depth, weight, normal, point);
  for (i = 0; i < 4; ++i) load += weight[i] * depth[i];
  return fabs(load - 0.01) < 1e-12 && fabs(distance + 0.01) < 1e-12 ? 0 : 1;
}
