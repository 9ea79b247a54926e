// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Colours of the picture and of its legend, 0..255, on dark and on light paper.

// Those of the method's pictures (pipeline/pictures/frame_colours.cpp): ground by the light that comes back, obstacles by
// height at OBSTACLE_STOPS_M, mistakes; and of differences those of tools/cli/compare/changed_pictures.cpp.
const DARK = {
  paper: [14, 19, 24],
  floor: [106, 131, 151],
  ground: [[84, 74, 58], [238, 222, 186]],
  other: [[52, 74, 52], [170, 206, 150]],
  obstacle: [[255, 96, 70], [255, 72, 140], [178, 92, 240], [74, 158, 255]],
  box: [255, 199, 92],
  way: [72, 210, 155],
  none: [92, 92, 100],
  missed: [255, 30, 30],
  falseObstacle: [255, 221, 0],
  rightObstacle: [92, 128, 170],
  toObstacle: [255, 86, 70],
  toGround: [70, 205, 255],
  toOther: [255, 221, 0],
  sameGround: [66, 60, 48],
  sameObstacle: [84, 92, 112],
  sight: { clear: [58, 104, 118], reduced: [230, 179, 90], blocked: [239, 111, 108] },
  bars: [[95, 147, 168], [217, 180, 94], [217, 138, 78], [239, 111, 108]],
  shade: 1,
};
const LIGHT = {
  paper: [243, 245, 247],
  floor: [126, 142, 156],
  ground: [[190, 178, 156], [112, 96, 66]],
  other: [[164, 186, 156], [76, 112, 70]],
  obstacle: [[232, 58, 30], [214, 26, 104], [130, 52, 200], [22, 98, 214]],
  box: [168, 104, 0],
  way: [0, 132, 86],
  none: [150, 150, 158],
  missed: [222, 0, 0],
  falseObstacle: [232, 150, 0],
  rightObstacle: [128, 156, 192],
  toObstacle: [224, 40, 20],
  toGround: [0, 126, 204],
  toOther: [232, 150, 0],
  sameGround: [206, 198, 182],
  sameObstacle: [172, 182, 200],
  sight: { clear: [120, 168, 182], reduced: [196, 136, 20], blocked: [208, 52, 48] },
  bars: [[88, 144, 166], [204, 156, 40], [214, 112, 40], [208, 52, 48]],
  shade: 0.8,
};
export const COLOURS = ["label", "height", "intensity", "ring", "mistakes", "differences"]; // what they may be by
export const hasRamp = (name) => name in RAMPS;
export const OBSTACLE_STOPS_M = [0, 1, 2.2, 4];

const SAME = { road: "sameGround", ground: "sameGround", obstacle: "sameObstacle" }; // beside differences

export const colours = (isLight) => (isLight ? LIGHT : DARK);

// The colours of a button's swatch, from left to right.
export function swatch(kind, palette, { colourBy, hasOtherGround }) {
  if (colourBy === "differences" && kind in SAME) return [palette[SAME[kind]]];
  if (colourBy === "mistakes" && kind === "obstacle") return [palette.rightObstacle];
  if (kind === "road") return palette.ground;
  if (kind === "ground") return hasOtherGround ? palette.other : palette.ground;
  return kind === "obstacle" ? palette.obstacle : [palette[kind]];
}

const RAMPS = {
  // Dark blue over green to yellow, even in brightness.
  height: [[62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [73, 193, 109], [160, 218, 57], [253, 231, 37]],
  intensity: [[58, 46, 92], [120, 52, 120], [180, 64, 112], [228, 92, 88], [250, 142, 80], [253, 196, 118], [252, 244, 190]],
  ring: [[88, 120, 214], [70, 176, 206], [88, 196, 130], [196, 200, 84], [232, 150, 78], [224, 98, 120], [160, 100, 204]],
};
export const RAMP_STEPS = 7;

export const RANGES = { height: [-0.5, 3], intensity: [0, 255], ring: [0, 63] };
const UNITS = { height: " m", intensity: "", ring: "" };

export function ramp(name, palette) {
  return RAMPS[name].map((colour) => colour.map((value) => Math.round(value * palette.shade)));
}

export function rangeText(name) {
  return RANGES[name].map((end) => `${end}${UNITS[name]}`);
}

export const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;
export const gradient = (stops) => `linear-gradient(90deg, ${[...stops, stops.at(-1)].map(css).join(", ")})`;
