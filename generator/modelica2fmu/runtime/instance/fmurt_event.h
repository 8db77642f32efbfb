/* cmb_event.h - event indicators and event iteration.
 *
 * Scheme. relation[i] is the remembered truth of "indicator i > 0". While integrating it is frozen, so the
 * right-hand side stays smooth across the zero of the indicator g. Outside, the indicator is shown shifted,
 *
 *   z = g + e   where relation[i] is 1,      z = g - e   where it is 0,
 *
 * so z is never zero after an event: a relation that was true becomes false at g = -e, one that was false
 * becomes true at g = +e, and right after the change z is 2 e away from its next zero. At events the
 * relation changes where z has reached or passed zero. Hence a root is never found twice, and noise smaller
 * than e does not chatter. e is CMB_HYSTERESIS times the indicator's nominal value. */
#ifndef CMB_EVENT_H
#define CMB_EVENT_H

#include "cmb_instance.h"

#define CMB_HYSTERESIS 1e-10

/* The shifted indicators z, [indicator_count], of up-to-date values. */
cmb_result cmb_event_indicators(cmb_instance *instance, double *shifted);

/* Carries out the event at the present time: relations, discrete equations and pre() values are repeated until
 * nothing changes. *states_changed is set to 1 if a state was reinitialized and left alone otherwise.
 * A time within rounding of the next time event is taken to be that time. */
cmb_result cmb_iterate_events(cmb_instance *instance, int *states_changed);

/* The last event of a simulation: terminal() is true in it. */
cmb_result cmb_terminate(cmb_instance *instance);

#endif
