// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The last 300 frames: a bar each, as high as it took, coloured by how much of the method it got.

import { css } from "./colours.js";
import { LEVELS } from "./frames.js";

const BARS = 300;

function percentile(sorted, share) {
  return sorted.length === 0 ? 0 : sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

// `frames`: [ms, level, missed]; `deadlineMs`: null where there is none; `bars`: colours by level.
export function drawStrip(canvas, frames, deadlineMs, bars) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  const most = Math.max(...frames.map(([ms]) => ms), 1e-3);
  const top = deadlineMs ? Math.max(deadlineMs * 1.15, Math.min(most, deadlineMs * 2)) : niceAbove(most);
  const y = (ms) => height - (Math.min(ms, top) / top) * (height - 4);
  const step = width / BARS;
  frames.slice(-BARS).forEach(([ms, level, missed], i, shown) => {
    const x = width - (shown.length - i) * step;
    context.fillStyle = css(missed ? bars[3] : bars[level] ?? bars[0]);
    context.fillRect(x, y(ms), Math.max(step - 0.35, 0.6), height - y(ms));
  });
  context.font = "10.5px system-ui, sans-serif";
  context.textBaseline = "bottom";
  const mark = deadlineMs ?? top;
  const ink = getComputedStyle(canvas).color;
  context.strokeStyle = deadlineMs ? css(bars[3]) : ink;
  context.globalAlpha = deadlineMs ? 0.75 : 0.3;
  context.setLineDash(deadlineMs ? [4, 3] : []);
  context.beginPath();
  context.moveTo(0, y(mark) + 0.5);
  context.lineTo(width, y(mark) + 0.5);
  context.stroke();
  context.globalAlpha = 1;
  context.fillStyle = ink;
  context.fillText(deadlineMs ? `deadline ${deadlineMs} ms` : `${mark} ms`, 2, y(mark) + 13);
}

function niceAbove(value) {
  const decade = 10 ** Math.floor(Math.log10(value));
  return decade * [1, 2, 5, 10].find((factor) => factor * decade >= value);
}

export function figuresText(frames) {
  const sorted = frames.map(([ms]) => ms).sort((a, b) => a - b);
  if (sorted.length === 0) return "";
  return `p50 ${percentile(sorted, 0.5).toFixed(1)}, p99 ${percentile(sorted, 0.99).toFixed(1)} ms`;
}

// "2 missed, 1 coarse": what befell the frames of the strip.
export function degradedText(frames) {
  const parts = [];
  const missed = frames.filter(([, , isMissed]) => isMissed).length;
  if (missed > 0) parts.push(`${missed} missed`);
  LEVELS.forEach((name, level) => {
    const count = frames.filter(([, of]) => of === level).length;
    if (level > 0 && count > 0) parts.push(`${count} ${name}`);
  });
  return parts.join(", ");
}
