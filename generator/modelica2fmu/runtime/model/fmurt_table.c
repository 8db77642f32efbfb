/* fmurt_table.c - interpolation in tables; see fmurt_table.h.
 *
 * Between its points a smooth curve is a cubic Hermite polynomial; its slopes at the points are those of
 *   Akima, Journal of the ACM 17(4), 1970, and its variant with weights |d| + |s|/2 (d difference, s sum of slopes),
 *   Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5(2), 1984,
 *   Steffen, Astronomy and Astrophysics 239, 1990,
 * the last two with the secant's slope at the ends, as Modelica's tables have it. Slopes are computed where they are
 * needed: two of them, from up to four neighbours. */
#include "fmurt_table.h"

#include <float.h>
#include <math.h>

#include "ModelicaUtilities.h"

/* A part of a curve without jumps: points first to last. */
typedef struct part {
  const double *x, *y;
  int first, last;
} part;

static int sign(double v) { return (v > 0.0) - (v < 0.0); }

/* The last interval that begins at or before u (from_left: before u), of the intervals 0 to n - 2. */
static int interval_of(const double *x, int n, double u, int from_left) {
  int low = 0, high = n - 1; /* x[low] is at or before u, or low is 0; x[high] is after it, or high is n - 1 */
  while (high - low > 1) {
    const int middle = low + (high - low) / 2;
    if (from_left ? x[middle] < u : x[middle] <= u) low = middle;
    else high = middle;
  }
  return low;
}

static double secant(const part *p, int i) { return (p->y[i + 1] - p->y[i]) / (p->x[i + 1] - p->x[i]); }

/* The secant's slope of an interval, beyond the ends continued linearly (Akima 1970). */
static double continued(const part *p, int i) {
  const int begin = p->first, end = p->last - 1;
  if (end == begin) return secant(p, begin);
  if (i < begin) return secant(p, begin) + (begin - i) * (secant(p, begin) - secant(p, begin + 1));
  if (i > end) return secant(p, end) + (i - end) * (secant(p, end) - secant(p, end - 1));
  return secant(p, i);
}

static double akima_slope(const part *p, int i, int modified) {
  const double m0 = continued(p, i - 2), m1 = continued(p, i - 1), m2 = continued(p, i), m3 = continued(p, i + 1);
  double left = fabs(m1 - m0), right = fabs(m3 - m2);
  if (modified) {
    left += 0.5 * fabs(m1 + m0);
    right += 0.5 * fabs(m3 + m2);
  }
  if (!(left + right > 0.0)) return 0.5 * (m1 + m2);
  return (right * m1 + left * m2) / (left + right);
}

/* Zero at extrema, so that the curve rises and falls with its points. */
static double monotone_slope(const part *p, int i, int smoothness) {
  if (i == p->first) return secant(p, i);
  if (i == p->last) return secant(p, i - 1);
  const double m0 = secant(p, i - 1), m1 = secant(p, i);
  const double h0 = p->x[i] - p->x[i - 1], h1 = p->x[i + 1] - p->x[i];
  if (sign(m0) * sign(m1) <= 0) return 0.0;
  if (smoothness == FMURT_TABLE_FRITSCH_BUTLAND) return 3.0 * (h0 + h1) / ((h0 + 2.0 * h1) / m0 + (2.0 * h0 + h1) / m1);
  const double parabola = (m0 * h1 + m1 * h0) / (h0 + h1);
  const double bound = 2.0 * fmin(fabs(m0), fabs(m1));
  return fabs(parabola) > bound ? sign(m0) * bound : parabola;
}

static double slope_at(const part *p, int i, int smoothness) {
  if (smoothness == FMURT_TABLE_AKIMA || smoothness == FMURT_TABLE_MODIFIED_AKIMA)
    return akima_slope(p, i, smoothness == FMURT_TABLE_MODIFIED_AKIMA);
  return monotone_slope(p, i, smoothness);
}

/* The part without jumps around interval i, which has a length. */
static part part_around(const double *x, const double *y, int n, int i) {
  part p = {x, y, i, i + 1};
  while (p.first > 0 && x[p.first - 1] < x[p.first]) --p.first;
  while (p.last < n - 1 && x[p.last + 1] > x[p.last]) ++p.last;
  return p;
}

