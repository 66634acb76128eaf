// SPDX-License-Identifier: MIT
// Checks of arguments that the module cannot make: types, names, and whole numbers, which in JavaScript may have more
// than the 32 bits of an id or a size. Other numbers are checked in C++.
import { MeshhoodError } from './instance.js';
import { nearestWord } from './words.js';

function refuseOption(name, known) {
  const nearest = nearestWord(name, known);
  const hint = nearest === null ? `expected one of ${known.join(', ')}` : `did you mean '${nearest}'?`;
  throw new TypeError(`unknown option '${name}', ${hint}`);
}

const TYPED_ARRAY = Object.getPrototypeOf(Uint8Array);

/** Whether `value` passes for a typed array, of which it has no memory. */
const isImitation = (value) => value instanceof TYPED_ARRAY && !ArrayBuffer.isView(value);

/** In a message: an object by its type, for an array may have millions of numbers. */
function shown(value) {
  if (typeof value === 'string') return `'${value}'`;
  if (typeof value === 'bigint') return `${value}n`;
  if (typeof value !== 'object' || value === null) return String(value);
  return isImitation(value) ? 'Proxy' : value.constructor?.name ?? 'object';
}

export function refuseType(value, name, expected) {
  throw new TypeError(`${name}: ${shown(value)}, expected ${expected}`);
}

/** The option of long calls. */
export const PROGRESS = { progress: () => true };

/** What an option must be whose default has this type. Others are checked where they are used. */
const EXPECTED = { boolean: 'true or false', function: 'a function' };

/** `given` with the defaults of what it leaves out. Other options are refused, or a misspelt one would do nothing. */
export function withDefaults(given, defaults) {
  if (typeof given !== 'object' || given === null) throw new TypeError(`options: ${String(given)}, expected an object`);
  const options = { ...defaults };
  for (const name of Object.keys(given)) {
    if (!Object.hasOwn(defaults, name)) refuseOption(name, Object.keys(defaults));
    const [value, type] = [given[name], typeof defaults[name]];
    if (value === undefined || (value === null && type === 'function')) continue; // null means none
    if (type in EXPECTED && typeof value !== type) refuseType(value, name, EXPECTED[type]);
    options[name] = value;
  }
  return options;
}

/** The place of `value` in `choices`. */
export function choose(choices, value, name) {
  const place = choices.indexOf(value);
  if (place >= 0) return place;
  const expected = choices.map((choice) => `'${choice}'`).join(', ');
  throw new MeshhoodError('InvalidOption', `${name}: ${shown(value)}, expected one of ${expected}`);
}

/** The places of one name, or of several. */
export function chooseSome(choices, values, name) {
  const list = typeof values === 'string' ? [values] : values;
  if (!Array.isArray(list)) refuseType(list, name, 'a name or an array of names');
  return Uint8Array.from(list, (value) => choose(choices, value, name));
}

/** The getter of a property, as no object can replace it. */
const getter = (prototype, property) => Object.getOwnPropertyDescriptor(prototype, property).get;

const [typeOf, bufferOf, offsetOf, lengthOf] = [Symbol.toStringTag, 'buffer', 'byteOffset', 'length'].map(
  (property) => getter(TYPED_ARRAY.prototype, property));
const bytesOfBuffer = getter(ArrayBuffer.prototype, 'byteLength'); // throws if it is called for anything else

/** A typed array on the memory of `value`: `place` returns its buffer, offset and length. */
function viewOf(Type, value, name, place) {
  try {
    return new Type(...place());
  } catch (error) {
    throw new TypeError(`${name}: a detached ${shown(value)}, expected one with its memory`, { cause: error });
  }
}

/**
 * The numbers of a typed array, without a copy, as one whose type and length are true: those that a subclass or a Proxy
 * tells may not be. It may be of another realm, as of an iframe, which has types of its own with the same names.
 */
function plainArray(value, name, expected, isExpected) {
  const type = typeOf.call(value);
  if (type === undefined || !isExpected(type)) refuseType(value, name, expected);
  const place = () => [bufferOf.call(value), offsetOf.call(value), lengthOf.call(value)];
  return viewOf(globalThis[type], value, name, place);
}

export function expectType(value, types, name) {
  const names = types.map((type) => type.name);
  return plainArray(value, name, names.join(' or '), (type) => names.includes(type));
}

function isBuffer(value) {
  try {
    bytesOfBuffer.call(value);
    return true;
  } catch {
    return false;
  }
}

const PLACE = ['buffer', 'byteOffset', 'byteLength'];

