/* passage_numbers.h - a passage as Modelica's external "C" gives it. */
#ifndef CMB_PASSAGE_NUMBERS_H
#define CMB_PASSAGE_NUMBERS_H

#include "contact_multibody_scene.h"

static inline void cmb_tell_passage(const cmb_passage *passage, int *pair, double *number) {
  pair[0] = passage->body_a;
  pair[1] = passage->body_b;
  number[0] = passage->share;
  number[1] = passage->thickness;
  number[2] = passage->speed;
}

#endif
