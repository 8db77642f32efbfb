"use strict";
/* The course of a session: number, pictures with answers, end. What is stored is known to the program alone. */

const by = id => document.getElementById(id);
const tab = Array.from(crypto.getRandomValues(new Uint32Array(4)), n => n.toString(16)).join("");
let scene = null, state = null, stop = () => {}, shown = 0, techniques = [], trial = null, viewer = null, dots = null;

function show(id) {
  for (const part of document.querySelectorAll("main")) part.hidden = part.id !== id;
}

function tell(text) {
  by("trouble").textContent = text;
  by("trouble").hidden = !text;
}

/** Asks the program; null and a message on the page if that did not work. */
async function ask(path, data) {
  let reply;
  try {
    reply = await fetch(path, data === undefined ? {} : {
      method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(data),
    });
  } catch {
    tell("The study's program does not answer. Start it again, then press the button once more.\n"
       + "What you answered before is stored.");
    return null;
  }
  let result = {};
  try {
    result = await reply.json();
  } catch {
    result = { error: "the program's answer was broken off" };
  }
  if (reply.ok) {
    tell("");
    return result;
  }
  if (reply.status === 409 && result.kind === "answered") {  // stored before, by another tab or a lost reply
    tell(result.error);
    const now = await begin(state.observer);
    if (now) tell("This picture had been answered already; here is the next one.");
    return null;
  }
  tell(result.error + (reply.status === 507 ? "\nThis answer is not stored yet; press Next once more." : ""));
  return null;
}

/** A row of nine numbers to choose from. */
function makeScale(id, least, greatest) {
  const row = document.createElement("div");
  row.className = "scale";
  const end = text => {
    const span = document.createElement("span");
    span.className = "end";
    span.textContent = text;
    return span;
  };
  row.append(end(least));
  for (let number = 1; number <= 9; number++) {
    const label = document.createElement("label"), input = document.createElement("input");
    Object.assign(input, { type: "radio", name: id, value: String(number) });
    label.append(input, String(number));
    row.append(label);
  }
  row.append(end(greatest));
  by(id).append(row);
}

function chosen(name) {
  const input = document.querySelector(`input[name="${name}"]:checked`);
  return input ? Number(input.value) : null;
}

function checkAnswer() {
  by("next").disabled = chosen("absolute") === null || (state.position > 0 && chosen("relative") === null);
}

function fitCanvas() {
  const canvas = by("picture"), aspect = state.view.aspect;
  const width = Math.max(320, Math.min(window.innerWidth, (window.innerHeight - 300) * aspect));
  canvas.style.width = `${Math.round(width)}px`;
  canvas.style.height = `${Math.round(width / aspect)}px`;
}

/** Whether a test of the goggles found left and right swapped; kept while the browser is open. */
function swapped(technique, value) {
  const key = `swapped ${technique}`;
  if (value !== undefined) sessionStorage.setItem(key, value ? "yes" : "");
  return Boolean(sessionStorage.getItem(key));
}

function showPicture() {
  stop();
  if (!viewer) viewer = new contactViewer.Viewer(by("picture"), scene.viewer);
  stop = showView(viewer, { ...state.view, swapped: swapped(state.view.technique) }, scene);
}

/** Shows a constellation, the machine swinging if it moves. Returns a function that ends it. */
function showView(shownBy, view, { swing, lengths }) {
  const begin = performance.now();
  let handle = 0;
  shownBy.view = { camera: view.camera, output: view.technique, swapped: view.swapped, lengths };
  function draw(now) {
    const half = view.moving ? swing.angle * Math.sin(2 * Math.PI * (now - begin) / 1000 / swing.period) / 2 : 0;
    shownBy.place(0, [0, 0, swing.depth, 0, Math.sin(half), 0, Math.cos(half)]);
    shownBy.draw();
    if (view.moving) handle = requestAnimationFrame(draw);
  }
  draw(begin);
  return () => {
    cancelAnimationFrame(handle);
    shownBy.view.output = "plain";
  };
}

