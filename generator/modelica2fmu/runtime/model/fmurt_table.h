/* fmurt_table.h - interpolation in tables, for Modelica's CombiTable1D, CombiTable2D and CombiTimeTable.
 *
 * Functions of their arguments alone: no memory, safe in any thread. Arrays are not NULL and belong to the caller.
 * Outside of a table without extrapolation they end in ModelicaError. */
#ifndef FMURT_TABLE_H
#define FMURT_TABLE_H

#ifdef __cplusplus
extern "C" {
#endif

/* The numbers of Modelica.Blocks.Types.Smoothness, Extrapolation and TimeEvents. */
enum {
  FMURT_TABLE_LINEAR = 1,
  FMURT_TABLE_AKIMA = 2,
  FMURT_TABLE_CONSTANT = 3,
  FMURT_TABLE_FRITSCH_BUTLAND = 4,
  FMURT_TABLE_STEFFEN = 5,
  FMURT_TABLE_MODIFIED_AKIMA = 6
};
enum {
  FMURT_TABLE_HOLD = 1,
  FMURT_TABLE_LAST_TWO_POINTS = 2,
  FMURT_TABLE_PERIODIC = 3,
  FMURT_TABLE_NO_EXTRAPOLATION = 4
};
enum { FMURT_TABLE_ALL_EVENTS = 1, FMURT_TABLE_EVENTS_AT_JUMPS = 2, FMURT_TABLE_NO_EVENTS = 3 };

/* The curve through (x[i], y[i]), 0 <= i < n, x rising, at u: its value (order 0), its
 * slope (order 1) or its second derivative (order 2), which jumps at points. */
double fmurt_table_value(const double *x, const double *y, int n, int smoothness, int extrapolation, double u,
                         int order);

/* The surface through z[i * columns + j] at (x[i], y[j]), linear or constant between these, at (u, v): its value
 * (order 0), or its slope along u (1) or v (2). */
double fmurt_table_surface(const double *x, int rows, const double *y, int columns, const double *z, int smoothness,
                           int extrapolation, double u, double v, int order);

/* A curve over the time, at `time`; x may have equal neighbours, where it jumps. Zero before `start`.
 *   next, before: the next event as fmurt_table_next_event gave it, and its value before the present event iteration:
 *                 while they are equal and `time` has reached them, the curve is where it comes from. */
double fmurt_table_at_time(const double *x, const double *y, int n, int smoothness, int extrapolation, double start,
                           double shift, double time, double next, double before, int order);

/* The first event of such a curve after `time`, or DBL_MAX. */
double fmurt_table_next_event(const double *x, int n, int extrapolation, double start, double shift, int events,
                              double time);

#ifdef __cplusplus
}
#endif

#endif
