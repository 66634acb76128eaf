// SPDX-License-Identifier: MIT

/** Calls `actions[key]` for keys that no control takes. */
export function connectKeyboard(actions: Record<string, () => void>): void {
  document.addEventListener('keydown', (event) => {
    const target = event.target as HTMLElement;
    const isControl = target.matches('input, select, textarea, button, summary, dialog, dialog *');
    if (event.ctrlKey || event.metaKey || event.altKey || isControl) return;
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (action === undefined) return;
    event.preventDefault();
    action();
  });
}
