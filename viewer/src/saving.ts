// SPDX-License-Identifier: MIT
// What the page gives to the browser as files. Their names are made from that of the mesh.
import { showError } from './notices';
import type { View } from './view';

function download(content: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The name of a mesh file without its folder and its extension. */
function stem(name: string): string {
  return name.replace(/^.*[/\\]/, '').replace(/\.[^.]*$/, '') || 'mesh';
}

export async function savePicture(view: View, mesh: string): Promise<void> {
  const background = getComputedStyle(document.body).getPropertyValue('--background').trim();
  const picture = await view.picture(background);
  if (picture === null) showError('The browser could not make the picture.');
  else download(picture, `${stem(mesh)}.png`);
}

/** The ids of the answer for `vertex`, as `meshhood query` prints them. */
export function saveIds(ids: Uint32Array, vertex: number, mesh: string): void {
  download(new Blob([...ids].map((id) => `${id}\n`), { type: 'text/plain' }), `${stem(mesh)}-${vertex}.txt`);
}

export function saveIndex(bytes: Uint8Array<ArrayBuffer>, mesh: string): void {
  download(new Blob([bytes]), `${stem(mesh)}.mhi`);
}
