// A picture of space: surfaces, a camera that is turned by hand, and an overlay. It is drawn when something changes, and
// only then; `dispose` gives the memory of the graphics card back.
import { Color, DirectionalLight, HemisphereLight, PerspectiveCamera, Plane, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { turnByKey } from './keys';
import { drawOverlay, type Overlay } from './overlay';
import type { Surface } from './surface';

export interface Hit {
  surface: Surface;
  triangle: number;
  /** from the camera */
  distance: number;
  /** of the pointer, from the upper left corner of the picture */
  x: number;
  y: number;
}
export interface ViewEvents {
  /** what lies under the pointer, nothing where it leaves */
  onHover?: (hit: Hit | undefined) => void;
  onPick?: (hit: Hit | undefined) => void;
  /** what is dragged instead of the camera; nothing for what does not move */
  grip?: (hit: Hit) => Grip | undefined;
}
/** Something that is dragged, always as far from the reader as where it was gripped. */
export interface Grip {
  /** how far from where it was, in the coordinates of the picture */
  drag: (x: number, y: number, z: number) => void;
  drop: () => void;
}

const kFrom = new Vector3(2.3, -3.4, 2.5); // seen from the front, the right and above
const kClickPixels = 4;

let byProcessor: boolean | undefined;

/** No graphics card, or none that the browser uses. Asked once. */
function isDrawnByProcessor(): boolean {
  if (byProcessor === undefined) {
    const probe = document.createElement('canvas').getContext('webgl2', { failIfMajorPerformanceCaveat: true });
    byProcessor = probe === null;
    probe?.getExtension('WEBGL_lose_context')?.loseContext();
  }
  return byProcessor;
}

export class SpaceView {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(32, 1, 0.05, 100);
  private readonly renderer;
  private readonly overlayCanvas = document.createElement('canvas');
  private readonly controls;
  private readonly ray = new Raycaster();
  private readonly surfaces = new Set<Surface>();
  private readonly sizes = new ResizeObserver(() => this.resize());
  private readonly leaving = new AbortController();
  private overlay: Overlay = {};
  private halo = '#fff';
  private frame = 0;
  private stale = false;
  private pointer: { x: number; y: number } | undefined;
  private pressed: { x: number; y: number } | undefined;
  private held: { grip: Grip; from: Vector3; plane: Plane } | undefined;

  /** Throws where the browser draws nothing in space. */
  constructor(
    private readonly container: HTMLElement,
    private readonly events: ViewEvents = {},
  ) {
    this.renderer = new WebGLRenderer({ antialias: !isDrawnByProcessor() }); // else every picture takes several times as long
    this.renderer.localClippingEnabled = true;
    const canvas = this.renderer.domElement;
    Object.assign(this.overlayCanvas.style, { position: 'absolute', inset: '0', pointerEvents: 'none', width: '100%', height: '100%' });
    Object.assign(canvas.style, { position: 'absolute', inset: '0', width: '100%', height: '100%' });
    container.prepend(canvas, this.overlayCanvas); // below what the page lays over the picture
    this.camera.up.set(0, 0, 1);
    this.scene.add(this.camera, new HemisphereLight(0xffffff, 0x8899aa, 2.3));
    const lamp = new DirectionalLight(0xffffff, 1.3);
    lamp.position.set(-1, 1.6, 1.2);
    this.camera.add(lamp, lamp.target); // shines from behind the reader's left shoulder
    lamp.target.position.set(0, 0, -1);
    this.listen(canvas); // before the controls: what is gripped is not theirs
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { minDistance: 0.5, maxDistance: 30 });
    this.controls.addEventListener('change', () => this.request());
    this.fit();
    this.sizes.observe(container);
    this.resize();
  }

  add(surface: Surface): void {
    this.surfaces.add(surface);
    this.scene.add(surface.group);
    this.request();
  }

  /** Draws all again before the browser's next frame. */
  request(): void {
    this.stale = true;
    this.frame ||= requestAnimationFrame(this.draw);
  }

  /** Draws only the overlay again: cheap, whatever the surfaces are. */
  setOverlay(overlay: Overlay): void {
    this.overlay = overlay;
    this.frame ||= requestAnimationFrame(this.draw);
  }

  setGround(colour: string): void {
    this.scene.background = new Color(colour);
    this.halo = colour;
    this.request();
  }

  /** The camera as at first. */
  fit(): void {
    const { width, height } = this.container.getBoundingClientRect();
    const narrow = width > 0 && height > width ? (height / width) ** 0.75 : 1;
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(kFrom).multiplyScalar(narrow);
    this.controls.update();
    this.request();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.leaving.abort();
    this.sizes.disconnect();
    this.controls.dispose();
    for (const surface of this.surfaces) surface.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.renderer.domElement.remove();
    this.overlayCanvas.remove();
  }

  private readonly draw = (): void => {
    this.frame = 0;
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    if (this.stale) {
      this.stale = false;
      this.renderer.render(this.scene, this.camera);
      this.count('frames');
    }
    const draw = this.overlayCanvas.getContext('2d')!;
    const ratio = this.overlayCanvas.width / width;
    draw.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawOverlay(draw, this.overlay, this.camera, width, height, this.halo);
    this.count('overlays');
    this.hover();
  };

  /** Pictures drawn, and what the graphics card holds, as data of the element: tests look at it. */
  private count(what: 'frames' | 'overlays'): void {
    const { dataset } = this.container;
    dataset[what] = String(Number(dataset[what] ?? 0) + 1);
    dataset.geometries = String(this.renderer.info.memory.geometries);
    dataset.triangles = String(this.renderer.info.render.triangles);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(devicePixelRatio, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    Object.assign(this.overlayCanvas, { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.request();
  }

  private listen(canvas: HTMLCanvasElement): void {
    const { signal } = this.leaving;
    const at = (e: PointerEvent): { x: number; y: number } => ({ x: e.offsetX, y: e.offsetY });
    canvas.addEventListener('pointerdown', (e) => {
      this.pressed = at(e);
      if (e.isPrimary && e.button === 0) this.take(this.pressed);
      if (this.held) canvas.setPointerCapture(e.pointerId);
    }, { signal });
    canvas.addEventListener('pointermove', (e) => {
      if (this.held) return this.drag(at(e));
      this.pointer = e.buttons === 0 ? at(e) : undefined;
      if (this.pointer && this.events.onHover) this.frame ||= requestAnimationFrame(this.draw);
    }, { signal });
    canvas.addEventListener('pointerleave', () => {
      this.pointer = undefined;
      this.events.onHover?.(undefined);
    }, { signal });
    const letGo = (): void => {
      this.held?.grip.drop();
      this.held = undefined;
      this.controls.enabled = true;
    };
    canvas.addEventListener('pointercancel', letGo, { signal });
    canvas.addEventListener('pointerup', (e) => {
      letGo();
      const from = this.pressed, to = at(e);
      if (from && Math.hypot(to.x - from.x, to.y - from.y) <= kClickPixels) this.events.onPick?.(this.hitAt(to.x, to.y));
    }, { signal });
    this.container.addEventListener('keydown', (e) => {
      if (turnByKey(e.key, this.camera, this.controls.target, () => this.fit())) {
        e.preventDefault();
        this.controls.update();
        this.request();
      }
    }, { signal });
  }

  private take(at: { x: number; y: number }): void {
    const hit = this.events.grip && this.hitAt(at.x, at.y), grip = hit && this.events.grip?.(hit);
    if (!grip) return;
    const from = this.ray.ray.at(hit.distance, new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new Vector3()), from);
    this.held = { grip, from, plane };
    this.controls.enabled = false;
  }

  private drag({ x, y }: { x: number; y: number }): void {
    const { grip, from, plane } = this.held!;
    this.aim(x, y);
    const to = this.ray.ray.intersectPlane(plane, new Vector3());
    if (to) grip.drag(to.x - from.x, to.y - from.y, to.z - from.z);
  }

  private hover(): void {
    if (this.pointer && this.events.onHover) this.events.onHover(this.hitAt(this.pointer.x, this.pointer.y));
    this.pointer = undefined;
  }

  private aim(x: number, y: number): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    this.ray.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.camera);
  }

  private hitAt(x: number, y: number): Hit | undefined {
    this.aim(x, y);
    let nearest: Hit | undefined;
    for (const surface of this.surfaces) {
      const hit = surface.pick(this.ray);
      if (hit && (!nearest || hit.distance < nearest.distance)) nearest = { surface, x, y, ...hit };
    }
    return nearest;
  }
}
