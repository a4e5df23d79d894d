// What pointers, wheel and keys do to a picture: pan, zoom, drag what is gripped, hover, click. Two fingers pinch.
import { moved, toPlane, zoomed, type Camera, type Point, type Size } from './camera';

/** Something that is dragged. Places are those of the plane. */
export interface Grip {
  drag: (from: Point, to: Point) => void;
  /** `to` is nothing where the drag was given up. */
  drop: (from: Point, to: Point | undefined) => void;
}

/** What a picture tells and takes. `reach`: how near is near enough, in the plane. */
export interface Target {
  camera: () => Camera;
  setCamera: (camera: Camera) => void;
  size: () => Size;
  fit: () => void;
  grip: (at: Point, reach: number) => Grip | undefined;
  hover: (at: Point | undefined, reach: number) => void;
  click: (at: Point, reach: number) => void;
  /** what is dragged most moves by so much, by keys */
  nudge: (by: Point) => void;
}

const kReachPixels = { mouse: 8, touch: 20, pen: 12 } as Record<string, number>;
const kClickPixels = 4;

export class Gestures {
  private pointers = new Map<number, Point>();
  private grip: Grip | undefined;
  private from: Point | undefined;
  private start: Point = { x: 0, y: 0 };
  private isClick = false;

  constructor(
    private element: HTMLElement,
    private target: Target,
  ) {
    const on = <K extends keyof HTMLElementEventMap>(type: K, does: (e: HTMLElementEventMap[K]) => void): void =>
      element.addEventListener(type, does, { passive: false });
    on('pointerdown', (e) => this.down(e));
    on('pointermove', (e) => this.move(e));
    on('pointerup', (e) => this.up(e));
    on('pointercancel', (e) => this.end(e, true));
    on('pointerleave', () => target.hover(undefined, 0));
    on('wheel', (e) => this.wheel(e));
    on('keydown', (e) => this.key(e));
    on('dblclick', () => target.fit());
  }

  private place(e: MouseEvent): Point {
    const box = this.element.getBoundingClientRect();
    return { x: e.clientX - box.left, y: e.clientY - box.top };
  }
  private plane(at: Point): Point {
    return toPlane(this.target.camera(), this.target.size(), at);
  }
  private reach(e: PointerEvent): number {
    return (kReachPixels[e.pointerType] ?? 8) / this.target.camera().zoom;
  }

  private down(e: PointerEvent): void {
    const at = this.place(e);
    this.element.setPointerCapture(e.pointerId);
    this.pointers.set(e.pointerId, at);
    if (this.pointers.size > 1) return this.letGo(undefined);
    this.start = at;
    this.isClick = true;
    this.from = this.plane(at);
    this.grip = e.button === 0 ? this.target.grip(this.from, this.reach(e)) : undefined;
  }

  private move(e: PointerEvent): void {
    const at = this.place(e), last = this.pointers.get(e.pointerId);
    if (!last) return this.target.hover(this.plane(at), this.reach(e));
    this.pointers.set(e.pointerId, at);
    if (Math.hypot(at.x - this.start.x, at.y - this.start.y) > kClickPixels) this.isClick = false;
    if (this.pointers.size === 2) return this.pinch(e.pointerId, last, at);
    if (this.isClick) return;
    if (this.grip) this.grip.drag(this.from!, this.plane(at));
    else this.target.setCamera(moved(this.target.camera(), at.x - last.x, at.y - last.y));
  }

  private pinch(moving: number, last: Point, now: Point): void {
    const other = [...this.pointers].find(([id]) => id !== moving)![1];
    const far = (p: Point): number => Math.max(1, Math.hypot(p.x - other.x, p.y - other.y));
    const camera = moved(this.target.camera(), (now.x - last.x) / 2, (now.y - last.y) / 2);
    const middle = { x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 };
    this.target.setCamera(zoomed(camera, this.target.size(), middle, far(now) / far(last)));
  }

  private up(e: PointerEvent): void {
    const at = this.plane(this.place(e));
    if (this.isClick && this.pointers.size === 1) {
      this.target.click(at, this.reach(e));
      this.grip = undefined;
    }
    this.end(e, false);
  }

  private end(e: PointerEvent, givenUp: boolean): void {
    this.pointers.delete(e.pointerId);
    this.letGo(givenUp ? undefined : this.plane(this.place(e)));
  }

  private letGo(to: Point | undefined): void {
    if (this.grip && !this.isClick) this.grip.drop(this.from!, to);
    this.grip = undefined;
  }

  private wheel(e: WheelEvent): void {
    e.preventDefault();
    const pixels = e.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 * e.deltaY : e.deltaY;
    this.target.setCamera(zoomed(this.target.camera(), this.target.size(), this.place(e), Math.exp(-pixels * (e.ctrlKey ? 0.01 : 0.0015))));
  }

  private key(e: KeyboardEvent): void {
    if (e.altKey) return this.nudge(e);
    const { camera, setCamera, size, fit } = this.target, step = e.shiftKey ? 120 : 30;
    const middle = { x: size().width / 2, y: size().height / 2 };
    const does = {
      ArrowLeft: () => setCamera(moved(camera(), step, 0)),
      ArrowRight: () => setCamera(moved(camera(), -step, 0)),
      ArrowUp: () => setCamera(moved(camera(), 0, step)),
      ArrowDown: () => setCamera(moved(camera(), 0, -step)),
      '+': () => setCamera(zoomed(camera(), size(), middle, 1.2)),
      '=': () => setCamera(zoomed(camera(), size(), middle, 1.2)),
      '-': () => setCamera(zoomed(camera(), size(), middle, 1 / 1.2)),
      '0': fit,
    }[e.key];
    if (!does || e.ctrlKey || e.metaKey) return;
    e.preventDefault();
    does();
  }

  private nudge(e: KeyboardEvent): void {
    const step = (e.shiftKey ? 40 : 8) / this.target.camera().zoom;
    const by = { ArrowLeft: { x: -step, y: 0 }, ArrowRight: { x: step, y: 0 }, ArrowUp: { x: 0, y: step }, ArrowDown: { x: 0, y: -step } }[e.key];
    if (!by) return;
    e.preventDefault();
    this.target.nudge(by);
  }
}
