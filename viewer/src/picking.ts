// SPDX-License-Identifier: MIT
// From a point of the picture to the vertex that is seen there.
import * as THREE from 'three';
import { MeshBVH } from 'three-mesh-bvh';

export class Picker {
  /** Vertices on its negative side are not seen. */
  plane: THREE.Plane | null = null;
  readonly #positions: THREE.BufferAttribute;
  readonly #triangles: THREE.BufferAttribute | null;
  readonly #tree: MeshBVH | null;
  readonly #ray = new THREE.Raycaster();

  constructor(drawn: THREE.Mesh | THREE.Points, tree: unknown) {
    this.#positions = drawn.geometry.getAttribute('position') as THREE.BufferAttribute;
    this.#triangles = drawn.geometry.getIndex();
    this.#tree = tree === null ? null : MeshBVH.deserialize(tree as never, drawn.geometry, { setIndex: false });
  }

  /** `at` is in normalized device coordinates. */
  pick(at: THREE.Vector2, camera: THREE.PerspectiveCamera): number | null {
    this.#ray.setFromCamera(at, camera);
    return this.#tree === null ? this.#pickPoint(camera) : this.#pickTriangle(this.#tree);
  }

  /** Whether the triangles hide a point from an eye; those nearer to the point than `slack` do not. */
  isHidden(point: THREE.Vector3, eye: THREE.Vector3, slack: number): boolean {
    if (this.#tree === null) return false;
    const towards = point.clone().sub(eye);
    const distance = towards.length();
    const hits = this.#tree.raycast(new THREE.Ray(eye, towards.normalize()), THREE.DoubleSide);
    return hits.some((hit) => hit.distance < distance - slack && this.#isSeen(hit.point));
  }

  #isSeen(point: THREE.Vector3): boolean {
    return this.plane === null || this.plane.distanceToPoint(point) >= 0;
  }

  #pickTriangle(tree: MeshBVH): number | null {
    const hits = tree.raycast(this.#ray.ray, THREE.DoubleSide).filter((hit) => this.#isSeen(hit.point));
    if (hits.length === 0) return null;
    const hit = hits.reduce((a, b) => (a.distance <= b.distance ? a : b));
    return this.#nearestCorner(hit.faceIndex!, hit.point);
  }

  #nearestCorner(face: number, point: THREE.Vector3): number {
    const corners = [0, 1, 2].map((i) => this.#triangles!.getX(3 * face + i));
    const distance = (v: number) => new THREE.Vector3().fromBufferAttribute(this.#positions, v).distanceTo(point);
    return corners.reduce((a, b) => (distance(a) <= distance(b) ? a : b));
  }

  /** Without triangles: of the vertices within a hundredth of the height of the picture, the one in front. */
  #pickPoint(camera: THREE.PerspectiveCamera): number | null {
    const { origin, direction } = this.#ray.ray;
    const slope = 0.02 * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
    const point = new THREE.Vector3();
    let found: number | null = null;
    let nearest = Infinity;
    for (let v = 0; v < this.#positions.count; ++v) {
      point.fromBufferAttribute(this.#positions, v);
      const depth = point.clone().sub(origin).dot(direction);
      if (depth <= 0 || depth >= nearest || !this.#isSeen(point)) continue;
      if (this.#ray.ray.distanceSqToPoint(point) > (slope * depth) ** 2) continue;
      nearest = depth;
      found = v;
    }
    return found;
  }
}
