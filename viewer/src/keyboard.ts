// SPDX-License-Identifier: MIT

/** Whether a control needs a key itself. A checkbox or a button takes only what presses it, a slider what moves it. */
function isTaken(key: string, target: HTMLElement): boolean {
  if (target.closest('dialog') !== null) return true;
  if (target.matches('input[type="checkbox"], button, summary')) return key === ' ' || key === 'Enter';
  if (target.matches('input[type="range"]')) return /^(Arrow|Page|Home|End)/.test(key);
  return target.matches('input, select, textarea');
}

/** Calls `actions[key]` for keys that no control takes; with Shift, `actions['Shift+Arrow...']` for the arrows. */
export function connectKeyboard(actions: Record<string, () => void>): void {
  document.addEventListener('keydown', (event) => {
    const { key } = event;
    if (event.ctrlKey || event.metaKey || event.altKey || isTaken(key, event.target as HTMLElement)) return;
    const name = key.length === 1 ? key.toLowerCase() : `${event.shiftKey ? 'Shift+' : ''}${key}`;
    const action = actions[name];
    if (action === undefined) return;
    event.preventDefault();
    action();
  });
}
