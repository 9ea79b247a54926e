// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Draws points, boxes of objects, the free way, circles ten metres apart, the vehicle, and how far the sensor sees around it.

import { COLOURS, RANGES, colours, hasRamp, ramp } from "./colours.js";
import { Points } from "./points.js";
import { programs } from "./shaders.js";
import { areaTriangles, boxSegments, floorSegments, outlineSegments, sightSegments } from "./shapes.js";

const BITS = { road: 1, ground: 2, obstacle: 4 };
const [AHEAD, AHEAD_FLAT] = [0.001, 0.05]; // of depth: a metre at 30 m; seen from above 15 m
const STATES = ["clear", "reduced", "blocked"];
const MARKS = ["missed", "falseObstacle", "rightObstacle", "toObstacle", "toGround", "toOther", "sameGround", "sameObstacle"];

const unit = (colours) => new Float32Array(colours.flat().map((value) => value / 255));

export class Scene {
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, powerPreference: "high-performance" });
    if (!gl) throw new Error("this browser has no WebGL 2");
    this.canvas = canvas;
    this.gl = gl;
    this.programs = programs(gl);
    this.points = new Points(gl);
    const lines = (places = new Float32Array(0)) => this.lineLayout(places);
    this.floor = lines(floorSegments());
    this.boxes = lines();
    this.sight = STATES.map((state) => ({ state, lines: lines() }));
    this.wayOutline = lines();
    this.wayArea = lines();
    gl.enable(gl.DEPTH_TEST);
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
  setSight(sectors) {
    for (const { state, lines } of this.sight) this.setPlaces(lines, sightSegments(sectors, state));
  }
  setPlaces(lines, places) {
    const gl = this.gl;
    lines.vertices = places.length / 4;
    gl.bindBuffer(gl.ARRAY_BUFFER, lines.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, places, gl.STREAM_DRAW);
  }

  // `look`: {colourBy, hasOtherGround, shown: Set, pointSize, isLight}; `panes`: as panesOf()
  draw(camera, look, panes) {
    const { gl, canvas } = this;
    const palette = colours(look.isLight);
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.round(canvas.clientWidth * ratio), Math.round(canvas.clientHeight * ratio)];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.clearColor(...unit(palette.paper), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const pane of panes) {
      gl.viewport(pane.x * ratio, height - (pane.y + pane.height) * ratio, pane.width * ratio, pane.height * ratio);
      camera.drawOn(pane);
      const view = camera.matrix();
      this.drawShapes(view, look, palette);
      if (this.points.pieces.length === 0) continue;
      this.drawPoints(camera, view, { ...look, which: pane.which }, palette, 1.25 * ratio * look.pointSize);
    }
  }

  drawShapes(view, look, palette) {
    const gl = this.gl;
    const { made, uniform } = this.programs.lines;
    gl.useProgram(made);
    gl.uniformMatrix4fv(uniform("view"), false, view);
    gl.uniform3fv(uniform("paper"), unit(palette.paper));
    if (look.shown.has("way")) {
      gl.depthMask(false); // below everything, however the ground slopes
      this.drawLines(this.wayArea, palette.way, gl.TRIANGLES);
      this.drawLines(this.wayOutline, palette.way);
      gl.depthMask(true);
    }
    this.drawLines(this.floor, palette.floor);
    for (const { state, lines } of this.sight) this.drawLines(lines, palette.sight[state]);
    if (look.shown.has("box")) this.drawLines(this.boxes, palette.box);
  }
  drawLines(lines, tint, as = this.gl.LINES) {
    const gl = this.gl;
    gl.uniform3fv(this.programs.lines.uniform("tint"), unit(tint));
    gl.bindVertexArray(lines.layout);
    gl.drawArrays(as, 0, lines.vertices);
  }

  drawPoints(camera, view, look, palette, least) {
    const gl = this.gl;
    const { made, uniform } = this.programs.points;
    gl.useProgram(made);
    gl.uniformMatrix4fv(uniform("view"), false, view);
    gl.uniform3f(uniform("size"), camera.isFlat ? least : 40 * least, least, 3 * least);
    for (const kind of ["ground", "other", "obstacle"]) gl.uniform3fv(uniform(kind), unit(palette[kind]));
    for (const kind of ["none", ...MARKS]) gl.uniform3fv(uniform(kind), unit(palette[kind]));
    gl.uniform1ui(uniform("which"), look.which);
    gl.uniform1f(uniform("ahead"), camera.isFlat ? AHEAD_FLAT : AHEAD);
    gl.uniform1i(uniform("colourBy"), COLOURS.indexOf(look.colourBy));
    if (hasRamp(look.colourBy)) {
      gl.uniform3fv(uniform("steps"), unit(ramp(look.colourBy, palette)));
      gl.uniform2fv(uniform("range"), RANGES[look.colourBy]);
    }
    gl.uniform1i(uniform("hasOtherGround"), look.hasOtherGround ? 1 : 0);
    gl.uniform1i(uniform("hasHeights"), this.points.hasHeights ? 1 : 0);
    gl.uniform1ui(uniform("shown"), 8 | [...look.shown].reduce((bits, kind) => bits | (BITS[kind] ?? 0), 0));
    this.points.draw();
  }
}
