// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The range image: a row for each laser, ahead in the middle, the left on the left; the nearest return of a cell is seen.
// It is painted here, not by the graphics unit, which in software takes ten times as long for points.

import { OBSTACLE_STOPS_M, RANGES, hasRamp, ramp } from "./colours.js";
import { markOf } from "./compared.js";

const MOST_COLUMNS = 1024;
const SHADES = 256;
const opaque = ([r, g, b]) => 0xff000000 | (b << 16) | (g << 8) | r;

// SHADES colours between stops, which lie at places from 0 to 1.
function shades(stops, places = stops.map((_, i) => i / Math.max(stops.length - 1, 1))) {
  return Uint32Array.from({ length: SHADES }, (_, shade) => {
    const at = shade / (SHADES - 1);
    const above = Math.max(places.findIndex((place) => place >= at), 1);
    if (stops.length === 1) return opaque(stops[0]);
    const part = (at - places[above - 1]) / (places[above] - places[above - 1]);
    return opaque(stops[above].map((value, i) => Math.round(stops[above - 1][i] + part * (value - stops[above - 1][i]))));
  });
}
const shadeOf = (value, [from, to]) => Math.min(Math.max((value - from) / (to - from), 0), 1) * (SHADES - 1) + 0.5;

// Returns a function that returns a return's colour.
function painter(look, palette) {
  if (hasRamp(look.colourBy)) {
    const [table, range] = [shades(ramp(look.colourBy, palette)), RANGES[look.colourBy]];
    const value = { height: (intensity, row, z) => z, intensity: (intensity) => intensity, ring: (intensity, row) => row }[look.colourBy];
    return (label, intensity, row, z) => table[shadeOf(value(intensity, row, z), range) | 0];
  }
  const top = OBSTACLE_STOPS_M.at(-1);
  const [ground, other, obstacle] = [shades(palette.ground), shades(palette.other), shades(palette.obstacle, OBSTACLE_STOPS_M.map((stop) => stop / top))];
  const none = opaque(palette.none);
  const [isOfDifferences, isOfMistakes] = ["differences", "mistakes"].map((name) => look.colourBy === name);
  const [sameGround, sameObstacle, rightObstacle] = ["sameGround", "sameObstacle", "rightObstacle"].map((name) => opaque(palette[name]));
  return (label, intensity, row, z, aboveGround, compared) => {
    const mark = markOf(look.colourBy, 0, label, compared);
    if (mark) return opaque(palette[mark]);
    if (label !== 40 && label !== 49 && label !== 99) return none;
    if (isOfDifferences) return label === 99 ? sameObstacle : sameGround;
    if (label === 99) return isOfMistakes ? rightObstacle : obstacle[shadeOf(aboveGround, [0, top]) | 0];
    return (label === 40 ? ground : other)[(Math.sqrt(intensity / 255) * (SHADES - 1) + 0.5) | 0];
  };
}

export class RangeImage {
  constructor(canvas) {
    this.canvas = canvas;
    this.paint = canvas.getContext("2d");
  }

  get rows() {
    return RANGES.ring[1] + 1;
  }

  // `isShown(label, compared)`; of two sets of parameters it shows the labels of the first
  draw(points, look, palette, isShown) {
    const { canvas, rows } = this;
    const columns = Math.max(Math.min(MOST_COLUMNS, Math.floor(points.count / rows)), 1);
    if (canvas.width !== columns || canvas.height !== rows) {
      [canvas.width, canvas.height] = [columns, rows];
      this.image = this.paint.createImageData(columns, rows);
      this.pixels = new Uint32Array(this.image.data.buffer);
      this.nearest = new Float32Array(columns * rows);
    }
    this.pixels.fill(0);
    this.nearest.fill(Infinity);
    const colour = painter(look, palette);
    points.each((x, y, z, intensity, label, row, aboveGround, compared) => {
      if (!isShown(label, compared) || row >= rows) return;
      const column = ((0.5 - Math.atan2(y, x) / (2 * Math.PI)) * columns) | 0;
      const cell = (rows - 1 - row) * columns + Math.min(column, columns - 1);
      const square = x * x + y * y;
      if (square >= this.nearest[cell]) return;
      this.nearest[cell] = square;
      this.pixels[cell] = colour(label, intensity, row, z, aboveGround ?? z, compared);
    });
    this.paint.putImageData(this.image, 0, 0);
  }

  // Where a return is on the page, and how far away; `box`: where the image is.
  place([x, y, z], row, box) {
    const turn = 0.5 - Math.atan2(y, x) / (2 * Math.PI);
    return [box.left + turn * box.width, box.bottom - ((row + 0.5) / this.rows) * box.height, Math.hypot(x, y, z)];
  }
}
