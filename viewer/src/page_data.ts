// SPDX-License-Identifier: MIT
// The data that `meshhood view` and `meshhood.view` have written into the page: a mesh file and settings.
import type { Scalar } from './scalar';

export interface Settings {
  /** The name of the mesh file. */
  name: string;
  vertex?: number;
  radius?: number;
  /** Of the radius: `mesh` is that of the positions, and the default; `edge` is the mean edge length. */
  unit?: 'mesh' | 'edge';
  /** An answer to show as it is, instead of those of the methods. */
  ids?: number[];
  /** Join vertices at most this far apart; they keep their numbers. */
  weld?: number;
  /** Of the positions; otherwise that of the file. */
  precision?: 'float' | 'double';
  /** A value for each vertex: float32, little-endian, in base 64. */
  scalar?: { title: string; values: string };
}

export interface PageData {
  settings: Settings;
  file: Blob;
  scalar: Scalar | null;
}

function decode(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Null for the page as it is built. */
export function takePageData(): PageData | null {
  const settingsElement = document.getElementById('meshhood-settings');
  const meshElement = document.getElementById('meshhood-mesh');
  if (settingsElement === null || meshElement === null) return null;
  const settings = JSON.parse(settingsElement.textContent ?? '') as Settings;
  const file = new Blob([decode((meshElement.textContent ?? '').trim())]);
  meshElement.remove(); // its text is no longer needed, and large
  const { scalar = null } = settings;
  return { settings, file, scalar: scalar && { ...scalar, values: new Float32Array(decode(scalar.values).buffer) } };
}
