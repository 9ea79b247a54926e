// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The picture as a PNG, and a short film of it.

const LONGEST_FILM_S = 60;
const EVERY_MS = 500; // a part of it comes

// What this browser films; undefined: nothing.
const FILM_TYPE = ["video/webm", "video/mp4"].find((type) => window.MediaRecorder?.isTypeSupported(type));
export const canFilm = FILM_TYPE !== undefined;

function save(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Call it right after the picture was drawn. `labels`: elements above it whose text belongs to it; `name`: of the file, without its ending
export function savePicture(canvas, labels, name) {
  const copy = Object.assign(document.createElement("canvas"), { width: canvas.width, height: canvas.height });
  const paint = copy.getContext("2d");
  paint.drawImage(canvas, 0, 0);
  const ratio = canvas.width / canvas.clientWidth;
  paint.scale(ratio, ratio);
  paint.textBaseline = "top";
  for (const label of labels) {
    const { left, top } = label.getBoundingClientRect();
    const style = getComputedStyle(label);
    if (style.visibility === "hidden") continue;
    paint.font = `${style.fontSize} ${style.fontFamily}`;
    paint.fillStyle = style.color;
    paint.fillText(label.textContent, left, top);
  }
  copy.toBlob((blob) => save(blob, `${name}.png`), "image/png");
}

export class Film {
  // `changed(text)`: how long and large it is; empty: none is made
  constructor(canvas, changed) {
    Object.assign(this, { canvas, changed, recorder: null });
  }

  // Begins one, or ends it and saves it under this name.
  toggle(name) {
    if (this.recorder) return this.recorder.stop();
    const parts = [];
    const begun = performance.now();
    const recorder = new MediaRecorder(this.canvas.captureStream(30), { mimeType: FILM_TYPE, videoBitsPerSecond: 8e6 });
    recorder.ondataavailable = ({ data }) => {
      parts.push(data);
      const seconds = (performance.now() - begun) / 1000;
      if (recorder.state === "inactive") return;
      this.changed(`${seconds.toFixed(0)} s, ${(parts.reduce((sum, part) => sum + part.size, 0) / 1e6).toFixed(1)} MB`);
      if (seconds > LONGEST_FILM_S) recorder.stop();
    };
    recorder.onstop = () => {
      for (const track of recorder.stream.getTracks()) track.stop();
      this.recorder = null;
      this.changed("");
      save(new Blob(parts, { type: FILM_TYPE }), `${name}.${FILM_TYPE.slice(6)}`);
    };
    recorder.start(EVERY_MS);
    this.recorder = recorder;
    this.changed("0 s");
  }
}
