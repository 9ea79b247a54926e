// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Colours of the picture and of its legend, 0..255.

// By kind: what may be driven on, other ground, obstacles, no label. Told apart by brightness, too.
export const KINDS = { road: [84, 132, 170], ground: [112, 134, 104], obstacle: [255, 176, 92], box: [120, 214, 240], way: [72, 200, 150], none: [92, 92, 100] };

// By the state of a direction in which the sensor looks.
export const STATES = { clear: [58, 104, 118], reduced: [230, 179, 90], blocked: [239, 111, 108] };

const RAMPS = {
  // Dark blue over green to yellow, even in brightness.
  height: [[62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [73, 193, 109], [160, 218, 57], [253, 231, 37]],
  intensity: [[58, 46, 92], [120, 52, 120], [180, 64, 112], [228, 92, 88], [250, 142, 80], [253, 196, 118], [252, 244, 190]],
  ring: [[88, 120, 214], [70, 176, 206], [88, 196, 130], [196, 200, 84], [232, 150, 78], [224, 98, 120], [160, 100, 204]],
};
export const RAMP_STEPS = 7;

export const RANGES = { height: [-0.5, 3], intensity: [0, 255], ring: [0, 63] };
const UNITS = { height: " m", intensity: "", ring: "" };

export function ramp(name) {
  return RAMPS[name];
}

export function rangeText(name, ends = RANGES[name]) {
  return ends.map((end) => `${end}${UNITS[name]}`);
}

export const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;