/* Inside of interval i. */
static double inside(const double *x, const double *y, int n, int i, int smoothness, double u, int order) {
  const double h = x[i + 1] - x[i];
  if (!(h > 0.0)) return order == 0 ? y[i + 1] : 0.0;
  if (smoothness == FMURT_TABLE_CONSTANT) return order == 0 ? (u >= x[i + 1] ? y[i + 1] : y[i]) : 0.0;
  const double m = (y[i + 1] - y[i]) / h, v = u - x[i];
  if (smoothness == FMURT_TABLE_LINEAR) return order == 0 ? y[i] + m * v : order == 1 ? m : 0.0;
  const part p = part_around(x, y, n, i);
  const double s0 = slope_at(&p, i, smoothness), s1 = slope_at(&p, i + 1, smoothness);
  const double c2 = (3.0 * m - 2.0 * s0 - s1) / h, c3 = (s0 + s1 - 2.0 * m) / (h * h);
  if (order == 0) return y[i] + ((c3 * v + c2) * v + s0) * v;
  return order == 1 ? (3.0 * c3 * v + 2.0 * c2) * v + s0 : 6.0 * c3 * v + 2.0 * c2;
}

/* Linearly on from an end (0 or n - 1): by the curve's slope there, or by the last two points. */
static double beyond(const double *x, const double *y, int n, int end, int smoothness, double u, int order) {
  if (order > 1) return 0.0;
  const int i = end == 0 ? 0 : n - 2;
  double m = 0.0;
  if (x[i + 1] > x[i]) {
    const part p = part_around(x, y, n, i);
    const int straight = smoothness == FMURT_TABLE_LINEAR || smoothness == FMURT_TABLE_CONSTANT;
    m = straight ? secant(&p, i) : slope_at(&p, end, smoothness);
  }
  return order == 0 ? y[end] + m * (u - x[end]) : m;
}

static double outside(const double *x, const double *y, int n, int end, int smoothness, int extrapolation, double u,
                      int order) {
  if (extrapolation == FMURT_TABLE_NO_EXTRAPOLATION)
    ModelicaFormatError("a table from %g to %g has no value at %g, and no extrapolation was asked for", x[0], x[n - 1],
                        u);
  if (extrapolation == FMURT_TABLE_HOLD) return order == 0 ? y[end] : 0.0;
  return beyond(x, y, n, end, smoothness, u, order);
}

/* u moved into the table by whole periods. */
static double in_period(const double *x, int n, double u) {
  const double period = x[n - 1] - x[0];
  if (!(period > 0.0) || (u >= x[0] && u <= x[n - 1])) return u;
  return fmin(u - floor((u - x[0]) / period) * period, x[n - 1]);
}

double fmurt_table_value(const double *x, const double *y, int n, int smoothness, int extrapolation, double u,
                         int order) {
  if (n == 1) return order == 0 ? y[0] : 0.0;
  if (extrapolation == FMURT_TABLE_PERIODIC) u = in_period(x, n, u);
  if (u < x[0]) return outside(x, y, n, 0, smoothness, extrapolation, u, order);
  if (u > x[n - 1]) return outside(x, y, n, n - 1, smoothness, extrapolation, u, order);
  return inside(x, y, n, interval_of(x, n, u, 0), smoothness, u, order);
}

/* --- two dimensions --- */

/* Where u lies along one axis: values at i and i + 1 with weights. */
typedef struct place {
  int i;         /* the only point, or the first of two */
  double first;  /* weight of point i */
  double second; /* weight of point i + 1 */
} place;

static place place_on(const double *x, int n, int smoothness, int extrapolation, double u, int of_slope) {
  const place point = {0, of_slope ? 0.0 : 1.0, 0.0};
  if (n == 1) return point;
  if (extrapolation == FMURT_TABLE_PERIODIC) u = in_period(x, n, u);
  const int is_outside = u < x[0] || u > x[n - 1];
  if (is_outside && extrapolation == FMURT_TABLE_NO_EXTRAPOLATION)
    ModelicaFormatError("a table from %g to %g has no value at %g, and no extrapolation was asked for", x[0], x[n - 1],
                        u);
  if (is_outside && extrapolation == FMURT_TABLE_HOLD) {
    const place end = {u < x[0] ? 0 : n - 2, u < x[0] ? point.first : 0.0, u < x[0] ? 0.0 : point.first};
    return end;
  }
  place found = {interval_of(x, n, u, 0), 0.0, 0.0};
  const double h = x[found.i + 1] - x[found.i];
  if (smoothness == FMURT_TABLE_CONSTANT && !is_outside) {
    found.first = u >= x[found.i + 1] ? 0.0 : point.first;
    found.second = point.first - found.first;
  } else if (of_slope) {
    found.first = -1.0 / h;
    found.second = 1.0 / h;
  } else {
    found.second = (u - x[found.i]) / h;
    found.first = 1.0 - found.second;
  }
  return found;
}

