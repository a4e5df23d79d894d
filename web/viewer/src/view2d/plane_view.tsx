// A picture of the plane that can be moved, zoomed and touched.
import { useEffect, useLayoutEffect, useMemo, useRef } from 'preact/hooks';
import { useTheme } from '../shell/theme';
import { paintBackdrop } from './backdrop';
import { fitted, type Box, type Camera, type Size } from './camera';
import { Gestures, type Target } from './gestures';
import { Painter } from './painter';

interface PlaneViewProps extends Partial<Pick<Target, 'grip' | 'hover' | 'click' | 'nudge'>> {
  /** what is to be seen, for those who do not see it */
  label: string;
  /** what fits into the picture at first, whenever `homeKey` changes, and when the reader asks for it */
  home: Box | undefined;
  homeKey: string;
  /** where the picture looks at first, instead */
  camera?: Camera | undefined;
  /** the reader has looked elsewhere */
  onCamera?: (camera: Camera) => void;
  cursor?: string;
  /** what is drawn is that of an older question: it is greyed where that lasts */
  stale?: boolean;
  /** what is computed and drawn now: tests read off the canvas how often it has changed */
  shows?: unknown;
  paint: (painter: Painter) => void;
}

const kSettleMs = 300;

/** What lasts from one rendering to the next. */
class Picture {
  canvas: HTMLCanvasElement | null = null;
  size: Size = { width: 0, height: 0 };
  camera: Camera | undefined;
  fittedTo: string | undefined;
  props!: PlaneViewProps;
  private scheduled = 0;
  private settling = 0;
  private shown: unknown;
  private changes = 0;
  private frames = 0;

  /** Paints once before the screen shows the next picture. */
  again(): void {
    this.scheduled ||= requestAnimationFrame(() => {
      this.scheduled = 0;
      this.paint();
    });
  }

  fit(): void {
    const { home } = this.props;
    if (home && this.size.width > 0) this.camera = fitted(home, this.size);
    this.again();
  }

  look(camera: Camera): void {
    this.camera = camera;
    clearTimeout(this.settling);
    this.settling = window.setTimeout(() => this.props.onCamera?.(camera), kSettleMs);
    this.again();
  }

  resize(): void {
    if (!this.canvas) return;
    const { width, height } = this.canvas.getBoundingClientRect(), ratio = devicePixelRatio;
    this.size = { width, height };
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.paint();
  }

  private paint(): void {
    const ctx = this.canvas?.getContext('2d', { alpha: false });
    if (!ctx) return;
    if (this.fittedTo !== this.props.homeKey && this.props.home && this.size.width > 0) { // without a size nothing can be fitted
      if (this.fittedTo !== undefined || !this.camera) this.fit();
      this.fittedTo = this.props.homeKey;
    }
    ctx.setTransform(devicePixelRatio, 0, 0, devicePixelRatio, 0, 0);
    ctx.fillStyle = getComputedStyle(document.documentElement).getPropertyValue('--ground');
    ctx.fillRect(0, 0, this.size.width, this.size.height);
    if (!this.camera) return;
    const painter = new Painter(ctx, this.camera, this.size);
    paintBackdrop(painter);
    this.props.paint(painter);
    this.tell(this.camera);
  }

  private tell({ x, y, zoom }: Camera): void {
    const data = this.canvas!.dataset;
    data.frame = String(++this.frames);
    data.camera = `${x} ${y} ${zoom}`;
    if (this.props.shows === undefined || this.props.shows === this.shown) return;
    this.shown = this.props.shows;
    data.shown = String(++this.changes);
  }
}

export function PlaneView(props: PlaneViewProps) {
  const picture = useMemo(() => new Picture(), []);
  picture.props = props;
  const canvas = useRef<HTMLCanvasElement>(null);
  const theme = useTheme();
  useEffect(() => {
    picture.canvas = canvas.current;
    picture.camera = picture.props.camera;
    new Gestures(canvas.current!, {
      camera: () => picture.camera ?? { x: 0, y: 0, zoom: 1 },
      setCamera: (camera) => picture.look(camera),
      size: () => picture.size,
      fit: () => picture.fit(),
      grip: (at, reach) => picture.props.grip?.(at, reach),
      hover: (at, reach) => picture.props.hover?.(at, reach),
      click: (at, reach) => picture.props.click?.(at, reach),
      nudge: (by) => picture.props.nudge?.(by),
    });
    const observer = new ResizeObserver(() => picture.resize());
    observer.observe(canvas.current!);
    return () => observer.disconnect();
  }, [picture]);
  useLayoutEffect(() => picture.again(), [picture, props.paint, props.home, props.homeKey, theme]);
  return <canvas ref={canvas} class={props.stale ? 'plane stale' : 'plane'} tabIndex={0} role="img" aria-label={props.label} style={{ cursor: props.cursor ?? 'grab' }} />;
}
