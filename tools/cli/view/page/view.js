// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

import { Camera } from "./camera.js";
import { KINDS, css, ramp, rangeText, RANGES } from "./colours.js";
import { readFrames } from "./frames.js";
import { Scene } from "./scene.js";
import { degradedText, drawStrip, figuresText } from "./strip.js";

const at = (id) => document.getElementById(id);
const canvas = at("scene");
const camera = new Camera();
const look = { colourBy: "label", hasOtherGround: false, shown: new Set(["road", "ground", "obstacle", "box", "way"]), pointSize: 1 };
const FOUND = new Map([["box", "objects"], ["way", "free_way"]]); // kinds of what is found, and the figures that tell of them
const MARKED_M = [20, 40, 60, 80, 100];

let scene;
let newest = null; // of the stream: {header, points}
let isDirty = true;
let isFresh = false; // points came since the last picture
let head = null; // of the last frame that came by sectors
const turns = []; // how long the last ones took, milliseconds; some are cut short, or were waited for
const drawn = []; // when pictures with a new frame were drawn, milliseconds

function say(trouble) {
  at("trouble").hidden = !trouble;
  at("trouble").textContent = trouble;
}

// --- the picture ---

function showDistances() {
  const spots = at("distances");
  if (spots.childElementCount === 0) {
    for (const metres of MARKED_M) spots.append(Object.assign(document.createElement("span"), { textContent: `${metres} m` }));
  }
  MARKED_M.forEach((metres, i) => {
    const place = camera.project([metres * Math.cos(0.6), -metres * Math.sin(0.6), 0]);
    const span = spots.children[i];
    span.style.visibility = place ? "visible" : "hidden";
    if (place) span.style.transform = `translate(${place[0] + 4}px, ${place[1] - 8}px)`;
  });
  const metres = [100, 50, 20, 10, 5, 2, 1].find((length) => length * camera.pixelsPerMetre <= 160) ?? 1;
  at("scale").firstElementChild.style.width = `${metres * camera.pixelsPerMetre}px`;
  at("scale").lastElementChild.textContent = `${metres} m`;
}

function draw(now) {
  requestAnimationFrame(draw);
  if (!isDirty) return;
  isDirty = false;
  if (newest) scene.setPoints(newest.points, newest.header.points, newest.header.pointBytes);
  newest = null;
  if (isFresh) drawn.push(now);
  isFresh = false;
  scene.draw(camera, look);
  showDistances();
}

// Which kinds of ground there are: that is for the method's settings to say, and shows in the labels.
function noteLabels({ header, points }) {
  if (look.hasOtherGround) return;
  for (let i = 13; i < points.length; i += header.pointBytes * 7) {
    if (points[i] !== 49) continue;
    look.hasOtherGround = true;
    showLook();
    return;
  }
}

// --- what was found in the frame that is shown ---

const found = { kinds: new Set(), isAsked: false, of: undefined }; // of the kinds that this run finds

const showsFound = () => [...found.kinds].some((kind) => look.shown.has(kind));

// Frames come while an answer is awaited: asks until it is that for the frame that is shown.
async function askForFound() {
  if (found.isAsked) return;
  found.isAsked = true;
  try {
    for (let frame; showsFound() && (frame = at("frame").dataset.number) !== found.of; found.of = frame) {
      scene.setFound(await (await fetch(`found/${frame}`, { cache: "no-store" })).json());
      isDirty = true;
    }
  } catch (error) {
    console.warn(error);
    found.of = undefined;
  }
  found.isAsked = false;
}

const milliseconds = (ns) => Number(ns / 1000n) / 1000;

function take(message) {
  const { header, points } = message;
  isDirty = isFresh = true;
  noteLabels(message);
  if (header.isSector) {
    const turn = [...turns].sort((a, b) => a - b)[turns.length >> 1] ?? Infinity;
    scene.addSector(points, header.points, header.pointBytes, milliseconds(header.firstPacketNs), turn);
    return;
  }
  // A whole frame, or the head of one that came by sectors.
  const returns = header.points + header.firstReturn;
  at("frame").textContent = `frame ${header.number} · ${returns.toLocaleString("en")} returns`;
  at("frame").dataset.number = header.number;
  askForFound();
  if (header.firstReturn === 0) {
    newest = message;
    return;
  }
  if (head && header.number === head.number + 1) turns.push(milliseconds(header.firstPacketNs - head.firstPacketNs));
  if (turns.length > 9) turns.shift();
  head = header;
}

