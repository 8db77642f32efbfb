/* fmurt_failure.c - see fmurt_failure.h. */
#include "fmurt_failure.h"

#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>

#include "fmurt_instance.h"
#include "fmurt_interface.h"

static const char *failure_name(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_ACC: return "the tolerance asks for more accuracy than the numbers have";
    case CV_ERR_FAILURE: return "the error stays too large down to the shortest step";
    case CV_CONV_FAILURE: return "Newton's iteration does not converge down to the shortest step";
    case CV_LSETUP_FAIL:
    case CV_LSOLVE_FAIL: return "the Jacobian cannot be computed or is singular";
    case CV_RHSFUNC_FAIL: return "the model cannot be evaluated";
    case CV_FIRST_RHSFUNC_ERR: return "the model cannot be evaluated where a step begins";
    case CV_REPTD_RHSFUNC_ERR: return "the model cannot be evaluated in spite of shorter steps";
    case CV_UNREC_RHSFUNC_ERR: return "the model cannot be evaluated any more";
    case CV_RTFUNC_FAIL: return "the event indicators cannot be evaluated";
    case CV_MEM_FAIL: return "no memory";
    default: return "CVODE refuses to go on";
  }
}

void fmurt_describe_worst_state(void *cvode, N_Vector state, char *text, size_t size) {
  N_Vector error = N_VClone(state), weight = N_VClone(state);
  if (error != NULL && weight != NULL && CVodeGetEstLocalErrors(cvode, error) == CV_SUCCESS &&
      CVodeGetErrWeights(cvode, weight) == CV_SUCCESS) {
    sunindextype worst = 0;
    double largest = 0.0;
    for (sunindextype i = 0; i < NV_LENGTH_S(state); ++i) {
      const double size_of_error = fabs(NV_Ith_S(error, i) * NV_Ith_S(weight, i));
      if (size_of_error > largest) largest = size_of_error, worst = i;
    }
    snprintf(text, size, "; %.120s = %.6g has the largest",
             fmurt_slot_name(&fmurt_interface_tables.real, fmurt_model.state[worst]), NV_Ith_S(state, worst));
  }
  if (error != NULL) N_VDestroy(error);
  if (weight != NULL) N_VDestroy(weight);
}

void fmurt_describe_failure(int flag, double time, int maximum_steps, const char *cause, const char *state, char *text,
                            size_t size) {
  if (flag == CV_TOO_MUCH_WORK) {
    snprintf(text, size,
             "The integrator gives up at time %.15g: it needs more than %d steps in one communication step. If the model "
             "is right, raise cmbSolver.maximumSteps or take shorter communication steps",
             time, maximum_steps);
    return;
  }
  const char *end = cause;
  if (cause[0] == '\0' && (flag == CV_CONV_FAILURE || flag == CV_ERR_FAILURE)) {
    end = ". The tolerance may be too coarse for a contact's penetration, or the contact's stiffness too high";
  }
  snprintf(text, size, "The integrator stops at time %.9g: %s%s%.700s", time, failure_name(flag),
           cause[0] != '\0' ? ": " : state, end);
}
