// SPDX-License-Identifier: MIT
// The additional numbers of the vertices of a PLY file, for colors. The reader of the library, which keeps positions and
// faces only, has accepted the file before, so that nothing is checked here.

import type { Scalar } from './scalar';

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
const MOST = 1000; // properties to choose from
const NOT_SCALARS = new Set(['x', 'y', 'z', 'nx', 'ny', 'nz', 'red', 'green', 'blue', 'alpha']);

interface Property {
  title: string;
  type: string;
  /** Of the number of values, if it is a list. */
  countType?: string;
  isRequired: boolean; // other lists are empty if the line of their row is over
  /** Empty unless they are wanted: what is written to them is dropped then. */
  values: Float32Array | Float64Array;
}

interface Header {
  format: string;
  elements: { name: string; rows: number; properties: Property[] }[];
  /** Of the first byte after the header. */
  end: number;
}

/** What separates words, for the reader of the library. Others, such as a no-break space, belong to words. */
const BLANKS = /[ \t\v\f\r\n]+/;

function readHeader(bytes: Uint8Array): Header {
  const [lf, cr] = [10, 13];
  // As the reader of the library does: all lines end as the first one. A CR before an LF counts as a blank.
  const first = bytes.findIndex((byte) => byte === lf || byte === cr);
  const lineEnd = bytes[first] === cr && bytes[first + 1] !== lf ? cr : lf;
  const header: Header = { format: '', elements: [], end: 0 };
  for (let words: string[] = []; words[0] !== 'end_header'; ) {
    const line = bytes.subarray(header.end, bytes.indexOf(lineEnd, header.end) + 1 || bytes.length);
    header.end += line.length;
    words = new TextDecoder().decode(line).split(BLANKS).filter((word) => word !== '');
    if (words[0] === 'format') header.format = words[1];
    if (words[0] === 'element') header.elements.push({ name: words[1], rows: Number(words[2]), properties: [] });
    if (words[0] !== 'property') continue;
    const { name, rows, properties } = header.elements.at(-1)!;
    const [type, countType] = words.slice(1, -1).reverse().map((word) => OTHER_NAMES[word] ?? word);
    const title = words.at(-1)!;
    const isRequired = properties.length === 0 || /^(face|tristrips) vertex_ind(ices|ex)$/.test(`${name} ${title}`);
    const isWanted = name === 'vertex' && countType === undefined && properties.length < MOST && !NOT_SCALARS.has(title);
    const Reals = type === 'float64' ? Float64Array : Float32Array; // a float could not hold all doubles
    properties.push({ title, type, countType, isRequired, values: new Reals(isWanted ? rows : 0) });
  }
  return header;
}

/** `warnings` are those of the reader. */
export function readPlyScalars(bytes: Uint8Array, warnings: string[]): Scalar[] {
  const { format, elements, end } = readHeader(bytes);
  const last = elements.findIndex(({ name }) => name === 'vertex');
  const scalars = elements[last].properties.filter(({ values }) => values.length > 0);
  if (scalars.length === 0) return [];
  const body = bytes.subarray(end);
  const numbers = format === 'ascii' ? textNumbers(body, warnings) : binaryNumbers(body, format === 'binary_little_endian');
  for (const { rows, properties } of elements.slice(0, last + 1)) {
    for (let row = 0; row < rows && properties.length > 0; ++row) {
      for (const { type, countType, isRequired, values } of properties) {
        if (countType === undefined) values[row] = numbers.next(type);
        else if (isRequired || !numbers.isLineOver()) {
          for (let left = numbers.next(countType); left > 0; --left) numbers.next(type);
        }
      }
      numbers.endRow();
    }
  }
  return scalars;
}

/** The numbers of the rows, one after the other. */
interface Numbers {
  next(type: string): number;
  /** Then the list that would be next is empty. */
  isLineOver(): boolean;
  endRow(): void;
}

function textNumbers(bytes: Uint8Array, warnings: string[]): Numbers {
  // Otherwise rows may run over lines and share them, and there are no further numbers.
  const areLines = warnings.some((warning) => warning.includes('lines with more numbers than the header declares'));
  const text = new TextDecoder('latin1').decode(bytes);
  const words = /([^ \t\v\f\r\n]+)[ \t\v\f]*([\r\n])?/g;
  let isOver = false;
  const next = () => {
    const [, word, lineEnd] = words.exec(text)!;
    isOver = lineEnd !== undefined || words.lastIndex === text.length;
    return Number(word);
  };
  return { next, isLineOver: () => isOver, endRow: () => { while (areLines && !isOver) next(); } };
}

function binaryNumbers(bytes: Uint8Array, isLittle: boolean): Numbers {
  const data = new DataView(bytes.buffer, bytes.byteOffset);
  let at = 0;
  const next = (type: string) => {
    const [size, read] = TYPES[type];
    at += size;
    return read(data, at - size, isLittle);
  };
  return { next, isLineOver: () => false, endRow: () => {} };
}
