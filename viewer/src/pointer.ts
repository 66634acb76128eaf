// SPDX-License-Identifier: MIT
// Mouse, pen and finger: a click chooses a vertex, and so does a drag that begins at the marker or with Shift. All other
// drags turn the mesh.
import type { View } from './view';

/** Pixels that a click may move; and from the marker, within which a drag takes it along. */
const CLICK = 5;
const REACH = { mouse: 16, touch: 30 };

export function connectPointer(canvas: HTMLCanvasElement, view: View, choose: (vertex: number, isFinal: boolean) => void): void {
  let begin: { x: number; y: number } | null = null;
  let moved = false;
  let takesMarker = false;

  const place = (event: PointerEvent) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  const isAtMarker = (event: PointerEvent) => {
    const { x, y } = place(event);
    return view.isNearMarker(x, y, event.pointerType === 'touch' ? REACH.touch : REACH.mouse);
  };
  const chooseAt = (event: PointerEvent, isFinal: boolean) => {
    const { x, y } = place(event);
    const vertex = view.pick(x, y);
    if (vertex !== null) choose(vertex, isFinal);
  };

  canvas.addEventListener('pointerdown', (event) => {
    if (!event.isPrimary || event.button !== 0) {
      begin = null;
      return;
    }
    begin = place(event);
    moved = false;
    takesMarker = event.shiftKey || isAtMarker(event);
    view.controls.enabled = !takesMarker;
    if (takesMarker) canvas.setPointerCapture(event.pointerId);
    canvas.classList.toggle('dragging', !takesMarker);
    canvas.focus({ preventScroll: true });
  }, { capture: true });

  canvas.addEventListener('pointermove', (event) => {
    if (!event.isPrimary) return;
    if (begin === null) {
      canvas.classList.toggle('marker', event.shiftKey || isAtMarker(event));
      return;
    }
    const { x, y } = place(event);
    moved ||= Math.hypot(x - begin.x, y - begin.y) > CLICK;
    if (takesMarker && moved) chooseAt(event, false);
  });

  const end = () => {
    begin = null;
    view.controls.enabled = true;
    canvas.classList.remove('dragging');
  };
  canvas.addEventListener('pointerup', (event) => {
    if (!event.isPrimary) return;
    if (begin !== null && (takesMarker || !moved)) chooseAt(event, true);
    end();
  });
  canvas.addEventListener('pointercancel', end);
}
