// SPDX-License-Identifier: MIT

export class Curvature {
  constructor(k1, k2, d1, d2, state) {
    Object.assign(this, { k1, k2, d1, d2, state });
  }

  #combine(f) {
    return this.k1.map((k1, row) => f(k1, this.k2[row]));
  }

  get mean() {
    return this.#combine((k1, k2) => (k1 + k2) / 2);
  }

  get gaussian() {
    return this.#combine((k1, k2) => k1 * k2);
  }

  get shapeIndex() {
    return this.#combine((k1, k2) => (k1 === 0 && k2 === 0 ? NaN : (2 / Math.PI) * Math.atan2(k1 + k2, k1 - k2)));
  }

  get curvedness() {
    return this.#combine((k1, k2) => Math.hypot(k1, k2) / Math.SQRT2);
  }
}
