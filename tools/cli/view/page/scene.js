// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Draws points as they lie in the stream, boxes of objects, the free way, circles ten metres apart, the vehicle, and how
// far the sensor sees around it.

import { KINDS, RAMP_STEPS, RANGES, STATES, ramp } from "./colours.js";

const POINTS = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in float intensity;
layout(location = 2) in uint label;
layout(location = 3) in uint row;
uniform mat4 view;
uniform vec3 kinds[4];
uniform vec3 steps[${RAMP_STEPS}];
uniform vec2 range;
uniform int colourBy;        // 0 label, 1 height, 2 intensity, 3 ring
uniform bool hasOtherGround; // 40 is road then
uniform uint shown;          // bits by kind
uniform vec3 size;           // pixels at a metre's distance, the least, the most
out vec3 colour;
void main() {
  uint kind = label == 40u ? (hasOtherGround ? 0u : 1u) : label == 49u ? 1u : label == 99u ? 2u : 3u;
  gl_Position = (shown >> kind & 1u) == 1u ? view * vec4(place, 1) : vec4(2, 2, 2, 1);
  gl_PointSize = clamp(size.x / gl_Position.w, size.y, size.z);
  if (colourBy == 0) {
    colour = kinds[kind];
    return;
  }
  float value = colourBy == 1 ? place.z : colourBy == 2 ? intensity : float(row);
  float at = clamp((value - range.x) / (range.y - range.x), 0.0, 1.0) * ${RAMP_STEPS - 1}.0;
  int below = min(int(at), ${RAMP_STEPS - 2});
  colour = mix(steps[below], steps[below + 1], at - float(below));
}`;

const LINES = `#version 300 es
layout(location = 0) in vec4 place; // w: how bright
uniform mat4 view;
uniform vec3 tint;
out vec3 colour;
void main() {
  gl_Position = view * vec4(place.xyz, 1);
  colour = mix(vec3(0.055, 0.075, 0.094), tint, place.w);
}`;

const PAINT = `#version 300 es
precision mediump float;
in vec3 colour;
out vec4 painted;
void main() { painted = vec4(colour, 1); }`;

const ROOM = 1 << 20; // for points of sectors: more than two turns of any sensor

const CIRCLES_M = [10, 20, 30, 40, 50, 60, 70, 80, 90, 100];
const VEHICLE = { front: 2.6, rear: -2.2, half: 0.95 };
const COLOURS = ["label", "height", "intensity", "ring"];
const BITS = { road: 1, ground: 2, obstacle: 4 };

function lineSegments() {
  const places = [];
  const line = (a, b, bright) => places.push(...a, bright, ...b, bright);
  for (const radius of CIRCLES_M) {
    const parts = 24 + radius;
    for (let i = 0; i < parts; ++i) {
      const [a, b] = [i, i + 1].map((k) => (2 * Math.PI * k) / parts).map((t) => [radius * Math.cos(t), radius * Math.sin(t), 0]);
      line(a, b, radius % 50 === 0 ? 0.5 : 0.26);
    }
  }
  line([-100, 0, 0], [100, 0, 0], 0.26);
  line([0, -100, 0], [0, 100, 0], 0.26);
  const { front, rear, half } = VEHICLE;
  const outline = [[front, 0], [front - 1, half], [rear, half], [rear, -half], [front - 1, -half], [front, 0]];
  for (let i = 1; i < outline.length; ++i) line([...outline[i - 1], 0.05], [...outline[i], 0.05], 1.6);
  return new Float32Array(places);
}

// The twelve edges of each box: {corners, bottom_m, top_m}.
function boxSegments(boxes) {
  const places = [];
  for (const { corners, bottom_m: bottom, top_m: top } of boxes) {
    corners.forEach((corner, i) => {
      const next = corners[(i + 1) % corners.length];
      for (const [from, to] of [[[...corner, bottom], [...next, bottom]], [[...corner, top], [...next, top]], [[...corner, bottom], [...corner, top]]]) {
        places.push(...from, 1, ...to, 1);
      }
    });
  }
  return new Float32Array(places);
}

// An arc of each sector in one of the states, at the range up to which it sees; of a blocked one the sector's edge, too.
// Sectors are [state, visible_m], clockwise from straight ahead.
const LEAST_RING_M = 3;
function sightSegments(sectors, state) {
  const places = [];
  sectors.forEach(([of, visible], i) => {
    if (of !== state) return;
    const place = (turns, radius) => [radius * Math.cos(2 * Math.PI * turns), -radius * Math.sin(2 * Math.PI * turns), 0.05, 1];
    const radius = Math.max(visible, LEAST_RING_M);
    const parts = 5;
    for (let part = 0; part < parts; ++part) {
      const [from, to] = [part, part + 1].map((at) => (i + at / parts) / sectors.length);
      places.push(...place(from, radius), ...place(to, radius));
      if (state === "blocked") places.push(...place(from, radius), ...place(from, 10));
    }
  });
  return new Float32Array(places);
}

// The line around the free area, of these corners.
function outlineSegments(corners) {
  return new Float32Array(corners.flatMap((corner, i) => [...corner, 0, 1, ...corners[(i + 1) % corners.length], 0, 1]));
}
// The area itself, as triangles around the vehicle.
function areaTriangles(corners) {
  return new Float32Array(corners.flatMap((corner, i) => [0, 0, 0, 0.3, ...corner, 0, 0.3, ...corners[(i + 1) % corners.length], 0, 0.3]));
}

function program(gl, vertex) {
  const made = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, PAINT]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const at = new Map();
  return { made, uniform: (name) => at.get(name) ?? at.set(name, gl.getUniformLocation(made, name)).get(name) };
}

const unit = (colours) => new Float32Array(colours.flat().map((value) => value / 255));

export class Scene {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.canvas = canvas;
    this.gl = gl;
    this.points = program(gl, POINTS);
    this.lines = program(gl, LINES);
    this.pointBuffer = gl.createBuffer();
    this.pointLayout = gl.createVertexArray();
    this.pieces = []; // of the buffer: {first, count}, and of sectors when they began
    this.next = null; // where the next sector goes; null: the buffer holds a whole frame
    const places = lineSegments();
    this.floor = this.lineLayout(places);
    this.boxes = this.lineLayout(new Float32Array(0));
    this.sight = Object.keys(STATES).map((state) => ({ state, lines: this.lineLayout(new Float32Array(0)) }));
    this.wayOutline = this.lineLayout(new Float32Array(0));
    this.wayArea = this.lineLayout(new Float32Array(0));
    gl.enable(gl.DEPTH_TEST);
    gl.clearColor(0.055, 0.075, 0.094, 1);
  }

  lineLayout(places) {
    const gl = this.gl;
    const lines = { layout: gl.createVertexArray(), buffer: gl.createBuffer(), vertices: places.length / 4 };
    gl.bindVertexArray(lines.layout);
    gl.bindBuffer(gl.ARRAY_BUFFER, lines.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 4, gl.FLOAT, false, 0, 0);
    return lines;
  }

  // `found`: {boxes, free_way: corners of the free area}
  setFound(found) {
    this.setPlaces(this.boxes, boxSegments(found.boxes));
    this.setPlaces(this.wayOutline, outlineSegments(found.free_way));
    this.setPlaces(this.wayArea, areaTriangles(found.free_way));
  }

  setPlaces(lines, places) {
    const gl = this.gl;
    lines.vertices = places.length / 4;
    gl.bindBuffer(gl.ARRAY_BUFFER, lines.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.STREAM_DRAW);
  }
  setSight(sectors) {
    for (const { state, lines } of this.sight) this.setPlaces(lines, sightSegments(sectors, state));
  }

  // Draws the free area below everything, however the ground slopes.
  drawWay(tint) {
    const gl = this.gl;
    gl.depthMask(false);
    this.drawLines(this.wayArea, tint, gl.TRIANGLES);
    this.drawLines(this.wayOutline, tint);
    gl.depthMask(true);
  }

  drawLines(lines, tint, as = this.gl.LINES) {
    const gl = this.gl;
    gl.uniform3fv(this.lines.uniform("tint"), tint);
    gl.bindVertexArray(lines.layout);
    gl.drawArrays(as, 0, lines.vertices);
  }

  setPoints(bytes, count, pointBytes) {
    this.pieces = [{ first: 0, count }];
    this.next = null;
    this.fill(bytes, pointBytes);
  }

  // Adds a part of a turn. `began` and `turn` are times of one unit: what began a turn or more before is forgotten.
  addSector(bytes, count, pointBytes, began, turn) {
    const gl = this.gl;
    if (this.next === null) {
      this.fill(ROOM * pointBytes, pointBytes);
      this.pieces = [];
      this.next = 0;
    }
    const first = this.next + count > ROOM ? 0 : this.next;
    this.next = first + count;
    const stays = (piece) => Math.abs(began - piece.began) < turn && (piece.first >= this.next || piece.first + piece.count <= first);
    this.pieces = this.pieces.filter(stays);
    this.pieces.push({ first, count, began });
    gl.bindBuffer(gl.ARRAY_BUFFER, this.pointBuffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, first * pointBytes, bytes);
  }

  // Makes the buffer anew, of bytes or of so many.
  fill(bytes, pointBytes) {
    const gl = this.gl;
    gl.bindVertexArray(this.pointLayout);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.pointBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STREAM_DRAW);
    for (let i = 0; i < 4; ++i) gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, pointBytes, 0);
    gl.vertexAttribPointer(1, 1, gl.UNSIGNED_BYTE, false, pointBytes, 12);
    gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_BYTE, pointBytes, 13);
    gl.vertexAttribIPointer(3, 1, gl.UNSIGNED_SHORT, pointBytes, 14);
  }

  // `look`: {colourBy, hasOtherGround, shown: Set, pointSize}
  draw(camera, look) {
    const { gl, canvas } = this;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    camera.resize(canvas.clientWidth, canvas.clientHeight);
    const view = camera.matrix();

    gl.useProgram(this.lines.made);
    gl.uniformMatrix4fv(this.lines.uniform("view"), false, view);
    if (look.shown.has("way")) this.drawWay(unit(KINDS.way));
    this.drawLines(this.floor, [0.415, 0.515, 0.594]);
    for (const { state, lines } of this.sight) this.drawLines(lines, unit(STATES[state]));
    if (look.shown.has("box")) this.drawLines(this.boxes, unit(KINDS.box));
    if (this.pieces.length === 0) return;

    const { made, uniform } = this.points;
    gl.useProgram(made);
    gl.uniformMatrix4fv(uniform("view"), false, view);
    gl.uniform3fv(uniform("kinds"), unit([KINDS.road, KINDS.ground, KINDS.obstacle, KINDS.none]));
    gl.uniform1i(uniform("colourBy"), COLOURS.indexOf(look.colourBy));
    if (look.colourBy !== "label") {
      gl.uniform3fv(uniform("steps"), unit(ramp(look.colourBy)));
      gl.uniform2fv(uniform("range"), RANGES[look.colourBy]);
    }
    gl.uniform1i(uniform("hasOtherGround"), look.hasOtherGround ? 1 : 0);
    gl.uniform1ui(uniform("shown"), 8 | [...look.shown].reduce((bits, kind) => bits | (BITS[kind] ?? 0), 0));
    const least = 1.25 * ratio * look.pointSize;
    gl.uniform3f(uniform("size"), camera.isFlat ? least : 50 * ratio * look.pointSize, least, 3 * least);
    gl.bindVertexArray(this.pointLayout);
    for (let i = 0; i < this.pieces.length; ) {
      let { first, count } = this.pieces[i];
      while (this.pieces[++i]?.first === first + count) count += this.pieces[i].count;
      gl.drawArrays(gl.POINTS, first, count);
    }
  }
}
