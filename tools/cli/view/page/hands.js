// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Keys, mouse and fingers on the picture.

const TAP_PX = 5; // moved less, a press is a tap

// `keys`: by name, what each does with its event.
export function listenToKeys(keys, changed) {
  addEventListener("keydown", (event) => {
    const wanted = keys[event.key];
    const isTyped = event.target.tagName === "SELECT" || (event.target.tagName === "INPUT" && event.key.startsWith("Arrow"));
    if (!wanted || event.ctrlKey || event.metaKey || event.altKey || isTyped) return;
    event.preventDefault();
    wanted(event);
    changed();
  });
}

// A drag turns, with shift or two fingers it moves, wheel and pinch zoom. `tapped(x, y, isFinger)` gets what was none of that.
export function listenToPointers(canvas, camera, { changed, tapped, reset }) {
  const fingers = new Map();
  let press = null;
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    press = fingers.size === 1 && event.button === 0 ? [event.clientX, event.clientY] : null;
  };
  canvas.onpointercancel = (event) => fingers.delete(event.pointerId);
  canvas.onpointerup = (event) => {
    fingers.delete(event.pointerId);
    if (press) tapped(...press, event.pointerType === "touch");
    press = null;
  };
  canvas.onpointermove = (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    if (press && Math.hypot(event.clientX - press[0], event.clientY - press[1]) < TAP_PX) return;
    press = null;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    const other = [...fingers].find(([id]) => id !== event.pointerId)?.[1];
    if (other) {
      const apart = (place) => Math.hypot(place[0] - other[0], place[1] - other[1]) || 1;
      camera.zoom(apart(before) / apart([event.clientX, event.clientY]));
      camera.move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons === 2) {
      camera.move(dx, dy);
    } else {
      camera.turn(dx, dy);
    }
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    changed();
  };
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.ondblclick = reset;
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(event.deltaY * 0.0012));
    changed();
  }, { passive: false });
}
