// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// A turn as it comes: each sector takes the place of the same returns of the turn before.

export class Turn {
  constructor() {
    this.bytes = new Uint8Array(0);
    this.number = -1;
    this.end = 0;   // returns of this turn so far
    this.count = 0; // and with those that are left of the turn before
  }

  // Takes a sector and returns the picture that it makes: {header, points} as of a frame.
  take({ header, points }) {
    if (header.number !== this.number) {
      this.count = this.end;
      this.number = header.number;
    }
    const { firstReturn, pointBytes } = header;
    this.end = firstReturn + header.points;
    if (this.bytes.length < this.end * pointBytes) {
      const before = this.bytes;
      this.bytes = new Uint8Array(2 * this.end * pointBytes);
      this.bytes.set(before);
    }
    this.bytes.set(points, firstReturn * pointBytes);
    this.count = Math.max(this.count, this.end);
    return { header: { ...header, points: this.count }, points: this.bytes.subarray(0, this.count * pointBytes) };
  }
}