async function follow() {
  for (;;) {
    try {
      for await (const message of readFrames("sectors")) {
        take(message);
        say("");
        // The next frame only when this one was drawn: what comes meanwhile is left out by the sender.
        if (!message.header.isSector) await new Promise(requestAnimationFrame);
      }
    } catch (error) {
      console.warn(error);
    }
    say("no connection to terracut; trying again");
    await new Promise((resolve) => setTimeout(resolve, 1000));
  }
}

// --- what is chosen ---

function showLook() {
  for (const button of at("colours").children) button.ariaPressed = button.dataset.colour === look.colourBy;
  for (const button of at("views").querySelectorAll("[data-view]")) button.ariaPressed = button.dataset.view === camera.view;
  for (const button of at("kinds").children) {
    const kind = button.dataset.kind;
    button.hidden = (kind === "road" && !look.hasOtherGround) || (FOUND.has(kind) && !found.kinds.has(kind));
    button.ariaPressed = look.shown.has(kind);
    button.firstElementChild.style.color = look.colourBy === "label" || FOUND.has(kind) ? css(KINDS[kind]) : "var(--quiet)";
  }
  const bar = at("ramp");
  bar.hidden = look.colourBy === "label";
  if (!bar.hidden) {
    const paint = bar.firstElementChild.getContext("2d");
    const gradient = paint.createLinearGradient(0, 0, 256, 0);
    ramp(look.colourBy).forEach((colour, i, all) => gradient.addColorStop(i / (all.length - 1), css(colour)));
    paint.fillStyle = gradient;
    paint.fillRect(0, 0, 256, 1);
    rangeText(look.colourBy).forEach((text, i) => (bar.children[i + 1].textContent = text));
  }
  isDirty = true;
}

function colourBy(name) {
  look.colourBy = name;
  showLook();
}
function toggle(kind) {
  if (!look.shown.delete(kind)) look.shown.add(kind);
  showLook();
  askForFound();
}
function see(view) {
  camera.look(view);
  showLook();
}

// --- a capture is played, its run is told so ---

const capture = { playing: true, position: 0, duration: 0, frameSeconds: 0.1, isHeld: false };

async function tell(command) {
  try {
    const response = await fetch("control", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(command) });
    if (!response.ok) say(await response.text());
    else showCapture((await response.json()).capture);
  } catch (error) {
    console.warn(error);
  }
}
const clock = (seconds) => `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, "0")}`;

function showCapture(state) {
  document.body.classList.toggle("capture", Boolean(state));
  at("transport").hidden = !state;
  if (!state) return;
  Object.assign(capture, { playing: state.playing, position: state.position_s, duration: state.duration_s, frameSeconds: state.frame_s });
  document.body.dataset.playing = state.playing;
  at("speed").value = String(state.rate);
  at("position").max = state.duration_s;
  if (!capture.isHeld) at("position").value = state.position_s;
  at("clock").textContent = `${clock(state.position_s)} / ${clock(state.duration_s)}`;
}
const playOrPause = () => tell({ playing: !capture.playing });
const step = (frames) => (frames === 1 ? tell({ step: true }) : tell({ playing: false, seek_s: Math.max(0, capture.position + frames * capture.frameSeconds) }));

// --- figures ---

async function watch() {
  for (;;) {
    try {
      const figures = await (await fetch("figures", { cache: "no-store" })).json();
      show(figures);
    } catch (error) {
      console.warn(error);
    }
    await new Promise((resolve) => setTimeout(resolve, 400));
  }
}

