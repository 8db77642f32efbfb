"use strict";
/* Puts the page together: the animation with its controls, the plots, and what links them. */

(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const links = {plots: [], onPick: null};
  // Colours for paper; before the plots hear of it, which draw with them.
  for (const [moment, on] of [["beforeprint", true], ["afterprint", false]]) {
    window.addEventListener(moment, () => document.documentElement.classList.toggle("printed", on));
  }
  contactPlots.makePlots(data.plots, links);
  if (data.animation) startAnimation(data.animation, links);

  function startAnimation(animation, plotLinks) {
    const get = id => document.getElementById(id);
    const stage = get("stage"), canvas = get("canvas");
    let viewer, playback;
    try {
      viewer = new contactViewer.Viewer(canvas, animation);
      playback = new Playback(viewer, animation);
    } catch (error) {
      canvas.remove();
      const note = document.createElement("div");
      note.className = "failure";
      note.style.position = "static";
      note.textContent = `The animation cannot be shown: ${error.message}`;
      stage.append(note);
      return;
    }
    const times = playback.time, start = times[0], stop = times[times.length - 1];
    const play = get("play"), scrub = get("scrub"), speed = get("speed"), clock = get("clock");
    let playing = false, last = 0;
    scrub.min = start;
    scrub.max = stop;
    scrub.step = (stop - start) / 2000 || 1e-3;

    function show(time, fromScrub) {
      const t = Math.min(stop, Math.max(start, time));
      playback.seek(t);
      clock.textContent = `t = ${t.toFixed(3)} s`;
      if (!fromScrub) scrub.value = t;
      for (const plot of plotLinks.plots) plot.setCursor(t);
    }
    function setPlaying(on) {
      playing = on;
      play.textContent = on ? "Pause" : "Play";
      if (on) {
        if (playback.now >= stop) show(start);
        last = performance.now();
        requestAnimationFrame(step);
      }
    }
    function step(now) {
      if (!playing) return;
      const time = playback.now + (now - last) / 1000 * Number(speed.value);
      last = now;
      if (time >= stop) {
        show(stop);
        if (get("repeat").checked) show(start); else { setPlaying(false); return; }
      } else show(time);
      requestAnimationFrame(step);
    }
    function move(frames) {
      setPlaying(false);
      let k = playback.frame + frames;
      if (frames < 0 && playback.share > 0) k += 1;
      show(times[Math.min(times.length - 1, Math.max(0, k))]);
    }

    play.onclick = () => setPlaying(!playing);
    scrub.oninput = () => { setPlaying(false); show(Number(scrub.value), true); };
    contactViewer.makeViewControls(get("drawing"), viewer, animation.forces.length > 0);
    canvas.addEventListener("keydown", event => {
      const action = {" ": () => setPlaying(!playing), ArrowRight: () => move(1), ArrowLeft: () => move(-1),
        Home: () => show(start), End: () => show(stop)}[event.key];
      if (action) { event.preventDefault(); action(); }
    });
    plotLinks.onPick = time => { setPlaying(false); show(time); };
    for (const row of document.querySelectorAll("tr[data-time]")) {
      row.onclick = () => {
        setPlaying(false);
        show(Number(row.dataset.time));
        stage.scrollIntoView({block: "center", behavior: "smooth"});
      };
    }
    if (window.matchMedia) window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => viewer.draw());

    // #t=1.25 opens the page at a time, &picture shows the animation alone.
    const wish = new URLSearchParams(location.hash.slice(1));
    if (wish.has("picture")) {
      document.body.classList.add("picture");
      for (const section of document.querySelectorAll("main section")) section.hidden = section.id !== "animation";
      viewer.reset();
    }
    show(wish.has("t") ? Number(wish.get("t")) || start : start);
  }
})();
