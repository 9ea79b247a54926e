// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

import { Camera } from "./camera.js";
import { Chosen } from "./chosen.js";
import { COLOURS, RANGES, colours, css, gradient, hasRamp, ramp, rangeText, swatch } from "./colours.js";
import { Compared, labelBy, markOf } from "./compared.js";
import { showFigures } from "./figures.js";
import { Found } from "./found.js";
import { readFrames } from "./frames.js";
import { listenToKeys, listenToPointers } from "./hands.js";
import { readLink, writeLink } from "./link.js";
import { isIn, panesOf, showCaptions, showDistances } from "./panes.js";
import { RangeImage } from "./range_image.js";
import { Film, canFilm, savePicture } from "./recorder.js";
import { Scene } from "./scene.js";
import { Theme } from "./theme.js";
import { Transport } from "./transport.js";

const at = (id) => document.getElementById(id);
const canvas = at("scene");
const camera = new Camera();
const look = { colourBy: "label", hasOtherGround: false, shown: new Set(["road", "ground", "obstacle", "box", "way"]), pointSize: 1, isLight: false };
const POINT_SIZES = [0.4, 5];

let scene;
let newest = null; // of the stream: {header, points}
let isDirty = true;
let isFresh = false; // points came since the last picture
let head = null; // of the last frame that came by sectors
const turns = []; // how long the last ones took, milliseconds; some are cut short, or were waited for
const drawn = []; // when pictures with a new frame were drawn, milliseconds

const changed = () => (isDirty = true);

function say(trouble) {
  at("trouble").hidden = !trouble;
  at("trouble").textContent = trouble;
}

const transport = new Transport(say);
const compared = new Compared();
let panes = [];
const found = new Found(
  () => compared.isAny || [...found.kinds].some((kind) => look.shown.has(kind)),
  (things) => {
    scene.setFound(things);
    compared.take(things);
    chosen.show();
    changed();
  },
);
const chosen = new Chosen((of) => found.objectOf(of), changed);
const theme = new Theme(showLook);
const film = new Film(canvas, (text) => {
  at("film").ariaPressed = text !== "";
  at("film").lastElementChild.textContent = text || "film";
});

// --- the picture ---

const rangeImage = new RangeImage(at("range"));
const isKindShown = (label) => look.shown.has(label === 40 && look.hasOtherGround ? "road" : label === 99 ? "obstacle" : "ground") || ![40, 49, 99].includes(label);
const isShownBy = (which) => (label, bits) => isKindShown(labelBy(which, label, bits)) || markOf(look.colourBy, which, label, bits) !== undefined;

function projectionOf(pane) {
  camera.drawOn(pane);
  return camera.projection();
}

function drawNow() {
  if (newest) scene.points.setFrame(newest);
  newest = null;
  panes = panesOf(canvas, compared.shown(look.colourBy));
  scene.draw(camera, look, panes);
  if (!at("range").hidden) rangeImage.draw(scene.points, look, colours(look.isLight), isShownBy(0));
  showDistances(panes, projectionOf, camera);
  if (compared.isAny) showCaptions(panes, panes.map(({ which }) => compared.caption(which, look.colourBy)), colours(look.isLight));
  chosen.draw(panes.map((pane) => {
    const project = projectionOf(pane);
    return (place) => [project(place)].find((found) => found && isIn(pane, found));
  }));
}

function draw(now) {
  requestAnimationFrame(draw);
  if (!isDirty) return;
  isDirty = false;
  if (isFresh) drawn.push(now);
  isFresh = false;
  drawNow();
}

// Which kinds of ground there are: that is for the method's settings to say, and shows in the labels.
function noteLabels({ header, points, compared: bits }) {
  if (look.hasOtherGround) return;
  for (let i = 0; i < header.points; i += 7) {
    if (points[i * header.pointBytes + 13] !== 49 && labelBy(1, 0, bits[i]) !== 49) continue;
    look.hasOtherGround = true;
    showLook();
    return;
  }
}

const milliseconds = (ns) => Number(ns / 1000n) / 1000;

