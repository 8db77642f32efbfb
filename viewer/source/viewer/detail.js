/* How sharply a picture that must keep up is drawn. */

// Share of the resolution, and whether bodies are drawn with few triangles.
const STEPS = [[1, false], [0.7, false], [0.7, true], [0.5, true], [0.35, true], [0.25, true]];
// Milliseconds a picture: what takes longer on the average is drawn coarser; what would not with the next finer step, finer.
const SLOW = 14, QUICK = 7;
const SOON = 5, LATER = 90;

/** Chooses a viewer's `detail` and `coarse` by how long its pictures take. */
export class Detail {
  constructor(viewer) {
    this.viewer = viewer;
    this.patience = LATER;
    this.begin(0);
  }

  /** A picture took so long. */
  note(milliseconds) {
    this.count += 1;
    this.sum += milliseconds;
    const mean = this.sum / this.count;
    if (this.count >= SOON && mean > SLOW && this.step < STEPS.length - 1) {
      // A finer step that was tried and is too slow is tried again much later.
      if (this.tried) this.patience *= 4;
      this.begin(this.step + 1);
    } else if (this.count >= this.patience) {
      const finer = mean < QUICK && this.step > 0;
      this.begin(this.step - finer);
      this.tried = finer;
    }
  }

  begin(step) {
    this.step = step;
    [this.viewer.detail, this.viewer.coarse] = STEPS[step];
    this.count = this.sum = 0;
    this.tried = false;
  }
}
