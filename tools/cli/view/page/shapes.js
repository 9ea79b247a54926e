// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// What is drawn of lines and areas beside the points: x, y, z, and how bright, for each end of a line.

const CIRCLES_M = [10, 20, 30, 40, 50, 60, 70, 80, 90, 100];
const VEHICLE = { front: 2.6, rear: -2.2, half: 0.95 };
const LEAST_RING_M = 3;

// Circles, axes and the vehicle.
export function floorSegments() {
  const places = [];
  const line = (a, b, bright) => places.push(...a, bright, ...b, bright);
  for (const radius of CIRCLES_M) {
    const parts = 24 + radius;
    for (let i = 0; i < parts; ++i) {
      const [a, b] = [i, i + 1].map((k) => (2 * Math.PI * k) / parts).map((t) => [radius * Math.cos(t), radius * Math.sin(t), 0]);
      line(a, b, radius % 50 === 0 ? 0.5 : 0.26);
    }
  }
  line([-100, 0, 0], [100, 0, 0], 0.26);
  line([0, -100, 0], [0, 100, 0], 0.26);
  const { front, rear, half } = VEHICLE;
  const outline = [[front, 0], [front - 1, half], [rear, half], [rear, -half], [front - 1, -half], [front, 0]];
  for (let i = 1; i < outline.length; ++i) line([...outline[i - 1], 0.05], [...outline[i], 0.05], 1.6);
  return new Float32Array(places);
}

// The twelve edges of each box: {corners, bottom_m, top_m}.
export function boxSegments(boxes) {
  const places = [];
  for (const { corners, bottom_m: bottom, top_m: top } of boxes) {
    corners.forEach((corner, i) => {
      const next = corners[(i + 1) % corners.length];
      for (const [from, to] of [[[...corner, bottom], [...next, bottom]], [[...corner, top], [...next, top]], [[...corner, bottom], [...corner, top]]]) {
        places.push(...from, 1, ...to, 1);
      }
    });
  }
  return new Float32Array(places);
}

// An arc of each sector in one of the states, at the range up to which it sees; of a blocked one the sector's edge, too.
// Sectors are [state, visible_m], clockwise from straight ahead.
export function sightSegments(sectors, state) {
  const places = [];
  sectors.forEach(([of, visible], i) => {
    if (of !== state) return;
    const place = (turns, radius) => [radius * Math.cos(2 * Math.PI * turns), -radius * Math.sin(2 * Math.PI * turns), 0.05, 1];
    const radius = Math.max(visible, LEAST_RING_M);
    const parts = 5;
    for (let part = 0; part < parts; ++part) {
      const [from, to] = [part, part + 1].map((at) => (i + at / parts) / sectors.length);
      places.push(...place(from, radius), ...place(to, radius));
      if (state === "blocked") places.push(...place(from, radius), ...place(from, 10));
    }
  });
  return new Float32Array(places);
}

// The line around the free area, of these corners.
export function outlineSegments(corners) {
  return new Float32Array(corners.flatMap((corner, i) => [...corner, 0, 1, ...corners[(i + 1) % corners.length], 0, 1]));
}
// The area itself, as triangles around the vehicle.
export function areaTriangles(corners) {
  return new Float32Array(corners.flatMap((corner, i) => [0, 0, 0, 0.3, ...corner, 0, 0.3, ...corners[(i + 1) % corners.length], 0, 0.3]));
}
