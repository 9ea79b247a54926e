// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The address carries the frame that stands, the camera and the colours: #frame=12&view=top&colour=ring

const CAMERA = ["yaw", "pitch", "distance"];
const VIEWS = ["orbit", "follow", "top"];
const rounded = (value) => String(Math.round(value * 1000) / 1000);

// `frame`: undefined where none stands
export function writeLink(frame, camera, colourBy) {
  const parts = [["view", camera.view]];
  if (frame !== undefined) parts.unshift(["frame", frame]);
  if (camera.isMoved) parts.push(["camera", [...CAMERA.map((name) => camera[name]), ...camera.target].map(rounded).join(",")]);
  if (colourBy !== "label") parts.push(["colour", colourBy]);
  const hash = `#${parts.map((part) => part.join("=")).join("&")}`;
  if (hash !== location.hash) history.replaceState(null, "", hash);
}

// Moves the camera as the address says, and returns what else it does: {frame, colour}, undefined where it says nothing.
export function readLink(camera) {
  const said = new URLSearchParams(location.hash.slice(1));
  if (VIEWS.includes(said.get("view"))) camera.look(said.get("view"));
  const numbers = (said.get("camera") ?? "").split(",").map(Number);
  if (numbers.length === 6 && numbers.every(Number.isFinite)) {
    CAMERA.forEach((name, i) => (camera[name] = numbers[i]));
    camera.target = numbers.slice(3);
    camera.zoom(1); // within its bounds
  }
  const frame = /^\d+$/.test(said.get("frame") ?? "") ? Number(said.get("frame")) : undefined;
  return { frame, colour: said.get("colour") ?? undefined };
}
