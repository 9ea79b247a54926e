// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Programs of the graphics unit: points and lines.

import { OBSTACLE_STOPS_M, RAMP_STEPS } from "./colours.js";

const MARKED_SIZE = 1.8; // of points that stand out, relative to others

const POINTS = `#version 300 es
layout(location = 0) in vec3 place;
layout(location = 1) in float intensity;
layout(location = 2) in uint label;
layout(location = 3) in uint row;
layout(location = 4) in float aboveGround;
layout(location = 5) in uint compared; // see compared.js
uniform uint which;          // parameters' labels: 0 the run's own, 1 those beside them
uniform vec3 ground[2], other[2], none; // in the light that comes back least and most
uniform vec3 obstacle[${OBSTACLE_STOPS_M.length}];
uniform vec3 steps[${RAMP_STEPS}];
uniform vec2 range;
uniform int colourBy;        // by place in COLOURS
uniform vec3 missed, falseObstacle, rightObstacle, toObstacle, toGround, toOther, sameGround, sameObstacle;
uniform bool hasOtherGround; // 40 is road then
uniform bool hasHeights;
uniform uint shown;          // bits by kind
uniform mat4 view;
uniform float ahead;         // depth by which points that stand out cover others
uniform vec3 size;           // pixels at a metre's distance, the least, the most
out vec3 colour;
vec3 byHeight(float height) {
  const float stops[${OBSTACLE_STOPS_M.length}] = float[](${OBSTACLE_STOPS_M.map((stop) => stop.toFixed(2)).join(", ")});
  vec3 found = obstacle[0];
  for (int i = 1; i < ${OBSTACLE_STOPS_M.length}; ++i) {
    found = mix(found, obstacle[i], clamp((height - stops[i - 1]) / (stops[i] - stops[i - 1]), 0.0, 1.0));
  }
  return found;
}
bool isGround(uint of) {
  return of == 40u || of == 49u;
}
// True if a return stands out, in its colour: what compared.js' markOf() says.
bool isMarked(uint own, uint beside, uint seen) {
  uint truth = compared & 3u;
  if (colourBy == 4) {
    colour = isGround(seen) ? missed : falseObstacle;
    return isGround(seen) ? truth >= 2u : seen == 99u && truth == 1u;
  }
  colour = beside == 99u ? toObstacle : own == 99u ? toGround : toOther;
  return colourBy == 5 && beside != 0u && beside != own;
}
void main() {
  uint beside = uint[](0u, 40u, 99u, 49u)[compared >> 2 & 3u];
  uint seen = which == 0u ? label : beside;
  uint kind = seen == 40u ? (hasOtherGround ? 0u : 1u) : seen == 49u ? 1u : seen == 99u ? 2u : 3u;
  bool marked = isMarked(label, beside, seen);
  if (!marked && (shown >> kind & 1u) == 0u) {
    gl_Position = vec4(2, 2, 2, 1);
    return;
  }
  gl_Position = view * vec4(place, 1);
  gl_PointSize = clamp(size.x / gl_Position.w, size.y, size.z);
  if (marked) {
    gl_PointSize *= ${MARKED_SIZE};
    gl_Position.z -= ahead * gl_Position.w;
    return;
  }
  if (colourBy == 5) {
    colour = kind == 3u ? none : kind == 2u ? sameObstacle : sameGround;
    return;
  }
  if (colourBy == 0 || colourBy == 4) {
    float light = sqrt(intensity / 255.0);
    colour = kind == 3u ? none : kind == 2u ? (colourBy == 4 ? rightObstacle : byHeight(hasHeights ? aboveGround : place.z)) :
             seen == 49u ? mix(other[0], other[1], light) : mix(ground[0], ground[1], light);
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
uniform vec3 tint, paper;
out vec3 colour;
void main() {
  gl_Position = view * vec4(place.xyz, 1);
  colour = mix(paper, tint, place.w);
}`;

const PAINT = `#version 300 es
precision mediump float;
in vec3 colour;
out vec4 painted;
void main() { painted = vec4(colour, 1); }`;

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

// {points, lines}: each {made, uniform(name)}
export function programs(gl) {
  return { points: program(gl, POINTS), lines: program(gl, LINES) };
}
