// SPDX-License-Identifier: MIT
// What the page says over the picture: what is being done, an error, how to begin.

/** The line at the bottom: what is being done. */
export function showProgress(stage: string | null, fraction: number | null = null): void {
  const status = document.getElementById('status')!;
  status.hidden = stage === null;
  if (stage === null) return;
  status.querySelector('span')!.textContent = stage;
  const bar = status.querySelector<HTMLElement>('.bar')!;
  bar.classList.toggle('endless', fraction === null);
  (bar.firstElementChild as HTMLElement).style.width = fraction === null ? '' : `${100 * fraction}%`;
}

/** Until it is closed, or null is shown. */
export function showError(message: string | null): void {
  const error = document.getElementById('error')!;
  error.hidden = message === null;
  error.querySelector('p')!.textContent = message;
}

export function hideHint(): void {
  document.getElementById('hint')!.classList.add('done');
}

export function connectNotices(): void {
  document.querySelector('#error button')!.addEventListener('click', () => showError(null));
}