function showConstellation() {
  stop();
  if (state.finished) {
    by("who").textContent = state.observer;
    show("end");
    return;
  }
  show("show");
  by("answer").reset();
  by("relative").hidden = state.position === 0;
  by("progress").textContent = `Picture ${state.position + 1} of ${state.total}`;
  by("picture").hidden = state.view === null;
  if (state.view) {
    by("goggles").textContent = state.view.goggles;
    fitCanvas();
    showPicture();
  } else {
    by("goggles").textContent = Object.entries(state.levels).map(([name, level]) => `${name}: ${level}`).join(", ");
  }
  checkAnswer();
  shown = performance.now();
}

async function begin(observer) {
  const result = await ask("/begin", { observer, tab });
  if (result === null) return false;
  state = result;
  location.hash = String(observer);  // a reloaded page goes on
  showConstellation();
  return true;
}

function showDots() {
  stop();
  const canvas = by("dots"), { technique } = trial.view, { width, height } = canvas;
  const draw = dotPictures(width, height, 2 * trial.truths[trial.answers.length], Math.max(3, Math.round(width / 160)));
  if (!dots) dots = new contactViewer.FlatPictures(canvas);
  stop = dots.show(technique, swapped(technique), ...["left", "right"].map(eye => {
    const picture = Object.assign(document.createElement("canvas"), { width, height });
    draw(picture.getContext("2d"), eye);
    return picture;
  }));
}

function showWelcome(start) {
  scene = start.scene;
  techniques = start.techniques;
  by("goggles-test").hidden = !techniques.length;
  by("technique").replaceChildren(...techniques.map(view => new Option(view.technique)));
  document.title = start.title;
  by("title").textContent = start.title;
  by("total").textContent = start.total;
  by("observer").value = start.free;
  by("unfinished").textContent = start.unfinished.length
    ? `Not finished yet: observer ${start.unfinished.join(", ")}.` : "";
  show("welcome");
}

by("begin").addEventListener("submit", event => {
  event.preventDefault();
  begin(Number(by("observer").value));
});

by("goggles-test").addEventListener("submit", event => {
  event.preventDefault();
  const view = techniques.find(known => known.technique === by("technique").value);
  trial = { view, truths: shuffled(TRIALS), answers: [] };
  by("test-goggles").textContent = view.goggles;
  by("verdict").textContent = "";
  by("choices").hidden = false;
  show("test");
  showDots();
});

by("choices").addEventListener("click", event => {
  if (event.target.dataset.answer === undefined) return;
  trial.answers.push(Number(event.target.dataset.answer));
  if (trial.answers.length < trial.truths.length) {
    showDots();
    return;
  }
  stop();
  const verdict = gogglesVerdict(trial.truths, trial.answers), technique = trial.view.technique;
  if (verdict.crossed) swapped(technique, !swapped(technique));
  by("choices").hidden = true;
  by("verdict").textContent = verdict.text;
});

by("delete").addEventListener("submit", async event => {
  event.preventDefault();
  const observer = Number(by("deleted").value);
  const start = await ask("/delete", { observer });
  if (start === null) return;
  by("delete").reset();
  showWelcome(start);
  by("done").textContent = `The answers of observer ${observer} are deleted.`;
});

by("answer").addEventListener("change", checkAnswer);

by("answer").addEventListener("submit", async event => {
  event.preventDefault();
  if (by("next").disabled) return;
  by("next").disabled = true;
  const result = await ask("/answer", {
    observer: state.observer, tab, position: state.position, absolute: chosen("absolute"),
    relative: state.position ? chosen("relative") : null, seconds: (performance.now() - shown) / 1000,
  });
  if (result === null) {
    checkAnswer();
    return;
  }
  state = result;
  showConstellation();
});

for (const change of ["resize", "scroll"]) {  // rows for polarised displays are counted on the screen
  window.addEventListener(change, () => {
    if (state && !state.finished && state.view && !by("show").hidden) {
      if (change === "resize") fitCanvas();
      showPicture();
    }
  });
}

makeScale("absolute", "1: none, flat", "9: as in reality");
makeScale("relative", "1: much less", "9: much more (5: the same)");
(async () => {
  const start = await ask("/start");
  if (start === null) return;
  showWelcome(start);
  const number = Number(location.hash.slice(1));
  if (Number.isInteger(number) && number > 0) await begin(number);
})();
