// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The labelled stream (docs/reference/labelled_stream.md) out of a fetch: whole frames, one after the other, or their sectors.

const MAGIC = 0x544c4354; // "TCLT", little-endian
const HEADER_START = 8;   // up to and with header_bytes
const MOST_POINTS = 4194304;
const SECTOR = 16; // in flags: a sector
const COMPARED = 0x80000000; // in flags: a byte for each point follows the points

export const LEVELS = ["full", "cut stopped", "coarse", "skipped"];

function parseHeader(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return {
    number: view.getUint32(8, true),
    points: view.getUint32(12, true),
    firstPacketNs: view.getBigInt64(16, true),
    lastPacketNs: view.getBigInt64(24, true),
    labelsNs: view.getBigInt64(32, true),
    pointBytes: view.getUint16(40, true),
    level: view.getUint8(43),
    isSector: (view.getUint32(44, true) & SECTOR) !== 0,
    isCompared: (view.getUint32(44, true) & COMPARED) !== 0,
    missed: view.getUint32(48, true),
    firstReturn: view.getUint32(52, true),
  };
}

// Cuts chunks of any size into pieces of the sizes asked for.
class Pieces {
  constructor(reader) {
    this.reader = reader;
    this.chunk = new Uint8Array(0);
  }

  // Fills `into`; false where the stream ends before.
  async fill(into) {
    let filled = 0;
    while (filled < into.length) {
      if (this.chunk.length === 0) {
        const { done, value } = await this.reader.read();
        if (done) return false;
        this.chunk = value;
      }
      const count = Math.min(this.chunk.length, into.length - filled);
      into.set(this.chunk.subarray(0, count), filled);
      this.chunk = this.chunk.subarray(count);
      filled += count;
    }
    return true;
  }
}

// Yields {header, points, compared} of each frame or sector: the bytes of its points as they lie, and a byte for each point
// where it is compared (compared.js), else none; good until the one after the next.
export async function* readFrames(url) {
  // No page elsewhere can send this header, so none can hold a place among those that look.
  const response = await fetch(url, { cache: "no-store", headers: { "X-Terracut-Page": "1" } });
  if (!response.ok) throw new Error(`${url}: ${response.status} ${await response.text()}`);
  const pieces = new Pieces(response.body.getReader());
  const rooms = [new Uint8Array(0), new Uint8Array(0)];
  for (let turn = 0; ; turn ^= 1) {
    const start = new Uint8Array(HEADER_START);
    if (!(await pieces.fill(start))) return;
    const startView = new DataView(start.buffer);
    const headerBytes = startView.getUint16(6, true);
    if (startView.getUint32(0, true) !== MAGIC || headerBytes < 56) throw new Error("no labelled stream");
    const header = new Uint8Array(headerBytes);
    header.set(start);
    if (!(await pieces.fill(header.subarray(HEADER_START)))) return;
    const frame = parseHeader(header);
    if (frame.points > MOST_POINTS || frame.pointBytes < 16) throw new Error("a frame out of range");
    const pointsEnd = frame.points * frame.pointBytes;
    const bytes = pointsEnd + (frame.isCompared ? frame.points : 0);
    if (rooms[turn].length < bytes) rooms[turn] = new Uint8Array(bytes);
    const read = rooms[turn].subarray(0, bytes);
    if (!(await pieces.fill(read))) return;
    yield { header: frame, points: read.subarray(0, pointsEnd), compared: read.subarray(pointsEnd) };
  }
}
