// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors

// Light or dark paper: as the system prefers it, until somebody switches.

const prefersLight = matchMedia("(prefers-color-scheme: light)");

export class Theme {
  constructor(changed) {
    this.set(prefersLight.matches);
    prefersLight.addEventListener("change", () => {
      this.set(prefersLight.matches);
      changed();
    });
  }

  set(isLight) {
    this.isLight = isLight;
    document.documentElement.dataset.theme = isLight ? "light" : "dark";
  }
}
