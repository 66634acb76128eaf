// SPDX-License-Identifier: MIT
import { choose, expectNumber, expectPoint, expectType, expectVertex, withDefaults, withMesh } from './arguments.js';
import { Owner, makeInstance } from './instance.js';

const CORNERS = ['all', 'any'];

export class RegionMesh extends Owner {
  #positions;
  #isTriangles;

  constructor(positions, corners, options = {}) {
    const { offsets } = withDefaults(options, { offsets: null });
    super(makeInstance((instance) =>
      withMesh(instance, positions, { corners, offsets }, () => instance.call('prepare_regions'))));
    this.#positions = positions.slice();
    this.#isTriangles = offsets === null;
  }

  faces(ids, corners = 'all') {
    this.#call('faces', ids, choose(CORNERS, corners, 'corners'));
    return this.instance.takeCounts();
  }

  submesh(ids, corners = 'all') {
    const faces = this.faces(ids, corners);
    this.#call('submesh', ids, choose(CORNERS, corners, 'corners'));
    const vertices = this.instance.takeIds();
    const counts = this.instance.takeCounts();
    return {
      positions: this.#positionsOf(vertices),
      corners: counts.slice(faces.length + 1),
      offsets: this.#isTriangles ? null : counts.slice(0, faces.length + 1),
      vertices,
      faces,
    };
  }

  rim(ids, start, r) {
    expectNumber(r, 'radius');
    this.#call('rim', ids, ...this.#center(start), r);
    const points = this.instance.takeReals();
    const edges = this.instance.takeIds();
    const counts = this.instance.takeCounts();
    const lines = (counts.length - 1) / 2; // their offsets, and whether each is closed
    return Array.from({ length: lines }, (_, line) => {
      const [begin, end] = [counts[line], counts[line + 1]];
      return {
        points: points.slice(3 * begin, 3 * end),
        edges: edges.slice(2 * begin, 2 * end),
        isClosed: counts[lines + 1 + line] === 1,
      };
    });
  }

  #call(name, ids, ...values) {
    expectType(ids, [Uint32Array], 'ids');
    this.instance.with([ids], (address) => this.instance.call(name, address, ids.length, ...values));
  }

  #positionsOf(vertices) {
    const positions = new this.#positions.constructor(3 * vertices.length);
    vertices.forEach((v, row) => positions.set(this.#positions.subarray(3 * v, 3 * v + 3), 3 * row));
    return positions;
  }

  #center(start) {
    if (typeof start !== 'number') {
      expectPoint(start, 'start');
      return start;
    }
    expectVertex(start, this.#positions.length / 3);
    return this.#positions.subarray(3 * start, 3 * start + 3);
  }
}
