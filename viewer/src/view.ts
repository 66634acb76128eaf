// SPDX-License-Identifier: MIT
// The scene: the mesh, the vertex, the ball, and the camera that looks at them.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import { drawAnswers } from './answer_shader';
import type { Ball } from './answer_shader';
import { VERTEX_COLOR } from './colors';
import type { Surface } from './messages';
import type { Painting } from './paint';
import { Picker } from './picking';

export type Cut = 'none' | 'x' | 'y' | 'z';

/** How the mesh is shown, besides its colors. */
export interface Look {
  wireframe: boolean;
  ball: boolean;
  /** Hide one side of the plane through the vertex, perpendicular to an axis. */
  cut: Cut;
  /** Hide what is nearer to the camera than the vertex. */
  hideNearer: boolean;
}

const NORMALS: Record<Exclude<Cut, 'none'>, THREE.Vector3> = {
  x: new THREE.Vector3(-1, 0, 0),
  y: new THREE.Vector3(0, -1, 0),
  z: new THREE.Vector3(0, 0, -1),
};

/** Pixels at three sides of the canvas that something covers. */
export interface Covered {
  top: number;
  right: number;
  bottom: number;
}

const HIDDEN_OPACITY = 0.35;

/** A disk with a white rim, always of the same size. */
function makeMarker(): THREE.Sprite {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = canvas.getContext('2d')!;
  for (const [radius, color] of [[29, '#ffffff'], [21, VERTEX_COLOR]] as const) {
    context.fillStyle = color;
    context.beginPath();
    context.arc(32, 32, radius, 0, 2 * Math.PI);
    context.fill();
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  const material = new THREE.SpriteMaterial({ map: texture, depthTest: false, sizeAttenuation: false, transparent: true });
  const marker = new THREE.Sprite(material);
  marker.scale.setScalar(0.022);
  marker.renderOrder = 2;
  marker.visible = false;
  return marker;
}

const isDark = () => matchMedia('(prefers-color-scheme: dark)').matches;

/** A glass ball: only its rim is visible. */
function makeBall(): THREE.Mesh {
  const material = new THREE.ShaderMaterial({
    transparent: true,
    depthWrite: false,
    uniforms: { color: { value: new THREE.Color(isDark() ? '#c3d0e8' : '#3b4a66') } },
    vertexShader: `
      varying float facing;
      void main() {
        vec4 position4 = modelViewMatrix * vec4(position, 1.0);
        facing = abs(dot(normalize(normalMatrix * normal), normalize(position4.xyz)));
        gl_Position = projectionMatrix * position4;
      }`,
    fragmentShader: `
      uniform vec3 color;
      varying float facing;
      void main() { gl_FragColor = vec4(color, 0.04 + 0.5 * pow(1.0 - facing, 4.0)); }`,
  });
  const ball = new THREE.Mesh(new THREE.SphereGeometry(1, 64, 32), material);
  ball.visible = false;
  ball.renderOrder = 1;
  return ball;
}

export class View {
  readonly camera = new THREE.PerspectiveCamera(32, 1, 0.1, 1000);
  readonly controls: OrbitControls;
  readonly #renderer: THREE.WebGLRenderer;
  readonly #scene = new THREE.Scene();
  readonly #marker = makeMarker();
  readonly #ball = makeBall();
  readonly #light = new THREE.DirectionalLight('#ffffff', 2.2);
  readonly #plane = new THREE.Plane();
  #surface: Surface | null = null;
  #colors: THREE.BufferAttribute | null = null;
  #answers: THREE.BufferAttribute | null = null;
  #areBalls = true; // the answers that are drawn
  readonly #answerBall: Ball = { center: new THREE.Vector3(), radius: 0 };
  #drawn: THREE.Mesh | THREE.Points | null = null;
  #edges: THREE.Mesh | null = null;
  #picker: Picker | null = null;
  #look: Look = { wireframe: false, ball: true, cut: 'none', hideNearer: false };
  #vertex = -1;
  #radius = 0;
  #pending = false;
  #covered: Covered = { top: 0, right: 0, bottom: 0 };

  constructor(canvas: HTMLCanvasElement) {
    this.#renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: false });
    this.#renderer.localClippingEnabled = true;
    this.#renderer.setClearColor(0x000000, 0);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.addEventListener('change', () => this.draw());
    this.camera.add(this.#light);
    this.#light.position.set(-0.4, 0.7, 1);
    this.#scene.add(this.camera, new THREE.HemisphereLight('#ffffff', '#9aa3b5', 1.5), this.#marker, this.#ball);
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    const { top, right, bottom } = this.#covered;
    this.camera.setViewOffset(clientWidth, clientHeight, right / 2, (bottom - top) / 2, clientWidth, clientHeight);
    this.draw();
  }

  /** The middle of the picture is that of what is not covered. */
  set covered(covered: Covered) {
    this.#covered = covered;
    this.#resize();
  }

  /** Draws once before the next frame. */
  draw(): void {
    if (this.#pending) return;
    this.#pending = true;
    requestAnimationFrame(() => {
      this.#pending = false;
      this.controls.update();
      this.#render();
    });
  }

  #render(): void {
    this.#placePlane();
    this.#marker.material.opacity = this.isVertexHidden ? HIDDEN_OPACITY : 1;
    this.#renderer.render(this.#scene, this.camera);
  }

  /** Whether something stands between the camera and the vertex. */
  get isVertexHidden(): boolean {
    if (this.#vertex < 0 || this.#picker === null) return false;
    return this.#picker.isHidden(this.position(this.#vertex), this.camera.position, 2e-3 * this.extent);
  }

  setMesh(surface: Surface, tree: unknown, painting: Painting): void {
    this.#clear();
    this.#surface = surface;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(surface.positions, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(surface.normals, 3));
    [this.#colors, this.#answers] = [painting.colors, painting.answers].map((bytes) =>
      new THREE.BufferAttribute(bytes, 4, true).setUsage(THREE.DynamicDrawUsage));
    geometry.setAttribute('color', this.#colors);
    geometry.setAttribute('answers', this.#answers);
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), surface.extent);
    if (surface.triangles.length > 0) {
      geometry.setIndex(new THREE.BufferAttribute(surface.triangles, 1));
      this.#drawn = new THREE.Mesh(geometry, surfaceMaterial());
    } else {
      this.#drawn = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 2.5, sizeAttenuation: false, vertexColors: true }));
    }
    drawAnswers(this.#drawn.material as THREE.Material, this.#answerBall);
    this.#scene.add(this.#drawn);
    this.#picker = new Picker(this.#drawn, tree);
    this.#marker.visible = this.#ball.visible = false;
    this.#vertex = -1;
    this.showAll();
    this.setLook(this.#look);
  }

  #clear(): void {
    for (const object of [this.#drawn, this.#edges]) {
      if (object === null) continue;
      this.#scene.remove(object);
      (object.material as THREE.Material).dispose();
    }
    this.#drawn?.geometry.dispose();
    this.#edges = null;
  }

  /** To be called after the colors of the painting have changed. */
  updateColors(): void {
    if (this.#colors !== null) this.#colors.needsUpdate = true;
    this.draw();
  }

  /** To be called after the answers of the painting have changed. `areBalls`: they are those of the query. */
  updateAnswers(areBalls: boolean): void {
    if (this.#answers !== null) this.#answers.needsUpdate = true;
    this.#areBalls = areBalls;
    this.#placeBall();
    this.draw();
  }

  /** The ball that the answers end at; points have no borders. */
  #placeBall(): void {
    const isMesh = this.#drawn instanceof THREE.Mesh;
    this.#answerBall.radius = isMesh && this.#areBalls ? this.#radius / this.unit : -1;
    if (this.#vertex >= 0) this.#answerBall.center.copy(this.position(this.#vertex));
  }

  setLook(look: Look): void {
    this.#look = { ...look };
    this.#ball.visible = look.ball && this.#vertex >= 0;
    const isClipped = (look.cut !== 'none' || look.hideNearer) && this.#vertex >= 0;
    this.#showEdges(look.wireframe);
    for (const object of [this.#drawn, this.#edges]) {
      if (object !== null) (object.material as THREE.Material).clippingPlanes = isClipped ? [this.#plane] : null;
    }
    if (this.#picker !== null) this.#picker.plane = isClipped ? this.#plane : null;
    this.draw();
  }

  #showEdges(visible: boolean): void {
    if (visible && this.#edges === null && this.#drawn instanceof THREE.Mesh) {
      const material = new THREE.MeshBasicMaterial({ color: '#1c2330', wireframe: true, transparent: true, opacity: 0.28 });
      this.#edges = new THREE.Mesh(this.#drawn.geometry, material);
      this.#scene.add(this.#edges);
    }
    if (this.#edges !== null) this.#edges.visible = visible;
  }

  /** The radius is in the unit of the mesh. */
  setQuery(vertex: number, radius: number): void {
    this.#vertex = vertex;
    this.#radius = radius;
    const at = this.position(vertex);
    this.#marker.position.copy(at);
    this.#ball.position.copy(at);
    this.#ball.scale.setScalar(Math.max(Math.min(radius / this.unit, 1e3 * this.extent), 1e-9 * this.extent));
    this.#marker.visible = true;
    this.#placeBall();
    this.setLook(this.#look);
  }

  /** In the coordinates of the scene. */
  get extent(): number {
    return this.#surface?.extent ?? 1;
  }

  /** Of the coordinates of the scene, in the unit of the mesh. */
  get unit(): number {
    return this.#surface?.unit ?? 1;
  }

  /** In the coordinates of the scene. */
  position(vertex: number): THREE.Vector3 {
    return new THREE.Vector3().fromArray(this.#surface!.positions, 3 * vertex);
  }

  #placePlane(): void {
    if (this.#vertex < 0) return;
    const { cut } = this.#look;
    const normal = cut === 'none' ? this.camera.getWorldDirection(new THREE.Vector3()) : NORMALS[cut];
    // A little behind the vertex, so that the surface around it is not cut.
    const slack = cut === 'none' ? normal.clone().multiplyScalar(-1e-3 * this.extent) : new THREE.Vector3();
    this.#plane.setFromNormalAndCoplanarPoint(normal, this.position(this.#vertex).add(slack));
  }

  /** The vertex nearest to what is seen at a point of the canvas, in pixels; null over the background. */
  pick(x: number, y: number): number | null {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    const at = new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
    return this.#picker?.pick(at, this.camera) ?? null;
  }

  /** Where a vertex is on the canvas, in pixels. */
  toCanvas(vertex: number): { x: number; y: number } {
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    this.camera.updateMatrixWorld();
    const at = this.position(vertex).project(this.camera);
    return { x: ((at.x + 1) / 2) * clientWidth, y: ((1 - at.y) / 2) * clientHeight };
  }

  /** Whether a point of the canvas is close to the marker. */
  isNearMarker(x: number, y: number, pixels: number): boolean {
    if (this.#vertex < 0) return false;
    const marker = this.toCanvas(this.#vertex);
    return Math.hypot(marker.x - x, marker.y - y) <= pixels;
  }

  /** Looks at the whole mesh from the side on which it appears largest. */
  showAll(): void {
    this.#lookFrom(new THREE.Vector3(0.55, 0.4, 1), new THREE.Vector3(), this.extent);
  }

  /**
   * Looks at the query from a direction; by default along the normal of its vertex, a little from the side. The radius
   * is in the unit of the mesh.
   */
  showQuery(radius: number, from?: readonly [number, number, number]): void {
    if (this.#vertex < 0) return;
    const reach = Math.min(Math.max((1.5 * radius) / this.unit, 0.05 * this.extent), this.extent);
    const look = (direction: THREE.Vector3) => this.#lookFrom(direction, this.position(this.#vertex), reach);
    const preferred = from === undefined ? this.#outwards() : new THREE.Vector3(...from);
    look(preferred);
    if (from !== undefined || !this.isVertexHidden) return;
    // Of the directions near the preferred one, the first from which the vertex is seen.
    for (const direction of directionsAround(preferred)) {
      look(direction);
      if (!this.isVertexHidden) return;
    }
    look(preferred);
  }

  #outwards(): THREE.Vector3 {
    const normal = new THREE.Vector3().fromArray(this.#surface!.normals, 3 * this.#vertex);
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    if (normal.dot(back) < 0) normal.negate();
    return normal.addScaledVector(back, 0.6);
  }

  #lookFrom(direction: THREE.Vector3, target: THREE.Vector3, radius: number): void {
    const half = THREE.MathUtils.degToRad(this.camera.fov / 2);
    const { clientWidth, clientHeight } = this.#renderer.domElement;
    const { top, right, bottom } = this.#covered;
    const free = Math.min(clientWidth - right, clientHeight - top - bottom) / Math.max(clientHeight, 1);
    const narrow = Math.atan(Math.tan(half) * Math.max(free, 0.1));
    const distance = (1.05 * radius) / Math.sin(narrow);
    this.camera.near = 1e-3 * this.extent;
    this.camera.far = distance + 4 * this.extent;
    this.camera.position.copy(target).addScaledVector(direction.normalize(), distance);
    this.controls.target.copy(target);
    this.controls.maxDistance = 12 * this.extent;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** Position and target in the unit of the mesh, for the link to this state. */
  get cameraState(): number[] {
    const numbers = [...this.camera.position.toArray(), ...this.controls.target.toArray()];
    return numbers.map((x) => Number((this.unit * x).toPrecision(6)));
  }

  set cameraState(numbers: number[]) {
    this.showAll();
    const inScene = numbers.map((x) => x / this.unit);
    this.camera.position.fromArray(inScene, 0);
    this.controls.target.fromArray(inScene, 3);
    this.camera.far = this.camera.position.length() + 4 * this.extent;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** Turns the camera around its target, by angles in radians. */
  turn(around: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const spherical = new THREE.Spherical().setFromVector3(offset);
    spherical.theta += around;
    spherical.phi = Math.min(Math.PI - 0.01, Math.max(0.01, spherical.phi + up));
    this.camera.position.setFromSpherical(spherical).add(this.controls.target);
    this.draw();
  }

  /** Moves the camera towards its target: the distance is divided by `factor`. */
  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
    this.camera.position.copy(this.controls.target).add(offset);
    this.draw();
  }

  /** A PNG of what is seen, over `background`; null if the browser cannot make it. */
  async picture(background: string): Promise<Blob | null> {
    this.#scene.background = new THREE.Color(background);
    this.#render();
    const blob = await new Promise<Blob | null>((resolve) => this.#renderer.domElement.toBlob(resolve));
    this.#scene.background = null;
    this.draw();
    return blob;
  }
}

/** The corners, edges and faces of a cube, seen from its middle, those nearest to `preferred` first. */
function directionsAround(preferred: THREE.Vector3): THREE.Vector3[] {
  const steps = [-1, 0, 1];
  return steps
    .flatMap((x) => steps.flatMap((y) => steps.map((z) => new THREE.Vector3(x, y, z).normalize())))
    .filter((direction) => direction.lengthSq() > 0)
    .sort((a, b) => b.dot(preferred) - a.dot(preferred));
}

function surfaceMaterial(): THREE.Material {
  return new THREE.MeshStandardMaterial({
    vertexColors: true, side: THREE.DoubleSide, roughness: 0.75, metalness: 0,
    polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
  });
}
