/* How sharply a picture that must keep up is drawn. */

const STEPS = [1, 0.7, 0.5, 0.35, 0.25];
// Milliseconds a picture: what takes longer on the average is drawn coarser; what would not with the next finer step, finer.
const SLOW = 24, QUICK = 7;
const SOON = 5, LATER = 90;

/** Chooses a viewer's `detail` by how long its pictures take. */
export class Detail {
  constructor(viewer) {
    this.viewer = viewer;
    this.begin(0);
  }

  /** A picture took so long. */
  note(milliseconds) {
    this.count += 1;
    this.sum += milliseconds;
    const mean = this.sum / this.count;
    if (this.count >= SOON && mean > SLOW && this.step < STEPS.length - 1) this.begin(this.step + 1);
    else if (this.count >= LATER) this.begin(this.step - (mean < QUICK && this.step > 0));
  }

  begin(step) {
    this.step = step;
    this.viewer.detail = STEPS[step];
    this.count = this.sum = 0;
  }
}
