// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// One return that was clicked, whose values are shown, or two, and what lies between them.

import { TRUTHS, labelBy } from "./compared.js";

const at = (id) => document.getElementById(id);
const REACH_PX = { mouse: 9, finger: 22 };
const COVERED_PX = 2; // by a point, to each side
const LABELS = { 40: "ground", 49: "ground beside the road", 99: "obstacle" };
const fixed = (value) => value.toFixed(2).replace(/^-0.00$/, "0.00").replace("-", "−");
const metres = (value) => `${fixed(value)} m`;

export class Chosen {
  // `objectOf(chosen)`: the number of its object, 0: none; `changed()`: is to be drawn anew
  constructor(objectOf, changed) {
    Object.assign(this, { objectOf, changed, returns: [], isMeasuring: false, sensorHeight: 0 });
    at("measure").onclick = () => this.measure();
    at("forget").onclick = () => this.forget();
  }

  // Takes the return that is seen at a place, which is the one nearest to the eye, or else one near the place, or forgets all.
  // `seen(place, label, row, compared)`: {pixels from there, depth}
  take(points, isFinger, seen) {
    const reach = isFinger ? REACH_PX.finger : REACH_PX.mouse;
    const found = points.best((place, label, row, compared) => {
      const { pixels, depth } = seen(place, label, row, compared);
      return pixels < reach ? Math.max(pixels - COVERED_PX, 0) + Math.log(Math.max(depth, 0.1)) : Infinity;
    });
    if (!found) return this.forget();
    this.returns = this.isMeasuring && this.returns.length === 1 ? [this.returns[0], found] : [found];
    this.show();
  }

  measure() {
    if (this.returns.length === 0) return;
    this.isMeasuring = !this.isMeasuring;
    this.returns = this.returns.slice(-1);
    this.show();
  }

  forget() {
    this.returns = [];
    this.isMeasuring = false;
    this.show();
  }

  show() {
    const chosen = this.returns.at(-1);
    at("values").hidden = !chosen;
    at("measure").ariaPressed = this.isMeasuring;
    this.changed();
    if (!chosen) return;
    at("values-title").textContent = `return ${chosen.number}, frame ${chosen.frame}`;
    const rows = [...this.valuesOf(chosen), ...this.between()];
    at("values-rows").replaceChildren(...rows.flatMap(([name, value]) => [
      Object.assign(document.createElement("dt"), { textContent: name }),
      Object.assign(document.createElement("dd"), { textContent: value }),
    ]));
    at("measure").lastElementChild.textContent = this.isMeasuring ? "click another return" : "measure";
  }

  valuesOf(chosen) {
    const [x, y, z] = chosen.place;
    const rows = [
      ["label", LABELS[chosen.label] ?? "none"],
      ["x, y, z", `${[x, y, z].map(fixed).join(", ")} m`],
      ["range", metres(Math.hypot(x, y, z - this.sensorHeight))],
      ["ring", chosen.row],
      ["intensity", chosen.intensity],
    ];
    const beside = labelBy(1, chosen.label, chosen.compared);
    if (TRUTHS[chosen.compared & 3]) rows.splice(1, 0, ["truth", TRUTHS[chosen.compared & 3]]);
    if (beside) rows.splice(1, 0, ["beside", LABELS[beside]]);
    const object = this.objectOf(chosen);
    if (object > 0) rows.splice(1, 0, ["object", object]);
    if (Number.isFinite(chosen.aboveGround)) rows.splice(-2, 0, ["above ground", metres(chosen.aboveGround)]);
    return rows;
  }

  between() {
    if (this.returns.length < 2) return [];
    const [dx, dy, dz] = this.returns[1].place.map((value, axis) => value - this.returns[0].place[axis]);
    return [["distance", metres(Math.hypot(dx, dy, dz))], ["on the level", metres(Math.hypot(dx, dy))], ["up", metres(dz)]];
  }

  // Marks are above the picture, in each of its panes. `projections`: of each, where a place is on the page, null: nowhere
  draw(projections) {
    const marks = at("marks");
    while (marks.childElementCount < projections.length) marks.append(marks.firstElementChild.cloneNode(true));
    [...marks.children].forEach((group, i) => this.drawMarks(group, projections[i] ?? (() => null)));
  }
  drawMarks(group, project) {
    const places = this.returns.map(({ place }) => project(place));
    const [line, ...circles] = group.children;
    circles.forEach((circle, i) => {
      circle.style.display = places[i] ? "" : "none";
      if (places[i]) [circle.cx, circle.cy].forEach((length, axis) => (length.baseVal.value = places[i][axis]));
    });
    line.style.display = places[0] && places[1] ? "" : "none";
    if (!places[0] || !places[1]) return;
    [[line.x1, line.y1], [line.x2, line.y2]].forEach((end, i) => end.forEach((length, axis) => (length.baseVal.value = places[i][axis])));
  }
}
