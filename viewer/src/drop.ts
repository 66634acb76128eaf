// SPDX-License-Identifier: MIT

/** Calls `open` with a file that is dropped onto the page. */
export function connectDrop(open: (file: File) => void): void {
  const drop = document.getElementById('drop')!;
  window.addEventListener('dragover', (event) => {
    event.preventDefault();
    drop.hidden = !event.dataTransfer?.types.includes('Files'); // not of a text
  });
  window.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) drop.hidden = true;
  });
  window.addEventListener('drop', (event) => {
    event.preventDefault();
    drop.hidden = true;
    const file = event.dataTransfer?.files[0];
    if (file) open(file);
  });
}