function take(message) {
  const { header } = message;
  isDirty = isFresh = true;
  noteLabels(message);
  if (header.isSector) {
    const turn = [...turns].sort((a, b) => a - b)[turns.length >> 1] ?? Infinity;
    scene.points.addSector(message, milliseconds(header.firstPacketNs), turn);
    return;
  }
  // A whole frame, or the head of one that came by sectors.
  const returns = header.points + header.firstReturn;
  at("frame").textContent = `frame ${header.number} · ${returns.toLocaleString("en")} returns`;
  at("frame").dataset.number = header.number;
  found.ask();
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
      for await (const message of readFrames("shown")) {
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
  look.isLight = theme.isLight;
  const palette = colours(look.isLight);
  for (const button of document.querySelectorAll("[data-colour]")) button.ariaPressed = button.dataset.colour === look.colourBy;
  showCompared(palette);
  for (const button of at("views").querySelectorAll("[data-view]")) button.ariaPressed = button.dataset.view === camera.view;
  for (const button of at("kinds").children) {
    const kind = button.dataset.kind;
    const isFound = kind === "box" || kind === "way";
    button.hidden = (kind === "road" && !look.hasOtherGround) || (isFound && !found.kinds.has(kind));
    button.ariaPressed = look.shown.has(kind);
    const isTold = !hasRamp(look.colourBy) || isFound;
    button.firstElementChild.style.background = isTold ? gradient(swatch(kind, palette, look)) : "var(--quiet)";
  }
  const bar = at("ramp");
  bar.hidden = !hasRamp(look.colourBy);
  if (!bar.hidden) {
    bar.firstElementChild.style.background = gradient(ramp(look.colourBy, palette));
    rangeText(look.colourBy).forEach((text, i) => (bar.children[i + 1].textContent = text));
  }
  at("points-size").value = Math.log(look.pointSize);
  at("range-image").ariaPressed = !at("range").hidden;
  at("light").ariaPressed = look.isLight;
  changed();
}

function showCompared(palette) {
  document.body.classList.toggle("compared", compared.isAny);
  at("compared").hidden = !compared.isAny;
  for (const button of at("compared").children) button.hidden = !compared.modes.has(button.dataset.colour ?? "split");
  at("split").ariaPressed = compared.shown(look.colourBy).length > 1;
}

function colourBy(name) {
  look.colourBy = name;
  showLook();
}
function toggle(kind) {
  if (!look.shown.delete(kind)) look.shown.add(kind);
  showLook();
  found.ask();
}
function split() {
  compared.isSplit = look.colourBy === "differences" || !compared.isSplit;
  colourBy(look.colourBy === "differences" ? "label" : look.colourBy);
}
function see(view) {
  camera.look(view);
  showLook();
}
function size(points) {
  look.pointSize = Math.min(Math.max(points, POINT_SIZES[0]), POINT_SIZES[1]);
  showLook();
}
function toggleRangeImage() {
  at("range").hidden = !at("range").hidden;
  document.body.classList.toggle("ranged", !at("range").hidden);
  showLook();
}
function switchTheme() {
  theme.set(!theme.isLight);
  showLook();
}
function fold() {
  at("fold").ariaExpanded = !document.body.classList.toggle("folded");
  changed();
}

const fileName = () => `terracut_frame_${at("frame").dataset.number ?? 0}`;
function takePicture() {
  drawNow();
  savePicture(canvas, document.querySelectorAll("#distances span, .pane b, .pane span"), fileName());
}
const filmOrEnd = () => canFilm && film.toggle(fileName());

// Chooses the return at a place on the page: of the range image, or of the picture in space.
function tapped(x, y, isFinger) {
  const box = at("range").getBoundingClientRect(); // empty where it is hidden
  const isInRangeImage = x >= box.left && x <= box.right && y >= box.top && y <= box.bottom && box.width > 0;
  const pane = panes.find((one) => isIn(one, [x, y])) ?? panes[0];
  const project = isInRangeImage ? (place, row) => rangeImage.place(place, row, box) : projectionOf(pane);
  const isShown = isShownBy(isInRangeImage ? 0 : pane.which);
  chosen.take(scene.points, isFinger, (place, label, row, bits) => {
    const seen = isShown(label, bits) ? project(place, row) : null;
    return seen ? { pixels: Math.hypot(seen[0] - x, seen[1] - y), depth: seen[2] } : { pixels: Infinity, depth: 1 };
  });
}

// --- figures, and what the address says ---

function tellLink() {
  const stands = transport.state && !transport.state.playing && !transport.wanted;
  writeLink(stands ? at("frame").dataset.number : undefined, camera, look.colourBy);
}
function goByLink() {
  const { frame, colour } = readLink(camera);
  if (frame !== undefined) transport.goToFrame(frame);
  colourBy(COLOURS.includes(colour) ? colour : look.colourBy);
}

function show(figures) {
  scene.setSight(figures.sight?.sectors ?? []);
  if (figures.sight) changed();
  const isMoreCompared = compared.note(figures);
  if (look.colourBy !== "label" && !hasRamp(look.colourBy) && !compared.modes.has(look.colourBy)) colourBy("label");
  if (found.noteKinds(figures) || isMoreCompared) {
    showLook();
    found.ask();
  }
  if (figures.rows > 1) RANGES.ring[1] = figures.rows - 1;
  chosen.sensorHeight = figures.sensor_height_m;
  transport.show(figures.capture);
  const since = performance.now() - 2000;
  while (drawn.length > 0 && drawn[0] < since) drawn.shift();
  showFigures(figures, drawn.length > 1 ? drawn.length / 2 : 0, colours(look.isLight).bars);
}

async function watch() {
  for (;;) {
    try {
      show(await (await fetch("figures", { cache: "no-store" })).json());
      await transport.comeToWanted();
      tellLink();
    } catch (error) {
      console.warn(error);
    }
    await new Promise((resolve) => setTimeout(resolve, 400));
  }
}

// --- hands ---

const KEYS = {
  1: () => colourBy("label"),
  2: () => colourBy("height"),
  3: () => colourBy("intensity"),
  4: () => colourBy("ring"),
  5: () => compared.modes.has("mistakes") && colourBy("mistakes"),
  6: () => compared.modes.has("differences") && colourBy("differences"),
  s: () => compared.modes.has("split") && split(),
  r: () => toggle("road"),
  g: () => toggle("ground"),
  o: () => toggle("obstacle"),
  x: () => found.kinds.has("box") && toggle("box"),
  w: () => found.kinds.has("way") && toggle("way"),
  b: () => see("orbit"),
  f: () => see("follow"),
  t: () => see("top"),
  0: () => see(camera.view),
  "[": () => size(look.pointSize / 1.25),
  "]": () => size(look.pointSize * 1.25),
  "+": () => camera.zoom(0.85),
  "-": () => camera.zoom(1.18),
  "?": () => at("help").click(),
  i: toggleRangeImage,
  m: () => chosen.measure(),
  Escape: () => chosen.forget(),
  p: takePicture,
  v: filmOrEnd,
  d: switchTheme,
  h: fold,
  l: () => transport.loop(),
  " ": () => transport.playOrPause(),
  ArrowRight: (event) => transport.step(event.shiftKey ? 10 : 1),
  ArrowLeft: (event) => transport.step(event.shiftKey ? -10 : -1),
  Home: () => transport.tell({ seek_s: 0 }),
};

function listen() {
  listenToKeys(KEYS, changed);
  listenToPointers(canvas, camera, { changed: showLook, tapped, reset: () => see(camera.view) });
  addEventListener("resize", changed);
  addEventListener("hashchange", goByLink);
  for (const button of document.querySelectorAll("[data-colour]")) button.onclick = () => colourBy(button.dataset.colour);
  at("split").onclick = split;
  at("kinds").onclick = ({ target }) => target.closest("button") && toggle(target.closest("button").dataset.kind);
  at("views").onclick = ({ target }) => target.closest("[data-view]") && see(target.closest("[data-view]").dataset.view);
  at("help").onclick = () => {
    at("keys").hidden = !at("keys").hidden;
    at("help").ariaExpanded = !at("keys").hidden;
  };
  at("points-size").oninput = () => size(Math.exp(at("points-size").value));
  at("range-image").onclick = toggleRangeImage;
  at("picture").onclick = takePicture;
  at("film").onclick = filmOrEnd;
  at("film").hidden = !canFilm;
  at("light").onclick = switchTheme;
  at("fold").onclick = fold;
}

try {
  scene = new Scene(canvas);
  listen();
  goByLink();
  requestAnimationFrame(draw);
  follow();
  watch();
} catch (error) {
  say(error.message);
}
