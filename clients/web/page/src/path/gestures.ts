// Moves the camera of a view by pointer, wheel and keys.
import { orbit, pan, zoom, type Camera } from "./camera";

/** The view that gestures move. */
export interface Viewer {
  camera: Camera;
  readonly is3D: boolean;
  fit(): void;
}

const WHEEL = 0.0016; // of the logarithm of the scale, for each pixel of the wheel
const ORBIT = 0.008; // radians for each pixel
const KEY_PIXELS = 40;

function fromMiddle(element: HTMLElement, x: number, y: number): [number, number] {
  const box = element.getBoundingClientRect();
  return [x - box.left - box.width / 2, box.top + box.height / 2 - y];
}

function dragged(view: Viewer, dx: number, dy: number, isPan: boolean): Camera {
  return isPan ? pan(view.camera, dx, -dy) : orbit(view.camera, -dx * ORBIT, dy * ORBIT);
}

/** One finger or button drags or turns the view; two fingers drag and zoom it. */
function pointers(element: HTMLElement, view: Viewer): void {
  const down = new Map<number, { x: number; y: number }>();
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  element.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (before === undefined) return;
    const now = { x: event.clientX, y: event.clientY };
    const other = [...down.entries()].find(([id]) => id !== event.pointerId)?.[1];
    if (other === undefined) {
      const isPan = !view.is3D || event.shiftKey || (event.buttons & 6) !== 0;
      view.camera = dragged(view, now.x - before.x, now.y - before.y, isPan);
    } else {
      const spread = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
      const middle = fromMiddle(element, (now.x + other.x) / 2, (now.y + other.y) / 2);
      const moved = pan(view.camera, (now.x - before.x) / 2, (before.y - now.y) / 2);
      view.camera = zoom(moved, spread(now) / Math.max(1, spread(before)), ...middle);
    }
    down.set(event.pointerId, now);
  });
  for (const end of ["pointerup", "pointercancel"] as const) {
    element.addEventListener(end, (event) => down.delete(event.pointerId));
  }
}

const ARROWS: Record<string, readonly [number, number]> = {
  ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1],
};

function keys(element: HTMLElement, view: Viewer): void {
  element.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (arrow !== undefined) {
      view.camera = dragged(view, arrow[0] * KEY_PIXELS, arrow[1] * KEY_PIXELS, !view.is3D || event.shiftKey);
    } else if (event.key === "+" || event.key === "=") view.camera = zoom(view.camera, 1.25, 0, 0);
    else if (event.key === "-") view.camera = zoom(view.camera, 0.8, 0, 0);
    else if (event.key === "0") view.fit();
    else return;
    event.preventDefault();
  });
}

export function attachGestures(element: HTMLElement, view: Viewer): void {
  pointers(element, view);
  keys(element, view);
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 * event.deltaY : event.deltaY;
    view.camera = zoom(view.camera, Math.exp(-pixels * WHEEL), ...fromMiddle(element, event.clientX, event.clientY));
  }, { passive: false });
  element.addEventListener("contextmenu", (event) => event.preventDefault());
}
