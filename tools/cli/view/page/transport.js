// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// A capture is played: its run is told so, and tells where it is.

const at = (id) => document.getElementById(id);
const clock = (seconds) => `${Math.floor(seconds / 60)}:${(seconds % 60).toFixed(1).padStart(4, "0")}`;
const MOST_TRIES = 5; // to come to a frame, of which only its number is known

export class Transport {
  constructor(say) {
    Object.assign(this, { say, state: null, isHeld: false, wanted: null });
    at("play").onclick = () => this.playOrPause();
    at("back").onclick = () => this.step(-1);
    at("ahead").onclick = () => this.step(1);
    at("loop").onclick = () => this.loop();
    at("speed").onchange = () => this.tell({ rate: Number(at("speed").value) });
    at("position").oninput = () => (this.isHeld = true);
    at("position").onchange = () => {
      this.isHeld = false;
      this.tell({ seek_s: Number(at("position").value) });
    };
  }

  async tell(command) {
    if (!this.state) return;
    this.wanted = null;
    await this.send(command);
  }
  async send(command) {
    try {
      const response = await fetch("control", { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(command) });
      if (!response.ok) this.say(await response.text());
      else this.show((await response.json()).capture);
    } catch (error) {
      console.warn(error);
    }
  }

  playOrPause() {
    return this.tell({ playing: !this.state?.playing });
  }
  loop() {
    return this.tell({ loop: !this.state?.loop });
  }
  step(frames) {
    if (frames === 1) return this.tell({ step: true });
    return this.tell({ playing: false, seek_s: Math.max(0, (this.state?.position_s ?? 0) + frames * (this.state?.frame_s ?? 0)) });
  }

  // Stops at the frame of this number. The run seeks by time, so it is sought again where another came.
  goToFrame(number) {
    this.wanted = { number, tries: 0, seek_s: undefined };
  }
  async comeToWanted() {
    const { wanted, state } = this;
    if (!wanted || state.seeking) return;
    const hasCome = wanted.seek_s !== undefined && state.frame === wanted.number;
    if (hasCome || wanted.tries++ === MOST_TRIES) {
      this.wanted = null;
      return;
    }
    const from = wanted.seek_s === undefined ? 0 : wanted.seek_s - state.frame * state.frame_s;
    wanted.seek_s = Math.min(Math.max(from + wanted.number * state.frame_s, 0), state.duration_s);
    await this.send({ playing: false, seek_s: wanted.seek_s });
  }

  // `state`: null of a live run
  show(state) {
    this.state = state;
    document.body.classList.toggle("capture", Boolean(state));
    at("transport").hidden = !state;
    if (!state) return;
    document.body.dataset.playing = state.playing;
    at("loop").ariaPressed = state.loop;
    at("speed").value = String(state.rate);
    at("position").max = state.duration_s;
    if (!this.isHeld) at("position").value = state.position_s;
    at("clock").textContent = `${clock(state.position_s)} / ${clock(state.duration_s)}`;
  }
}
