// SPDX-License-Identifier: MIT
// meshhood in a scene of three.js: a click colors the neighborhood of the vertex under the pointer and makes a mesh of
// the patch there, and a brush paints what is within a way along the surface, but not the strands of the knot behind.
// `npm install && npm start`, after `make view`.
import { MeshIndex, initialize } from 'meshhood';
import wasm from 'meshhood/meshhood.wasm?url';
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { mergeVertices } from 'three/addons/utils/BufferGeometryUtils.js';

const RADIUS = 2;
const PATCH_RADIUS = 1;
const LIFT = 0.02; // of the patch above the surface, to be seen
const BRUSH_RADIUS = 0.5;
const SURFACE = new THREE.Color('#d9dbe0');
const NEAR = new THREE.Color('#009e73');
const PATCH = new THREE.Color('#cc79a7');
const PAINT = new THREE.Color('#d55e00');

/** A knot whose triangles share vertices: three.js repeats them along a seam, which no search would cross. */
function makeGeometry() {
  const seamed = new THREE.TorusKnotGeometry(3, 0.9, 400, 40);
  seamed.deleteAttribute('normal');
  seamed.deleteAttribute('uv');
  const geometry = mergeVertices(seamed);
  geometry.computeVertexNormals();
  geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(3 * geometry.attributes.position.count), 3));
  return geometry;
}

await initialize(wasm);
const geometry = makeGeometry();
const colors = geometry.attributes.color;
const faces = { corners: geometry.index.array };
const index = new MeshIndex(geometry.attributes.position.array, faces.corners);

const canvas = document.getElementById('canvas');
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.1, 100);
camera.position.set(0, 0, 16);
const light = new THREE.DirectionalLight('#ffffff', 2);
camera.add(light);
const scene = new THREE.Scene();
const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ vertexColors: true }));
const patch = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshStandardMaterial({ color: PATCH }));
patch.visible = false;
scene.add(mesh, patch, camera, new THREE.HemisphereLight('#ffffff', '#9aa3b5', 1.5));
const controls = new OrbitControls(camera, canvas);

function draw() {
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(innerWidth, innerHeight, false);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
}

function paint(vertices, color) {
  for (const v of vertices) colors.setXYZ(v, color.r, color.g, color.b);
  colors.needsUpdate = true;
  draw();
}

/** The point of the surface under the pointer; null over the background. */
function hitOf(event) {
  const at = new THREE.Vector2((2 * event.clientX) / innerWidth - 1, 1 - (2 * event.clientY) / innerHeight);
  const caster = new THREE.Raycaster();
  caster.setFromCamera(at, camera);
  const { origin, direction } = caster.ray;
  return index.firstHit(origin.toArray(), direction.toArray(), { faces });
}

function showNeighborhood({ point }) {
  const { vertex } = index.nearest(point);
  const near = index.neighborhood(vertex, RADIUS);
  paint(Array(colors.count).keys(), SURFACE);
  paint(near, NEAR);
  document.getElementById('result').textContent = `Vertex ${vertex}: ${near.length} vertices.`;
}

/** Three numbers of each vertex, at the points of a patch: each has three vertices, and their weights. */
function carry(values, { vertices, weights }) {
  const carried = new Float32Array(vertices.length);
  for (let i = 0; i < vertices.length; ++i) {
    for (let axis = 0; axis < 3; ++axis) carried[i - (i % 3) + axis] += weights[i] * values[3 * vertices[i] + axis];
  }
  return carried;
}

/** The surface in the ball as a mesh of its own, with the normals of the whole. */
function showPatch({ point, face }) {
  const clipped = index.clip(point, PATCH_RADIUS, { faces, face });
  const normals = carry(geometry.attributes.normal.array, clipped);
  const points = Float32Array.from(clipped.positions, (x, i) => x + LIFT * normals[i]);
  patch.geometry.dispose();
  patch.geometry = new THREE.BufferGeometry()
    .setAttribute('position', new THREE.BufferAttribute(points, 3))
    .setAttribute('normal', new THREE.BufferAttribute(normals, 3))
    .setIndex(new THREE.BufferAttribute(clipped.corners, 1));
  patch.visible = true;
  draw();
}

/** One dab: the vertices within the radius along the surface; paths begin at the point in the triangle that was hit. */
function brush({ point, vertices }) {
  patch.visible = false;
  paint(index.neighborhood(point, BRUSH_RADIUS, { seeds: vertices, metric: 'surface', faces }), PAINT);
}

let pressed = null;
canvas.addEventListener('pointerdown', (event) => {
  pressed = { x: event.clientX, y: event.clientY, isBrush: event.shiftKey };
  controls.enabled = !pressed.isBrush;
}, { capture: true });
canvas.addEventListener('pointermove', (event) => {
  const hit = pressed?.isBrush ? hitOf(event) : null;
  if (hit) brush(hit);
});
window.addEventListener('pointerup', (event) => { // also beside the canvas, where a brush may end
  if (pressed === null) return; // it went down elsewhere
  controls.enabled = true;
  const isClick = !pressed.isBrush && Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < 5;
  const hit = isClick ? hitOf(event) : null;
  if (hit) {
    showNeighborhood(hit);
    showPatch(hit);
  }
  pressed = null;
});
controls.addEventListener('change', draw);
window.addEventListener('resize', draw);
paint(Array(colors.count).keys(), SURFACE);
document.body.dataset.ready = 'true';
