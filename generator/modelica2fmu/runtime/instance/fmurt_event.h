/* fmurt_event.h - event indicators and event iteration.
 *
 * Scheme. relation[i] is the remembered truth of "indicator i > 0". While integrating it is frozen, so the
 * right-hand side stays smooth across the zero of the indicator g. Outside, the indicator is shown shifted,
 *
 *   z = g + e   where relation[i] is 1,      z = g - e   where it is 0,
 *
 * so z is never zero after an event: a relation that was true becomes false at g = -e, one that was false
 * becomes true at g = +e, and right after the change z is 2 e away from its next zero. At events the
 * relation changes where z has reached or passed zero. Hence a root is never found twice, and noise smaller
 * than e does not chatter. e is the indicator's nominal value times FMURT_HYSTERESIS or, if that is more,
 * FMURT_HYSTERESIS_BY_TOLERANCE of the importer's tolerance: where steps are allowed errors of 1e-5, the first one after
 * a slow parting may lead back by more than 1e-10. */
#ifndef FMURT_EVENT_H
#define FMURT_EVENT_H

#include "fmurt_instance.h"

#define FMURT_HYSTERESIS 1e-10
#define FMURT_HYSTERESIS_BY_TOLERANCE 1e-6

/* The shifted indicators z, [indicator_count], of up-to-date values. */
fmurt_result fmurt_event_indicators(fmurt_instance *instance, double *shifted);

/* Carries out the event at the present time: relations, discrete equations and pre() values are repeated until
 * nothing changes. *states_changed is set to 1 if a state was reinitialized and left alone otherwise.
 * A time within rounding of the next time event is taken to be that time. */
fmurt_result fmurt_iterate_events(fmurt_instance *instance, int *states_changed);

/* The last event of a simulation: terminal() is true in it. */
fmurt_result fmurt_terminate(fmurt_instance *instance);

#endif
