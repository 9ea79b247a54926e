// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// What labels are compared with: the truth, and labels by a second set of parameters. Both come in a byte for each return
// (frame_comparison.hpp).

const LABELS = [0, 40, 99, 49]; // by bits 2 and 3
const isGround = (label) => label === 40 || label === 49;

// A return's label by the run's own parameters (0), or by those beside them (1).
export const labelBy = (which, label, compared) => (which === 0 ? label : LABELS[(compared >> 2) & 3]);

export const TRUTHS = [undefined, "ground", "obstacle", "key obstacle"]; // by bits 0 and 1

// The name of the colour in which a return stands out; undefined: it does not.
export function markOf(colourBy, which, label, compared) {
  if (colourBy === "mistakes") {
    const shown = labelBy(which, label, compared);
    const truth = compared & 3;
    if (truth >= 2 && isGround(shown)) return "missed";
    return truth === 1 && shown === 99 ? "falseObstacle" : undefined;
  }
  if (colourBy !== "differences") return undefined;
  const beside = labelBy(1, label, compared);
  if (beside === 0 || beside === label) return undefined;
  return beside === 99 ? "toObstacle" : label === 99 ? "toGround" : "toOther";
}

const percent = (share) => `${(100 * share).toFixed(2)} %`;
const count = (number) => number.toLocaleString("en");

export class Compared {
  constructor() {
    Object.assign(this, { truth: false, names: [], isSplit: true, scores: [], differing: undefined });
  }

  // True if the run compares more than was known.
  note({ compared }) {
    if (!compared || this.names.length > 0) return false;
    Object.assign(this, compared);
    return true;
  }

  get hasBeside() {
    return this.names.length > 1;
  }
  get isAny() {
    return this.truth || this.hasBeside;
  }
  // What there is to switch: colours, and whether both pictures are shown.
  get modes() {
    return new Set([...(this.truth ? ["mistakes"] : []), ...(this.hasBeside ? ["differences", "split"] : [])]);
  }
  // Which parameters' labels are shown, one after the other. Differences are the same in both pictures, so there is one.
  shown(colourBy) {
    return this.hasBeside && this.isSplit && colourBy !== "differences" ? [0, 1] : [0];
  }

  // `found`: {scores, differing} of the frame that is shown
  take({ scores, differing }) {
    Object.assign(this, { scores: scores ?? [], differing });
  }

  // What stands above the picture of one of them: its name, figures, and what colours mean, [[text, colour's name]].
  caption(which, colourBy) {
    const differ = this.differing === undefined ? "" : `${count(this.differing)} returns differ`;
    const [own, beside] = this.names;
    if (colourBy === "differences") {
      const colours = [[`obstacle by ${own} alone`, "toGround"], [`obstacle by ${beside} alone`, "toObstacle"]];
      return { name: `${own}, ${beside}`, text: differ, colours };
    }
    const name = this.hasBeside ? this.names[which] : "";
    const score = this.scores[which];
    if (score) {
      const colours = [[`${count(score.missed)} missed`, "missed"], [`${count(score.false)} false`, "falseObstacle"]];
      return { name, text: `IoU_g ${percent(score.iou_g)}, Recall_o ${percent(score.recall_o)}`, colours };
    }
    return { name, text: this.truth ? "no truth for this frame" : which === 1 ? differ : "", colours: [] };
  }
}