double fmurt_table_surface(const double *x, int rows, const double *y, int columns, const double *z, int smoothness,
                           int extrapolation, double u, double v, int order) {
  const place a = place_on(x, rows, smoothness, extrapolation, u, order == 1);
  const place b = place_on(y, columns, smoothness, extrapolation, v, order == 2);
  double value = 0.0;
  for (int k = 0; k < 2 && a.i + k < rows; ++k)
    for (int l = 0; l < 2 && b.i + l < columns; ++l)
      value += (k == 0 ? a.first : a.second) * (l == 0 ? b.first : b.second) * z[(a.i + k) * columns + b.i + l];
  return value;
}

/* --- over the time --- */

/* What rounding may take from a time that was computed from an abscissa and back. */
static double rounding(const double *x, int n, double time) {
  return 16.0 * DBL_EPSILON * (fabs(time) + fabs(x[0]) + fabs(x[n - 1]));
}

double fmurt_table_at_time(const double *x, const double *y, int n, int smoothness, int extrapolation, double start,
                           double shift, double time, double next, double before, int order) {
  const int is_left_of_event = next == before && next < DBL_MAX && time >= next;
  if (time < start || (is_left_of_event && start >= next)) return 0.0;
  if (n == 1) return order == 0 ? y[0] : 0.0;
  double u = (is_left_of_event ? next : time) - shift;
  const double margin = rounding(x, n, u);
  if (extrapolation == FMURT_TABLE_PERIODIC) {
    const double period = x[n - 1] - x[0];
    const double aside = is_left_of_event ? -margin : margin;
    u -= floor((u + aside - x[0]) / period) * period;
  }
  if (is_left_of_event) {
    if (u < x[0] - margin || u > x[n - 1] + margin) {
      const int end = u < x[0] ? 0 : n - 1;
      return outside(x, y, n, end, smoothness, extrapolation, u, order);
    }
    if (u <= x[0] + margin && extrapolation != FMURT_TABLE_PERIODIC)
      return outside(x, y, n, 0, smoothness,
                     extrapolation == FMURT_TABLE_NO_EXTRAPOLATION ? FMURT_TABLE_HOLD : extrapolation, x[0], order);
    const int i = interval_of(x, n, u - margin, 1);
    if (smoothness == FMURT_TABLE_CONSTANT) return order == 0 ? y[i] : 0.0;
    return inside(x, y, n, i, smoothness, fmin(u, x[i + 1]), order);
  }
  if (u < x[0] - margin) return outside(x, y, n, 0, smoothness, extrapolation, u, order);
  if (u >= x[n - 1] - margin && extrapolation != FMURT_TABLE_PERIODIC)
    return outside(x, y, n, n - 1, smoothness, extrapolation, u, order);
  const int i = interval_of(x, n, u + margin, 0);
  if (smoothness == FMURT_TABLE_CONSTANT) return order == 0 ? y[i] : 0.0;
  return inside(x, y, n, i, smoothness, fmax(u, x[i]), order);
}

double fmurt_table_next_event(const double *x, int n, int extrapolation, double start, double shift, int events,
                              double time) {
  if (time < start) return start;
  if (n == 1) return DBL_MAX;
  double u = time - shift, offset = 0.0;
  const double margin = rounding(x, n, u);
  u += margin;
  if (extrapolation == FMURT_TABLE_PERIODIC) {
    const double period = x[n - 1] - x[0];
    if (!(period > 0.0)) return DBL_MAX;
    offset = floor((u - x[0]) / period) * period;
    u -= offset;
  } else if (u < x[0]) {
    return x[0] + shift;
  }
  if (!(u < x[n - 1])) return DBL_MAX;
  for (int i = interval_of(x, n, u, 0) + 1; i < n - 1; ++i) {
    const int jumps = !(x[i + 1] > x[i]);
    if (x[i] > u && (events == FMURT_TABLE_ALL_EVENTS || (events == FMURT_TABLE_EVENTS_AT_JUMPS && jumps)))
      return x[i] + offset + shift;
  }
  return x[n - 1] + offset + shift;
}
