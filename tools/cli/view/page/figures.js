// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// What a run says of itself, in words: the sensor, times, losses, how far it sees.

import { degradedText, drawStrip, figuresText } from "./strip.js";

const at = (id) => document.getElementById(id);
const durationText = (seconds) => (seconds < 120 ? `${Math.round(seconds)} s` : `${Math.round(seconds / 60)} min`);
const countText = (cause, count) => `${count} ${cause.replaceAll("_", " ")}`;

// `drawnPerSecond`: 0 where not known; `bars`: colours of the strip
export function showFigures(figures, drawnPerSecond, bars) {
  at("sensor").textContent = figures.sensor;
  at("times-title").textContent = figures.deadline_ms ? "after the last packet" : "work a frame";
  at("times-figures").textContent = figuresText(figures.frames);
  drawStrip(at("strip"), figures.frames, figures.deadline_ms, bars);
  showLosses(figures);
  at("sight").hidden = !figures.sight;
  if (figures.sight) {
    at("sight").dataset.state = figures.sight.state;
    at("sight").textContent = `view ${figures.sight.text}`;
  }
  const silent = figures.silent_s > 1;
  at("rate").classList.toggle("silent", silent);
  at("rate").textContent = silent ? `silent since ${durationText(figures.silent_s)}` : drawnPerSecond ? `${drawnPerSecond.toFixed(1)} pictures/s` : "";
}

function showLosses(figures) {
  const losses = at("losses");
  losses.replaceChildren();
  const lost = [degradedText(figures.frames), ...figures.losses.map(([cause, count]) => countText(cause, count))];
  for (const text of lost.filter(Boolean)) losses.append(Object.assign(document.createElement("b"), { textContent: text }));
  if (!losses.childElementCount) losses.append("nothing lost, nothing degraded");
  for (const [cause, count] of figures.onlookers) losses.append(Object.assign(document.createElement("span"), { textContent: countText(cause, count) }));
}
