// SPDX-License-Identifier: MIT
// The additional numbers of the vertices of a PLY file, for colors. The reader of the library, which keeps positions and
// faces only, has accepted the file before, so that nothing is checked here.

export interface PlyScalar {
  name: string;
  /** In double where the file has doubles, which a float could not hold. */
  values: Float32Array | Float64Array;
}

type Read = (data: DataView, at: number, littleEndian: boolean) => number;

const TYPES: Record<string, [bytes: number, read: Read]> = {
  int8: [1, (data, at) => data.getInt8(at)],
  uint8: [1, (data, at) => data.getUint8(at)],
  int16: [2, (data, at, little) => data.getInt16(at, little)],
  uint16: [2, (data, at, little) => data.getUint16(at, little)],
  int32: [4, (data, at, little) => data.getInt32(at, little)],
  uint32: [4, (data, at, little) => data.getUint32(at, little)],
  float32: [4, (data, at, little) => data.getFloat32(at, little)],
  float64: [8, (data, at, little) => data.getFloat64(at, little)],
};
const OTHER_NAMES: Record<string, string> = {
  char: 'int8', uchar: 'uint8', short: 'int16', ushort: 'uint16', int: 'int32', uint: 'uint32', float: 'float32',
  double: 'float64',
};
const NOT_SCALARS = new Set(['x', 'y', 'z', 'nx', 'ny', 'nz', 'red', 'green', 'blue', 'alpha']);

interface Layout {
  format: string;
  vertices: number;
  properties: { name: string; type: string }[];
  /** Of the first byte after the header. */
  begin: number;
}

/** What separates words, for the reader of the library. Others, such as a no-break space, belong to words. */
const BLANKS = /[ \t\v\f\r\n]+/;

/** The lines of the header as words, and where it ends. Null if it is longer than what is decoded here. */
function readHeader(bytes: Uint8Array): { lines: string[][]; end: number } | null {
  const head = new TextDecoder('latin1').decode(bytes.subarray(0, 1 << 16));
  // As the reader of the library does: all lines end as the first one. A CR before an LF counts as a blank.
  const first = /\r\n|\r|\n/.exec(head)?.[0];
  const lineEnd = first === '\r' ? '\r' : '\n';
  const lines: string[][] = [];
  for (let begin = 0, end; (end = head.indexOf(lineEnd, begin)) >= 0; begin = end + 1) {
    const words = head.slice(begin, end).split(BLANKS).filter((word) => word !== '');
    if (words[0] === 'end_header') return { lines, end: end + 1 };
    lines.push(words);
  }
  return null;
}

/** Null unless the vertices come first and have no lists. */
function readLayout(bytes: Uint8Array): Layout | null {
  const header = readHeader(bytes);
  if (header === null) return null;
  const { lines } = header;
  const format = lines.find(([word]) => word === 'format')?.[1] ?? '';
  const elements = lines.flatMap(([word], i) => (word === 'element' ? [i] : []));
  const [, name, count] = lines[elements[0]] ?? [];
  if (name !== 'vertex') return null;
  const own = lines.slice(elements[0] + 1, elements[1]).filter(([word]) => word === 'property');
  if (own.some(([, type]) => type === 'list')) return null;
  const properties = own.map(([, type, property]) => ({ name: property, type: OTHER_NAMES[type] ?? type }));
  return { format, vertices: Number(count), properties, begin: header.end };
}

export function readPlyScalars(bytes: Uint8Array): PlyScalar[] {
  const layout = readLayout(bytes);
  const wanted = layout?.properties.some(({ name }) => !NOT_SCALARS.has(name));
  if (layout === null || !wanted) return [];
  const columns = layout.properties.map(({ name, type }) => {
    const Reals = type === 'float64' ? Float64Array : Float32Array;
    return { name, values: new Reals(layout.vertices) };
  });
  if (layout.format === 'ascii') readText(bytes, layout, columns);
  else readBinary(bytes, layout, columns);
  return columns.filter(({ name }) => !NOT_SCALARS.has(name));
}

function readText(bytes: Uint8Array, layout: Layout, columns: PlyScalar[]): void {
  const words = new TextDecoder('latin1').decode(bytes.subarray(layout.begin)).matchAll(/[^ \t\v\f\r\n]+/g);
  for (let row = 0; row < layout.vertices; ++row) {
    for (const { values } of columns) values[row] = Number(words.next().value?.[0]);
  }
}

function readBinary(bytes: Uint8Array, layout: Layout, columns: PlyScalar[]): void {
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const isLittle = layout.format === 'binary_little_endian';
  let at = layout.begin;
  for (let row = 0; row < layout.vertices; ++row) {
    columns.forEach(({ values }, i) => {
      const [size, read] = TYPES[layout.properties[i].type];
      values[row] = read(data, at, isLittle);
      at += size;
    });
  }
}
