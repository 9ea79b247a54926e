// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// What was found in the frame that is shown: boxes of objects, the free way.

const FIGURES = { box: "objects", way: "free_way" }; // by kind, the figure that tells whether this run finds any
const ROUNDING_M = 0.02; // of the boxes' corners, and of places

export class Found {
  // `isWanted()`: whether it is to be shown; `show(found)` draws it.
  constructor(isWanted, show) {
    Object.assign(this, { isWanted, show, kinds: new Set(), isAsked: false, of: undefined, boxes: [] });
  }

  // True if the run finds other kinds than were known.
  noteKinds(figures) {
    const kinds = Object.keys(FIGURES).filter((kind) => figures[FIGURES[kind]]);
    if (kinds.length === this.kinds.size) return false;
    this.kinds = new Set(kinds);
    return true;
  }

  // Frames come while an answer is awaited: asks until it is that for the frame that is shown.
  async ask() {
    if (this.isAsked) return;
    this.isAsked = true;
    try {
      for (let frame; this.isWanted() && (frame = document.getElementById("frame").dataset.number) !== this.of; this.of = frame) {
        const found = await (await fetch(`found/${frame}`, { cache: "no-store" })).json();
        this.boxes = found.boxes;
        this.show(found);
      }
    } catch (error) {
      console.warn(error);
      this.of = undefined;
    }
    this.isAsked = false;
  }

  // The number of the object that a return of a frame belongs to, from 1; 0: none is known.
  objectOf({ frame, place }) {
    if (String(frame) !== this.of) return 0;
    return 1 + this.boxes.findIndex((box) => isWithin(place, box));
  }
}

// Corners go around the box in either direction.
function isWithin([x, y, z], { corners, bottom_m: bottom, top_m: top }) {
  const sides = corners.map(([ax, ay], i) => {
    const [bx, by] = corners[(i + 1) % corners.length];
    return ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / (Math.hypot(bx - ax, by - ay) || 1);
  });
  const isInside = sides.every((side) => side > -ROUNDING_M) || sides.every((side) => side < ROUNDING_M);
  return isInside && z > bottom - ROUNDING_M && z < top + ROUNDING_M;
}
