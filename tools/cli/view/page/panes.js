// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The parts of the picture, one for each set of parameters whose labels are shown: beside each other, or above each other
// where the page is narrow. What stands above the picture: names, figures, and how far the circles are.

import { css } from "./colours.js";

const MARKED_M = [20, 40, 60, 80, 100];
const GAP_PX = 8; // beside the panels
const at = (id) => document.getElementById(id);
const isNarrow = matchMedia("(max-width: 760px)");
const element = (name, properties = {}) => Object.assign(document.createElement(name), properties);

// Where they are, in pixels of the page: [{which, x, y, width, height}].
export function panesOf(canvas, shown) {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (shown.length === 1) return [{ which: shown[0], x: 0, y: 0, width, height }];
  const panels = document.body.classList.contains("folded") ? null : at("look").getBoundingClientRect();
  if (isNarrow.matches) {
    const top = at("about").getBoundingClientRect().bottom;
    const each = (height - top) / shown.length;
    return shown.map((which, i) => ({ which, x: 0, y: top + i * each, width, height: each }));
  }
  const left = panels ? panels.right + GAP_PX : 0;
  const each = (width - left) / shown.length;
  return shown.map((which, i) => ({ which, x: left + i * each, y: 0, width: each, height }));
}

export const isIn = (pane, [x, y]) => x >= pane.x && x < pane.x + pane.width && y >= pane.y && y < pane.y + pane.height;

function legend(colours, palette) {
  const entries = element("div");
  for (const [what, colour] of colours) {
    const entry = element("em");
    entry.append(element("i"), element("span", { textContent: what }));
    entry.firstElementChild.style.background = css(palette[colour]);
    entries.append(entry);
  }
  return entries;
}

// What stands above each pane: of `captions` {name, text, colours: [[text, colour's name]]}.
export function showCaptions(panes, captions, palette) {
  const about = at("about").getBoundingClientRect();
  at("panes").replaceChildren(...panes.map((pane, i) => {
    const { name, text, colours } = captions[i];
    const box = element("div", { className: "pane" });
    for (const side of ["width", "height"]) box.style[side] = `${pane[side]}px`;
    [box.style.left, box.style.top] = [`${pane.x}px`, `${pane.y}px`];
    if (isNarrow.matches) box.style.paddingTop = `${Math.max(about.bottom - pane.y, 0) + 4}px`;
    else box.style.paddingLeft = `${Math.max(about.right - pane.x, 0) + GAP_PX}px`;
    if (name) box.append(element("b", { textContent: name }));
    const figures = element("div");
    if (text) figures.append(element("span", { textContent: text }));
    if (colours.length > 0) figures.append(legend(colours, palette));
    if (figures.childElementCount > 0) box.append(figures);
    return box;
  }));
}

// `project(pane)`: where a place in space is on the page.
export function showDistances(panes, project, camera) {
  const spots = at("distances");
  const texts = panes.flatMap(() => MARKED_M.map((metres) => `${metres} m`));
  if (spots.childElementCount !== texts.length) spots.replaceChildren(...texts.map((textContent) => element("span", { textContent })));
  panes.forEach((pane, number) => {
    const placeOf = project(pane);
    MARKED_M.forEach((metres, i) => {
      const place = placeOf([metres * Math.cos(0.6), -metres * Math.sin(0.6), 0]);
      const span = spots.children[number * MARKED_M.length + i];
      span.style.visibility = place && isIn(pane, place) ? "visible" : "hidden";
      if (place) span.style.transform = `translate(${place[0] + 4}px, ${place[1] - 8}px)`;
    });
  });
  const metres = [100, 50, 20, 10, 5, 2, 1].find((length) => length * camera.pixelsPerMetre <= 160) ?? 1;
  at("scale").firstElementChild.style.width = `${metres * camera.pixelsPerMetre}px`;
  at("scale").lastElementChild.textContent = `${metres} m`;
}
