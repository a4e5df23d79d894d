// A picture of space on a page: one surface, what is drawn over it, and the camera.
import type { ComponentChildren } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';
import { colour, useTheme } from '../shell/theme';
import type { Overlay } from './overlay';
import { Surface, type SurfaceShape } from './surface';
import { SpaceView, type Grip, type Hit } from './view';
import './space_picture.css';

interface SpacePictureProps {
  /** what is to be seen, for those who do not see it */
  label: string;
  shape: SurfaceShape | undefined;
  /** the surface is that of an older question: it is greyed where that lasts */
  stale?: boolean;
  /** custom properties of the theme, one for each kind of triangle */
  colours: readonly string[];
  opacity: number;
  /** the height of the picture above which nothing is drawn */
  cut?: number | undefined;
  overlay: Overlay;
  onHover?: (hit: Hit | undefined) => void;
  onPick?: (hit: Hit | undefined) => void;
  grip?: (hit: Hit) => Grip | undefined;
  /** over the picture */
  children?: ComponentChildren;
}

interface Made {
  view: SpaceView;
  surface: Surface;
}

export function SpacePicture(props: SpacePictureProps) {
  const { shape, colours, opacity, cut, overlay } = props;
  const container = useRef<HTMLDivElement>(null), newest = useRef(props), theme = useTheme();
  newest.current = props;
  const [made, setMade] = useState<Made | undefined>();
  const [refusal, setRefusal] = useState('');
  const kinds = colours.length;
  useEffect(() => {
    try {
      const view = new SpaceView(container.current!, {
        onHover: (hit) => newest.current.onHover?.(hit),
        onPick: (hit) => newest.current.onPick?.(hit),
        grip: (hit) => newest.current.grip?.(hit),
      });
      const surface = new Surface(kinds);
      view.add(surface);
      setMade({ view, surface });
      return () => view.dispose();
    } catch (error) {
      setRefusal(`This browser draws no pictures of space (WebGL): ${String(error)}`);
      return undefined;
    }
  }, [kinds]);
  useEffect(() => {
    if (!made) return;
    made.surface.setShape(shape);
    made.view.request();
  }, [made, shape]);
  const names = colours.join();
  useEffect(() => {
    if (!made) return;
    made.surface.setLook({ colours: names.split(',').map(colour), edge: colour('--text'), inside: colour('--inside-face'), opacity });
    made.view.setGround(colour('--ground'));
  }, [made, names, opacity, theme]);
  useEffect(() => {
    if (!made) return;
    made.surface.cutAbove(cut);
    made.view.request();
  }, [made, cut]);
  useEffect(() => made?.view.setOverlay(overlay), [made, overlay]);
  return (
    <div ref={container} class={props.stale ? 'space stale' : 'space'} tabIndex={0} role="img" aria-label={props.label}>
      {refusal && <p class="refusal">{refusal}</p>}
      {props.children}
    </div>
  );
}