/** The bytes of a buffer or of a view of one. */
export function expectBytes(value, name) {
  if (isBuffer(value)) return viewOf(Uint8Array, value, name, () => [value]);
  if (!ArrayBuffer.isView(value)) refuseType(value, name, 'an ArrayBuffer or a typed array');
  const { prototype } = typeOf.call(value) === undefined ? DataView : TYPED_ARRAY;
  return viewOf(Uint8Array, value, name, () => PLACE.map((property) => getter(prototype, property).call(value)));
}

/** One number for each vertex. The module would take an array of length 0 as none. */
export function expectForVertices(values, name, count) {
  if (values.length === count) return values;
  throw new MeshhoodError('InvalidOption',
    `${name}: ${values.length} values, expected one for each of ${count} vertices`);
}

export function expectString(value, name) {
  if (typeof value !== 'string') refuseType(value, name, 'a string');
}

/** Returns the vertex. `count` is that of the mesh. */
export function expectVertex(v, count) {
  if (!Number.isInteger(v)) throw new TypeError(`vertex ${shown(v)}, expected a whole number`);
  if (v >= 0 && v < count) return v;
  throw new MeshhoodError('VertexOutOfRange', `vertex ${v}, but the mesh has ${count} vertices`);
}

export function expectVertices(vertices, name) {
  return vertices === null ? null : expectType(vertices, [Uint32Array], name);
}

export function expectNumber(value, name) {
  if (typeof value !== 'number') throw new TypeError(`${name} ${shown(value)}, expected a number`);
}

/** By default, what the module takes: sizes have 32 bits there. */
export function expectSize(value, name, most = 2 ** 32 - 1) {
  if (!Number.isInteger(value) || value < 0) refuseType(value, name, 'a whole number >= 0');
  if (value > most) throw new MeshhoodError('InvalidOption', `${name}: ${value}, expected at most ${most}`);
}

/** The three numbers of a point. A typed array of integers would be a list of vertices. */
export function expectPoint(point, name, expected = 'three numbers') {
  if (!Array.isArray(point) && !['Float64Array', 'Float32Array'].includes(typeOf.call(point))) {
    refuseType(point, name, expected);
  }
  if (point.length !== 3) throw new TypeError(`${name}: ${point.length} values, expected ${expected}`);
  const coordinates = [point[0], point[1], point[2]]; // an iterator may give others
  for (const coordinate of coordinates) expectNumber(coordinate, `${name}: coordinate`);
  return coordinates;
}

/** Any typed array of numbers, as one of 64 bits. */
export function toReals(values, name, expected = 'a typed array of numbers') {
  const numbers = plainArray(values, name, expected, (type) => !type.startsWith('Big'));
  return numbers instanceof Float64Array ? numbers : Float64Array.from(numbers);
}

const INDICES = [Uint32Array, Int32Array, Uint16Array];

/** The module takes indices of 32 bits. */
function widened(indices) {
  return indices instanceof Uint16Array ? Uint32Array.from(indices) : indices;
}

/** Null for triangles. The module would take an array of length 0 as null. */
function readOffsets(given) {
  if (given === null) return null;
  const offsets = expectType(given, INDICES, 'offsets');
  if (offsets.length > 0) return offsets;
  throw new MeshhoodError('InvalidMesh', 'offsets: no values, expected one for each face and one more');
}

/** Calls `use` while these faces are those of a call; null are those that the index holds. */
export function withFaces(instance, faces, use) {
  if (faces === null) {
    if (instance.call('take_held_faces')) return use();
    throw new MeshhoodError('InvalidOption', 'faces: expected the faces of the mesh, which this index does not have');
  }
  if (typeof faces !== 'object' || !('corners' in faces)) refuseType(faces, 'faces', 'an object with corners');
  const corners = expectType(faces.corners, INDICES, 'corners');
  const offsets = readOffsets(faces.offsets ?? null);
  return instance.with([widened(corners), widened(offsets)], (ids, begins) => {
    instance.call('take_faces', ids, corners.length, corners instanceof Int32Array, begins, offsets?.length ?? 0,
      offsets instanceof Int32Array);
    return use();
  });
}

/** The same for positions. */
export function withPositions(instance, given, use) {
  const positions = expectType(given, [Float32Array, Float64Array], 'positions');
  return instance.with([positions], (xyz) => {
    instance.call('take_positions', xyz, positions.length, positions instanceof Float64Array);
    return use();
  });
}

export function withMesh(instance, positions, faces, use) {
  return withPositions(instance, positions, () => withFaces(instance, faces, use));
}
