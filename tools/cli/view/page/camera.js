// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Where the picture is seen from: vehicle frame, x ahead, y left, z up, metres. Matrices are column-major.

const FIELD_OF_VIEW = (50 * Math.PI) / 180;
const NEAR = 0.5;
const FAR = 600;

const STARTS = {
  orbit: { yaw: Math.PI * 1.09, pitch: 0.42, distance: 46, target: [9, 0, 0] },
  follow: { yaw: Math.PI, pitch: 0.24, distance: 24, target: [9, 0, 1.2] },
  top: { yaw: Math.PI, pitch: Math.PI / 2, distance: 90, target: [8, 0, 0] },
};

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

export class Camera {
  constructor() {
    this.look("orbit");
  }

  look(view) {
    this.view = view;
    Object.assign(this, structuredClone(STARTS[view]));
  }

  get isMoved() {
    const start = STARTS[this.view];
    return Object.keys(start).some((name) => String(this[name]) !== String(start[name]));
  }

  // The part of the page it draws on. A narrow picture shows as much to the sides as a square one.
  drawOn({ x, y, width, height }) {
    [this.left, this.top] = [x, y];
    this.width = Math.max(width, 1);
    this.height = Math.max(height, 1);
    this.spread = Math.max(1, this.height / this.width);
  }

  get isFlat() {
    return this.view === "top";
  }

  // Metres from the lower to the upper edge at the target.
  get heightMetres() {
    return 2 * this.distance * Math.tan(FIELD_OF_VIEW / 2) * this.spread;
  }

  get pixelsPerMetre() {
    return this.height / this.heightMetres;
  }

  axes() {
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const back = [cp * cy, cp * sy, sp]; // from the target to the eye
    const right = [-sy, cy, 0];
    return { back, right, up: cross(back, right) };
  }

  matrix() {
    const { back, right, up } = this.axes();
    const eye = this.target.map((value, i) => value + back[i] * this.distance);
    const aspect = this.width / this.height;
    const rows = [right, up, back].map((axis) => [...axis, -dot(axis, eye)]);
    const [x, y, z] = rows;
    const scale = (row, factor) => row.map((value) => value * factor);
    let w, depth;
    const half = Math.tan(FIELD_OF_VIEW / 2) * this.spread;
    if (this.isFlat) {
      const across = this.distance * half;
      depth = z.map((value, i) => (-2 / FAR) * value - (i === 3 ? 1 : 0));
      w = [0, 0, 0, 1];
      return columns(scale(x, 1 / (across * aspect)), scale(y, 1 / across), depth, w);
    }
    const a = (FAR + NEAR) / (NEAR - FAR);
    const b = (2 * FAR * NEAR) / (NEAR - FAR);
    depth = z.map((value, i) => a * value + (i === 3 ? b : 0));
    w = z.map((value) => -value);
    return columns(scale(x, 1 / (half * aspect)), scale(y, 1 / half), depth, w);
  }

  // A function of a place in space: where it is on the page, in pixels, and how far from the eye, in metres; null: behind it.
  projection() {
    const m = this.matrix();
    const { left, top, width, height, isFlat } = this;
    return (place) => {
      const at = (row) => m[row] * place[0] + m[4 + row] * place[1] + m[8 + row] * place[2] + m[12 + row];
      const w = at(3);
      const depth = isFlat ? ((at(2) + 1) / 2) * FAR : w;
      return w <= 0 ? null : [left + ((at(0) / w + 1) / 2) * width, top + ((1 - at(1) / w) / 2) * height, depth];
    };
  }

  turn(dx, dy) {
    if (this.isFlat) return this.move(dx, dy);
    this.view = "orbit";
    this.yaw -= (dx / this.height) * Math.PI;
    this.pitch = Math.min(Math.max(this.pitch + (dy / this.height) * Math.PI, -0.2), Math.PI / 2 - 0.001);
  }

  move(dx, dy) {
    if (!this.isFlat) this.view = "orbit";
    const { right, up } = this.axes();
    const ahead = this.isFlat ? up : [-Math.cos(this.yaw), -Math.sin(this.yaw), 0];
    for (let i = 0; i < 3; ++i) this.target[i] += (dy * ahead[i] - dx * right[i]) / this.pixelsPerMetre;
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, 3), 300);
  }
}

function columns(x, y, z, w) {
  const matrix = new Float32Array(16);
  for (let i = 0; i < 4; ++i) matrix.set([x[i], y[i], z[i], w[i]], 4 * i);
  return matrix;
}
