import { useEffect, useMemo, useState } from 'preact/hooks';
import { snapped } from '../../numbers/snap';
import { ShapeRow } from '../../operands/shape_row';
import { Section, Toggle } from '../../shell/controls';
import type { Download, PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { useTheme } from '../../shell/theme';
import { SpacePicture } from '../../view3d/space_picture';
import type { Grip, Hit } from '../../view3d/view';
import { AloneView } from './alone_view';
import { kSolids } from './catalogue';
import { contactOf, contactText, kindText } from './faces';
import { DepthSection, FaceSection, LookSection, SliceSection, SumSection } from './facts_section';
import { MotionSection, SetSection } from './motion_section';
import { kFaceColours, kOperandColours, operandsOverlay, operandsSurface, sumOverlay, sumSurface, type StandingSolid } from './pictures';
import { placed, placementOfPart } from './placing';
import type { SolidOperand } from './service';
import { isPair, kThinHint, type SolidsPageState, type SolidsState, type Triple } from './state';
import { useSolids, type SolidsData } from './use_solids';
import '../obstacle/obstacle.css';

export const kSummary = 'Solids of any shape and their sum, exactly, while one of them turns and is scaled. Drag Q; hover over the sum to see which features made a face.';

const kFiles = { glb: ' (GLB)', stl: ' (STL)', off: ' (OFF)', json: ', exact (JSON)' } as const;
const kCaptions = { sum: 'P ⊕ Q', hits: 'P ⊕ −Q: where Q hits P', fit: 'Where Q fits in P' } as const;

function useDownloads({ engine, setDownloads }: Shell, { args, frame }: SolidsData): void {
  const isThere = frame !== undefined && frame.vertexCount > 0;
  useEffect(() => {
    const download = (format: keyof typeof kFiles): Download => ({
      label: `${args.sum === 'fit' ? 'Fit' : 'Sum'}${kFiles[format]}`, fileName: `${args.sum === 'fit' ? 'fit' : 'sum'}.${format}`, make: () => engine.ask('solidFile', { args, format }),
    });
    setDownloads(isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]).map(download) : []);
  }, [engine, setDownloads, args, isThere]);
}

function useStanding(state: SolidsState, which: 'p' | 'q', solid: SolidOperand | undefined): StandingSolid | undefined {
  const { moving, axis, angle, scale, at } = state, moves = moving === which || which === 'q';
  const stands = useMemo(() => ({ moving, axis, angle, scale, at }), moves ? [moving, axis, angle, scale, at] : [moving]); // eslint-disable-line react-hooks/exhaustive-deps -- what stays does not follow what moves
  return useMemo(() => solid && { solid, vertices: placed(stands, which, solid.vertices) }, [stands, which, solid]);
}

function PairView({ state, change, shell }: PageProps<SolidsState> & { change: PageProps<SolidsPageState>['change'] }) {
  const data = useSolids(shell, state), { p, q, placement, frame, depth } = data, theme = useTheme();
  const [hovered, setHovered] = useState<number | undefined>(), [chosen, setChosen] = useState<number | undefined>();
  useEffect(() => {
    setHovered(undefined);
    setChosen(undefined);
  }, [frame]);
  useDownloads(shell, data);
  const { at, look } = state, standingP = useStanding(state, 'p', p), standingQ = useStanding(state, 'q', q);
  const operands = useMemo(() => (standingP && standingQ && placement ? operandsSurface(standingP, standingQ, placement) : undefined), [standingP, standingQ, placement]);
  const view = useMemo(() => (look ? placementOfPart(look) : placement), [look, placement]);
  const sum = useMemo(() => (frame && view ? sumSurface(frame, view, state.changes) : undefined), [frame, view, state.changes]);
  const face = hovered ?? chosen;
  const marked = useMemo(() => (frame && face !== undefined ? { frame, face } : undefined), [frame, face]);
  const left = useMemo(
    () => (standingP && standingQ && placement ? operandsOverlay(standingP, standingQ, placement, marked, depth, at) : {}),
    [standingP, standingQ, placement, marked, depth, at, theme], // eslint-disable-line react-hooks/exhaustive-deps -- colours are the theme's
  );
  const right = useMemo(
    () => (frame && view ? sumOverlay(frame, view, { slice: state.slice, face, depth, look, at: state.sum === 'sum' ? undefined : at }) : {}),
    [frame, view, state.slice, face, depth, look, at, state.sum, theme], // eslint-disable-line react-hooks/exhaustive-deps -- colours are the theme's
  );
  const faceAt = (hit: Hit | undefined): number | undefined => hit && frame?.faceOf[hit.triangle];
  const grip = (hit: Hit): Grip | undefined => {
    if (!p || !placement || hit.triangle < p.triangles.length / 3) return undefined;
    let last = at;
    const origin = placement.back(0, 0, 0);
    const drag = (x: number, y: number, z: number): void => {
      const by = placement.back(x, y, z);
      last = at.map((was, k) => snapped(was + by[k]! - origin[k]!, 0.02 * Math.hypot(...placement.back(1, 0, 0).map((w, i) => w - origin[i]!)))) as unknown as Triple;
      change({ ...state, at: last }, 'live');
    };
    return { drag, drop: () => last !== at && change({ ...state, at: last }) };
  };
  const named = face !== undefined && frame ? contactOf(frame.contacts, face) : undefined;
  const facts = { state, change, data, shell };
  return (
    <>
      <Stage>
        <div class="pair">
          <div>
            <SpacePicture label={`${state.p.name} and ${state.q.name} where they stand`} shape={operands} colours={kOperandColours} opacity={state.sum === 'sum' ? 1 : 0.6} overlay={left} grip={grip}>
              <span class="caption">P and Q</span>
            </SpacePicture>
          </div>
          <div>
            <SpacePicture
              label={`${state.sum === 'fit' ? 'The inner fit' : 'The sum'}: ${frame ? `${frame.vertexCount} vertices, ${frame.faceCount} faces` : 'not known yet'}`} shape={sum} colours={kFaceColours}
              opacity={state.through ? 0.5 : 1} cut={state.slice !== null && view ? view.height(state.slice) : undefined} overlay={right} stale={data.standing.waiting}
              onHover={(hit) => setHovered(faceAt(hit))} onPick={(hit) => setChosen(faceAt(hit))}
            >
              <span class="caption">{kCaptions[state.sum]}</span>
              <div class="status">{named && `${kindText(named)}: ${contactText(named)}`}</div>
            </SpacePicture>
          </div>
        </div>
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Solids">
          <ShapeRow role="P" tint="p" label="Solid P" catalogue={kSolids} shape={state.p} size={p && p.faceStarts.length - 1} onShape={(shape) => change({ ...state, p: shape })} />
          <ShapeRow
            role="Q" tint="q" label="Solid Q" catalogue={kSolids} shape={state.q} size={q && q.faceStarts.length - 1}
            onShape={(shape) => change({ ...state, q: shape })} onNone={() => change({ ...state, q: null })}
          />
          <Toggle label="Parts of files without volume count, too" hint={kThinHint} value={state.thin} onChange={(thin) => change({ ...state, thin })} />
        </Section>
        <SetSection state={state} change={change} />
        <DepthSection {...facts} />
        <SumSection {...facts} />
        <MotionSection state={state} change={change} />
        <SliceSection {...facts} />
        <FaceSection {...facts} face={chosen} />
        <LookSection state={state} change={change} />
      </Panel>
    </>
  );
}

export function View({ state, ...props }: PageProps<SolidsPageState>) {
  return isPair(state) ? <PairView {...props} state={state} /> : <AloneView {...props} state={state} />;
}