const durationText = (seconds) => (seconds < 120 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`);
const countText = (cause, count) => `${count} ${cause.replaceAll("_", " ")}`;

// How far the sensor sees, where that is watched.
function showSight(sight) {
  if (!sight && at("sight").hidden) return;
  at("sight").hidden = !sight;
  scene.setSight(sight ? sight.sectors : []);
  isDirty = true;
  if (!sight) return;
  at("sight").dataset.state = sight.state;
  at("sight").textContent = `view ${sight.text}`;
}

function show(figures) {
  at("sensor").textContent = figures.sensor;
  showSight(figures.sight);
  const kinds = [...FOUND].filter(([, figure]) => figures[figure]).map(([kind]) => kind);
  if (kinds.length !== found.kinds.size) {
    found.kinds = new Set(kinds);
    showLook();
    askForFound();
  }
  if (figures.rows > 1) RANGES.ring[1] = figures.rows - 1;
  at("times-title").textContent = figures.deadline_ms ? "after the last packet" : "work a frame";
  at("times-figures").textContent = figuresText(figures.frames);
  drawStrip(at("strip"), figures.frames, figures.deadline_ms);
  const losses = at("losses");
  losses.replaceChildren();
  const lost = [degradedText(figures.frames), ...figures.losses.map(([cause, count]) => countText(cause, count))];
  for (const text of lost.filter(Boolean)) losses.append(Object.assign(document.createElement("b"), { textContent: text }));
  if (!losses.childElementCount) losses.append("nothing lost, nothing degraded");
  for (const [cause, count] of figures.onlookers) losses.append(Object.assign(document.createElement("span"), { textContent: countText(cause, count) }));
  showCapture(figures.capture);
  const since = performance.now() - 2000;
  while (drawn.length > 0 && drawn[0] < since) drawn.shift();
  const silent = figures.silent_s > 1;
  at("rate").classList.toggle("silent", silent);
  at("rate").textContent = silent ? `silent since ${durationText(figures.silent_s)}` : drawn.length > 1 ? `${(drawn.length / 2).toFixed(1)} pictures/s` : "";
}

// --- hands ---

const KEYS = {
  1: () => colourBy("label"),
  2: () => colourBy("height"),
  3: () => colourBy("intensity"),
  4: () => colourBy("ring"),
  r: () => toggle("road"),
  g: () => toggle("ground"),
  o: () => toggle("obstacle"),
  x: () => found.kinds.has("box") && toggle("box"),
  w: () => found.kinds.has("way") && toggle("way"),
  b: () => see("orbit"),
  f: () => see("follow"),
  t: () => see("top"),
  0: () => see(camera.view),
  "[": () => (look.pointSize = Math.max(look.pointSize / 1.25, 0.4)),
  "]": () => (look.pointSize = Math.min(look.pointSize * 1.25, 5)),
  "+": () => camera.zoom(0.85),
  "-": () => camera.zoom(1.18),
  "?": () => at("help").click(),
  " ": playOrPause,
  ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
  ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
  Home: () => tell({ seek_s: 0 }),
};

function listen() {
  addEventListener("keydown", (event) => {
    const wanted = KEYS[event.key];
    if (!wanted || event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    event.preventDefault();
    wanted(event);
    isDirty = true;
  });
  addEventListener("resize", () => (isDirty = true));
  at("colours").onclick = ({ target }) => target.closest("button") && colourBy(target.closest("button").dataset.colour);
  at("kinds").onclick = ({ target }) => target.closest("button") && toggle(target.closest("button").dataset.kind);
  at("views").onclick = ({ target }) => target.closest("[data-view]") && see(target.closest("[data-view]").dataset.view);
  at("help").onclick = () => {
    at("keys").hidden = !at("keys").hidden;
    at("help").ariaExpanded = !at("keys").hidden;
  };
  at("play").onclick = playOrPause;
  at("back").onclick = () => step(-1);
  at("ahead").onclick = () => step(1);
  at("speed").onchange = () => tell({ rate: Number(at("speed").value) });
  at("position").oninput = () => (capture.isHeld = true);
  at("position").onchange = () => {
    capture.isHeld = false;
    tell({ seek_s: Number(at("position").value) });
  };

  const fingers = new Map();
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
  };
  canvas.onpointerup = canvas.onpointercancel = (event) => fingers.delete(event.pointerId);
  canvas.onpointermove = (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const apart = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]) || 1;
      camera.zoom(apart(before) / apart([event.clientX, event.clientY]));
      camera.move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons === 2) {
      camera.move(dx, dy);
    } else {
      camera.turn(dx, dy);
    }
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    showLook();
  };
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.ondblclick = () => see(camera.view);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(event.deltaY * 0.0012));
    isDirty = true;
  }, { passive: false });
}

try {
  scene = new Scene(canvas);
  listen();
  showLook();
  requestAnimationFrame(draw);
  follow();
  watch();
} catch (error) {
  say(error.message);
}
