"use strict";
/* The connection to the server: messages as JSON, frames as bytes (see frame_encoder.py). */

const FRAME_HEADER = 48;

/** A frame's numbers. buffer: little-endian bytes as frame_encoder.py writes them. */
function decodeFrame(buffer) {
  const view = new DataView(buffer);
  const bodies = view.getUint16(40, true), forces = view.getUint16(42, true), signals = view.getUint16(44, true);
  const samples = view.getUint16(46, true);
  const numbers = new Float32Array(buffer, FRAME_HEADER), first = 7 * bodies + 6 * forces, time = view.getFloat64(0, true);
  const sample = k => numbers.subarray(first + k * (1 + signals), first + (k + 1) * (1 + signals));
  return {
    time, stamp: view.getFloat64(8, true), heard: view.getFloat64(16, true),
    factor: view.getFloat32(24, true), number: view.getUint32(28, true),
    steps: view.getUint32(32, true), missed: view.getUint32(36, true),
    poses: Array.from({length: bodies}, (_, k) => numbers.subarray(7 * k, 7 * k + 7)),
    forces: Array.from({length: forces}, (_, k) => numbers.subarray(7 * bodies + 6 * k, 7 * bodies + 6 * k + 6)),
    samples: Array.from({length: samples}, (_, k) => ({time: time + sample(k)[0], signals: sample(k).subarray(1)})),
  };
}

/** The server's clock, by a message there and back: half of the quickest round trip is how wrong it is at most. */
class ServerClock {
  constructor() {
    this.trips = [];
  }

  /** Takes an answer. page, server, now: when it was asked and answered, and the present, each in ms of its own clock. */
  hear(page, server, now) {
    this.trips.push({trip: now - page, ahead: server - (page + now) / 2});
    if (this.trips.length > 20) this.trips.shift();
    const best = this.trips.reduce((least, each) => each.trip < least.trip ? each : least);
    this.ahead = best.ahead;
    this.trip = best.trip;
  }

  /** Age of what the server heard at a time of its clock, in ms; NaN before the first answer. */
  age(heard, now) {
    return this.trips.length ? Math.max(0, now + this.ahead - heard) : NaN;
  }
}

/** Hands frames and messages on, sends messages, and connects again when the connection is lost. */
class Link {
  constructor(hear) {
    this.hear = hear;
    this.clock = new ServerClock();
    this.connect();
    setInterval(() => this.askClock(), 1000);
  }

  connect() {
    this.socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/drive`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onmessage = event => {
      if (typeof event.data === "string") {
        const message = JSON.parse(event.data);
        if (message.type === "clock") this.clock.hear(message.page, message.server, Date.now());
        else this.hear(message);
        return;
      }
      this.hear({type: "frame", frame: decodeFrame(event.data)});
    };
    this.socket.onopen = () => this.askClock();
    this.socket.onclose = () => {
      this.hear({type: "lost"});
      setTimeout(() => this.connect(), 1000);
    };
  }

  askClock() {
    this.send({type: "clock", page: Date.now()});
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}

if (typeof module !== "undefined") module.exports = {decodeFrame, ServerClock};
