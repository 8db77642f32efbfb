"use strict";
/* Plays what was recorded: poses, forces and the way of the machine over time, as animation.py encodes them. */

/** Pose between two frames of a track of seven numbers a frame. */
function poseBetween(track, frame, share) {
  const a = 7 * frame, pose = new Array(7);
  if (!(share > 0) || a + 14 > track.length) return Array.from(track.subarray(a, a + 7));
  const b = a + 7;
  for (let k = 0; k < 7; k++) pose[k] = track[a + k] + share * (track[b + k] - track[a + k]);
  const n = Math.hypot(pose[3], pose[4], pose[5], pose[6]) || 1;
  for (let k = 3; k < 7; k++) pose[k] /= n;
  return pose;
}

/** Shows recorded frames in a viewer; data: see animation.py. */
class Playback {
  constructor(viewer, data) {
    const {decodeArray} = contactViewer;
    this.viewer = viewer;
    this.time = decodeArray(data.time, Float64Array);
    this.tracks = data.bodies.map(body => decodeArray(body.track, Float32Array));
    this.forces = data.forces.map(force => decodeArray(force.track, Float32Array));
    this.travel = decodeArray(data.travel, Float32Array);
    this.seek(this.time[0]);
  }

  seek(time) {
    this.now = time;
    const frame = contactViewer.lastNotAfter(this.time, time), next = Math.min(frame + 1, this.time.length - 1);
    const span = this.time[next] - this.time[frame];
    this.frame = frame;
    this.share = span > 0 ? Math.min(1, Math.max(0, (time - this.time[frame]) / span)) : 0;
    const viewer = this.viewer, t = this.travel;
    viewer.way = [0, 1, 2].map(i => t[3 * frame + i] + this.share * (t[3 * next + i] - t[3 * frame + i]));
    this.tracks.forEach((track, k) => viewer.place(k, track.length === 7 ? track : poseBetween(track, frame, this.share)));
    viewer.forces = this.forces.map(track => track.subarray(6 * frame, 6 * frame + 6));
    viewer.draw();
  }
}

if (typeof module !== "undefined") module.exports = {poseBetween};
