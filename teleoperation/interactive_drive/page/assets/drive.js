"use strict";
/* Puts the page together: machine, buttons, controls and plots. */

(function () {
  const get = id => document.getElementById(id);
  const ALWAYS = ["add", "clear"];
  const OLD_PICTURE = 500;
  let viewer = null, detail = null, scene = null, controls = null, plots = null, status = null, steering = {you: false, free: false}, first = null;
  let latency = NaN, frame = null, waiting = false, channel = "";
  const stamps = new Map();

  const link = new Link(message => {
    ({frame: onFrame, hello: onHello, status: onStatus, steering: onSteering, plots: m => plots.show(m.names), controls: m => controls && controls.show(m.values),
      records: onRecords, remark: onRemark, lost: onLost})[message.type](message);
  });
  const say = type => () => link.send({type});

  function onHello(hello) {
    get("model").textContent = document.title = hello.model;
    frame = null;
    channel = hello.channel;
    plots = new contactPlots.LivePlots(get("live"), hello.units);
    plots.show(hello.plots);
    get("signals").replaceChildren(...hello.signals.map(name => new Option(name, name)));
    get("inputs").hidden = !hello.controls.length;
    if (!controls) controls = new DriveControls(get("sliders"), hello.controls, hello.keyMap, sendValues);
    get("keys").textContent = hello.keyMap.keys.map(k => `${k.key}: ${k.control} ${contactPlots.valueText(k.value)}`).join(" · ");
    if (!scene) loadScene();
  }

  async function loadScene() {
    try {
      const answer = await fetch("/scene.json");
      scene = await answer.json();
      if (!scene) { get("stage").hidden = get("drawing").hidden = true; return; }
      viewer = new contactViewer.Viewer(get("canvas"), scene);
      viewer.follow = true;
      detail = new contactViewer.Detail(viewer);
      contactViewer.makeViewControls(get("drawing"), viewer, true);
      const tracks = scene.bodies.map(body => contactViewer.decodeArray(body.track, Float32Array));
      tracks.forEach((track, k) => viewer.place(k, track));
      first = middle(scene.moving.map(body => tracks[body]));
      get("key").replaceChildren(...scene.key.map(entry => {
        const item = document.createElement("span"), mark = document.createElement("i");
        mark.style.background = entry.color;
        item.append(mark, entry.label);
        return item;
      }));
      if (frame) schedule();
    } catch (error) {
      onRemark({text: `The machine cannot be drawn: ${error.message}`, bad: true});
    }
  }

  function sendValues(values) {
    const stamp = performance.now();
    if (stamps.size > 200) stamps.clear();
    stamps.set(stamp, stamp);
    link.send({type: "values", values, stamp});
  }

  function onFrame(message) {
    frame = message.frame;
    if (plots) for (const sample of frame.samples) plots.add(sample.time, sample.signals);
    schedule();
  }

  /** One picture is under way at a time, and shows the newest frame: a queue of pictures would grow old. */
  function schedule() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(draw);
  }

  async function draw() {
    const shown = frame;
    try {
      if (shown) await picture(shown);
    } finally {
      waiting = false;
    }
    if (frame && frame !== shown) schedule();
  }

  async function picture(shown) {
    if (controls) controls.poll();
    get("clock").textContent = `t = ${shown.time.toFixed(3)} s`;
    showFigures();
    if (viewer) {
      if (!moves()) detail.begin(0);
      scene.moving.forEach((body, k) => viewer.place(body, shown.poses[k]));
      viewer.way = way();
      viewer.forces = shown.forces;
      const took = await viewer.show();
      if (moves()) detail.note(took);
    }
    // Told when it is drawn, not when it comes: what is under way is never more than what can be drawn.
    link.send({type: "seen", number: shown.number});
    requestAnimationFrame(() => noteLatency(shown.stamp));
  }

  /** = true, while pictures must keep up; one that stands is as sharp as can be. */
  function moves() {
    return status && status.mode === "running";
  }

  /** Called when the browser is ready for the picture after the one that shows what inputs up to a stamp did: that one is on the screen. */
  function noteLatency(shown) {
    const now = performance.now();
    for (const stamp of stamps.keys()) {
      if (stamp <= shown) { latency = now - stamp; stamps.delete(stamp); }
    }
  }

  /** Also between frames: a picture that no newer one replaces grows old. */
  function showFigures() {
    if (!frame) return;
    const parts = [], age = link.clock.age(frame.heard, Date.now()), running = moves();
    if (running && isFinite(frame.factor)) parts.push(`real-time factor ${frame.factor.toFixed(2)}`);
    if (frame.steps) parts.push(`${frame.missed} of ${frame.steps} deadlines missed`);
    if (running && isFinite(age)) parts.push(`picture ${age.toFixed(0)} ms old`);
    if (isFinite(latency)) parts.push(`input to picture ${latency.toFixed(0)} ms`);
    if (channel) parts.push(`simulated channel: ${channel}`);
    get("figures").textContent = parts.join(" · ");
    get("figures").classList.toggle("old", running && age > OLD_PICTURE);
  }
  setInterval(showFigures, 100);

  /** How far the middle of the moving bodies is from where it was first; the viewer follows it along the floor. */
  function way() {
    if (!frame.poses.length) return [0, 0, 0];
    return middle(frame.poses).map((place, i) => place - first[i]);
  }

  function middle(poses) {
    return [0, 1, 2].map(i => poses.reduce((sum, pose) => sum + pose[i], 0) / poses.length);
  }

  function onStatus(message) {
    status = message;
    get("run").textContent = status.mode === "running" ? "Pause" : "Run";
    get("record").textContent = status.recording ? "End the record" : "Record";
    get("record").classList.toggle("on", status.recording);
    const chosen = get("saved").value;
    get("saved").replaceChildren(...status.saved.slice().reverse().map(state =>
      new Option(`t = ${state.time.toFixed(2)} s${state.automatic ? " (automatic)" : ""}`, state.number)));
    if ([...get("saved").options].some(option => option.value === chosen)) get("saved").value = chosen;
    const stopped = status.mode === "failed" || status.mode === "ended";
    get("alarm").hidden = !stopped;
    get("alarm-text").textContent = stopped ? status.message : "";
    get("alarm-actions").replaceChildren(...(status.mode === "failed" ? offers() : stopped ? [button("Start again", {type: "restart"})] : []));
    if (frame) schedule();
    if (status.message && !stopped) onRemark({text: status.message});
    refresh();
  }

  function onRecords({names}) {
    get("records").replaceChildren(...names.reverse().map(name => new Option(name, name)));
    get("records").hidden = get("replay").hidden = !names.length;
  }

  function offers() {
    const last = status.saved[status.saved.length - 1];
    const back = last ? [button(`Go back to the last good state, t = ${last.time.toFixed(2)} s`, {type: "restore", number: last.number})] : [];
    return [...back, button("Reset", {type: "reset"})];
  }

  function button(text, message) {
    const made = document.createElement("button");
    made.type = "button";
    made.textContent = text;
    made.onclick = () => link.send(message);
    return made;
  }

  function onSteering(message) {
    steering = message;
    refresh();
  }

  function refresh() {
    const words = {starting: "starting", running: "running", paused: "paused", failed: "stopped with an error", ended: "ended"};
    const others = steering.operators > 1 ? `, ${steering.operators} operators` : "";
    const replayed = status && status.replayed;
    get("state").textContent = `${replayed ? `replay of ${replayed}, ` : ""}${status ? words[status.mode] : "connecting"} · ${steering.you ? "you steer" : "you watch"}${others}`;
    get("steer").hidden = steering.you || !steering.free;
    for (const node of document.querySelectorAll("main button, main select")) {
      if (!ALWAYS.includes(node.id) && node.id !== "steer" && !node.closest(".plot, #drawing")) node.disabled = !steering.you;
    }
    if (status && !status.keeps_states) get("save").disabled = get("restore").disabled = true;
    get("replay").textContent = replayed ? "Back to the machine" : "Replay";
    get("record").disabled ||= Boolean(replayed);
    if (controls) controls.enable(steering.you && !replayed);
  }

  function onRemark({text, bad}) {
    const item = document.createElement("li");
    item.textContent = text;
    item.className = bad ? "bad" : "";
    get("remarks").prepend(item);
    while (get("remarks").children.length > 5) get("remarks").lastChild.remove();
  }

  function onLost() {
    steering = {you: false, free: false};
    get("state").textContent = "the connection is lost; the program ended, or this page must be opened with a new address";
    if (controls) controls.enable(false);
  }

  const toggle = () => link.send({type: status && status.mode === "running" ? "pause" : "run"});
  const reset = () => { link.send({type: "reset"}); if (controls) controls.rest(); };
  get("run").onclick = toggle;
  get("step").onclick = say("step");
  get("reset").onclick = reset;
  get("save").onclick = say("save");
  get("steer").onclick = say("steer");
  get("restore").onclick = () => link.send({type: "restore", number: Number(get("saved").value)});
  get("speed").onchange = event => link.send({type: "speed", value: Number(event.target.value)});
  get("record").onclick = () => link.send({type: "record", on: !(status && status.recording)});
  get("replay").onclick = () => link.send(status && status.replayed ? {type: "leave"} : {type: "replay", record: get("records").value});
  get("add").onclick = () => { link.send({type: "signals", names: [...plots.names, get("signal").value]}); get("signal").value = ""; };
  get("clear").onclick = () => link.send({type: "signals", names: []});
  window.addEventListener("keydown", event => {
    if (event.target.type === "text" || event.target.tagName === "SELECT" || event.target.tagName === "BUTTON") return;
    if (event.ctrlKey || event.metaKey || event.altKey || !steering.you) return;
    const action = {Space: toggle, Period: say("step"), KeyR: reset}[event.code];
    if (action) { event.preventDefault(); action(); }
  });
})();
