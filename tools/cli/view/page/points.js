// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// The returns that are shown, as they lie in the stream: in a buffer of the graphics unit, and for those who ask for one.

const ROOM = 1 << 20; // for points of sectors: more than two turns of any sensor
const HEIGHT_AT = 20; // of a point that has its height above the ground

export class Points {
  constructor(gl) {
    this.gl = gl;
    this.buffer = gl.createBuffer();
    this.compared = new Uint8Array(0); // a byte for each return (compared.js), or none
    this.comparedBuffer = gl.createBuffer();
    this.layout = gl.createVertexArray();
    this.pieces = []; // of the buffer: {first, count, frame, number of the first return}, and of sectors when they began
    this.next = null; // where the next sector goes; null: the buffer holds a whole frame
    this.pointBytes = 20;
  }

  get hasHeights() {
    return this.pointBytes >= HEIGHT_AT + 4;
  }

  // A whole frame. `bytes` stay as they are until the next one.
  setFrame({ header, points, compared }) {
    this.pieces = [{ first: 0, count: header.points, frame: header.number, number: 0 }];
    this.next = null;
    this.bytes = points;
    this.fill(points, header.pointBytes);
    this.setCompared(compared);
  }

  setCompared(compared) {
    const { gl } = this;
    this.compared = compared;
    gl.bindVertexArray(this.layout);
    gl.vertexAttribI4ui(5, 0, 0, 0, 0); // for all returns where there are no bytes
    if (compared.length === 0) return gl.disableVertexAttribArray(5);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.comparedBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, compared, gl.STREAM_DRAW);
    gl.enableVertexAttribArray(5);
    gl.vertexAttribIPointer(5, 1, gl.UNSIGNED_BYTE, 1, 0);
  }

  // Adds a part of a turn. `began` and `turn` are times of one unit: what began a turn or more before is forgotten.
  addSector({ header, points }, began, turn) {
    const { gl } = this;
    const count = header.points;
    if (this.next === null || this.pointBytes !== header.pointBytes) {
      this.bytes = new Uint8Array(ROOM * header.pointBytes);
      this.fill(this.bytes.length, header.pointBytes);
      this.setCompared(new Uint8Array(0));
      this.pieces = [];
      this.next = 0;
    }
    const first = this.next + count > ROOM ? 0 : this.next;
    this.next = first + count;
    const stays = (piece) => Math.abs(began - piece.began) < turn && (piece.first >= this.next || piece.first + piece.count <= first);
    this.pieces = this.pieces.filter(stays);
    this.pieces.push({ first, count, began, frame: header.number, number: header.firstReturn });
    this.bytes.set(points, first * this.pointBytes);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferSubData(gl.ARRAY_BUFFER, first * this.pointBytes, points);
  }

  // Makes the buffer anew, of bytes or of so many.
  fill(bytes, pointBytes) {
    const { gl } = this;
    this.pointBytes = pointBytes;
    gl.bindVertexArray(this.layout);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, bytes, gl.STREAM_DRAW);
    for (let i = 0; i < 4; ++i) gl.enableVertexAttribArray(i);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, pointBytes, 0);
    gl.vertexAttribPointer(1, 1, gl.UNSIGNED_BYTE, false, pointBytes, 12);
    gl.vertexAttribIPointer(2, 1, gl.UNSIGNED_BYTE, pointBytes, 13);
    gl.vertexAttribIPointer(3, 1, gl.UNSIGNED_SHORT, pointBytes, 14);
    if (!this.hasHeights) return gl.disableVertexAttribArray(4);
    gl.enableVertexAttribArray(4);
    gl.vertexAttribPointer(4, 1, gl.FLOAT, false, pointBytes, HEIGHT_AT);
  }

  draw() {
    const { gl, pieces } = this;
    gl.bindVertexArray(this.layout);
    for (let i = 0; i < pieces.length; ) {
      let { first, count } = pieces[i];
      while (pieces[++i]?.first === first + count) count += pieces[i].count;
      gl.drawArrays(gl.POINTS, first, count);
    }
  }

  get count() {
    return this.pieces.reduce((sum, piece) => sum + piece.count, 0);
  }

  // Calls `visit(x, y, z, intensity, label, row, above ground (undefined: not told), compared (compared.js), place in the
  // buffer, piece)`.
  each(visit) {
    if (this.pieces.length === 0) return;
    const { bytes, compared, pointBytes, hasHeights } = this;
    const floats = new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
    const shorts = new Uint16Array(bytes.buffer, bytes.byteOffset, bytes.length >> 1);
    for (const piece of this.pieces) {
      for (let i = piece.first; i < piece.first + piece.count; ++i) {
        const byte = i * pointBytes;
        const f = byte >> 2;
        visit(floats[f], floats[f + 1], floats[f + 2], bytes[byte + 12], bytes[byte + 13], shorts[(byte >> 1) + 7], hasHeights ? floats[f + HEIGHT_AT / 4] : undefined, compared[i] ?? 0, i, piece);
      }
    }
  }

  // The return with the least `score(place, label, row, compared)`, or null if none is finite:
  // {frame, number, place, intensity, label, row, aboveGround (undefined: not told), compared}
  best(score) {
    let [least, best] = [Infinity, null];
    this.each((x, y, z, intensity, label, row, aboveGround, compared, i, piece) => {
      const found = score([x, y, z], label, row, compared);
      if (found >= least) return;
      least = found;
      best = { frame: piece.frame, number: piece.number + i - piece.first, place: [x, y, z], intensity, label, row, aboveGround, compared };
    });
    return best;
  }
}
