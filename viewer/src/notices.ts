// SPDX-License-Identifier: MIT
// What the page says over the picture: what is being done, an error, how to begin, what was done.

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

/** Shows a message until it is closed, or null is shown. */
const showIn = (id: 'error' | 'warning') => (message: string | null): void => {
  const notice = document.getElementById(id)!;
  notice.hidden = message === null;
  notice.querySelector('p')!.textContent = message;
};
export const showError = showIn('error');
/** What the page accepted, but may not be as it was meant. */
export const showWarning = showIn('warning');

let refusal: string | null = null;
/** Shows why an input is refused, until one is accepted: null. Any other error stays. */
export function showRefusal(reason: string | null): void {
  if (reason !== null || document.querySelector('#error p')!.textContent === refusal) showError(reason);
  refusal = reason;
}

const hint = () => document.getElementById('hint')!;
let timer = 0;

/** Says something for some seconds. */
export function say(message: string): void {
  hint().textContent = message;
  hint().classList.remove('done');
  clearTimeout(timer);
  timer = window.setTimeout(hideHint, 4000);
}

export function hideHint(): void {
  hint().classList.add('done');
}

export function connectNotices(): void {
  document.querySelector('#error button')!.addEventListener('click', () => showError(null));
  document.querySelector('#warning button')!.addEventListener('click', () => showWarning(null));
}
