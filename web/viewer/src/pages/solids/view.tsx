import { useEffect, useMemo, useState } from 'preact/hooks';
import { shapeOfFile, type Shape } from '../../engine/shape';
import { snapped } from '../../numbers/snap';
import { Section } from '../../shell/controls';
import { chooseFiles } from '../../shell/files';
import type { Download, PageProps, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { useTheme } from '../../shell/theme';
import { SpacePicture } from '../../view3d/space_picture';
import type { Grip, Hit } from '../../view3d/view';
import { kSolids } from './catalogue';
import { contactOf, contactText, kindText } from './faces';
import { DepthSection, FaceSection, SliceSection, SumSection } from './facts_section';
import { MotionSection } from './motion_section';
import { kFaceColours, kOperandColours, operandsOverlay, operandsSurface, sumOverlay, sumSurface } from './pictures';
import { placedQ } from './placing';
import type { SolidOperand } from './service';
import type { SolidsState, Triple } from './state';
import { useSolids, type SolidsData } from './use_solids';
import '../obstacle/obstacle.css';

export const kSummary = 'Solids of any shape and their sum, exactly, while Q turns and is scaled. Drag Q; hover over the sum to see which features made a face.';

const kFiles = { glb: 'Sum (GLB)', stl: 'Sum (STL)', off: 'Sum (OFF)', json: 'Sum, exact (JSON)' } as const;

function useDownloads({ engine, setDownloads }: Shell, { args, frame }: SolidsData): void {
  const isThere = frame !== undefined;
  useEffect(() => {
    const download = (format: keyof typeof kFiles): Download => ({
      label: kFiles[format], fileName: `sum.${format}`, make: () => engine.ask('solidFile', { args, format }),
    });
    setDownloads(isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]).map(download) : []);
  }, [engine, setDownloads, args, isThere]);
}

function SolidCard({ role, tint, shape, operand, onShape }: { role: string; tint: string; shape: Shape; operand: SolidOperand | undefined; onShape: (shape: Shape) => void }) {
  const known = kSolids.some((s) => s.name === shape.name);
  const choose = (name: string): void => {
    const chosen = kSolids.find((s) => s.name === name);
    if (chosen) onShape(chosen);
  };
  return (
    <div class="row">
      <span style={{ color: `var(--${tint})` }} aria-hidden="true">■</span>
      <strong>{role}</strong>
      <select aria-label={`Solid ${role}`} value={known ? shape.name : ''} onChange={(e) => choose(e.currentTarget.value)} style={{ flex: 1, minWidth: 0 }}>
        {!known && <option value="">{shape.name}</option>}
        {kSolids.map(({ name }) => <option key={name}>{name}</option>)}
      </select>
      <span class="quiet">{operand && operand.faceStarts.length - 1}</span>
      <button aria-label={`Open a file as ${role}`} onClick={() => chooseFiles((files) => onShape(shapeOfFile(files[0]!)))}>Open…</button>
    </div>
  );
}

export function View({ state, change, shell }: PageProps<SolidsState>) {
  const data = useSolids(shell, state), { p, q, placement, frame, depth } = data, theme = useTheme();
  const [hovered, setHovered] = useState<number | undefined>(), [chosen, setChosen] = useState<number | undefined>();
  useEffect(() => {
    setHovered(undefined);
    setChosen(undefined);
  }, [frame]);
  useDownloads(shell, data);
  const { axis, angle, scale, at } = state, atX = at[0], atY = at[1], atZ = at[2];
  const moved = useMemo(() => q && placedQ({ ...state, axis, angle, scale, at }, q.vertices), [q, axis, angle, scale, atX, atY, atZ]); // eslint-disable-line react-hooks/exhaustive-deps -- all that it reads of the state
  const operands = useMemo(() => (p && q && moved && placement ? operandsSurface(p, q, moved, placement) : undefined), [p, q, moved, placement]);
  const sum = useMemo(() => (frame && placement ? sumSurface(frame, placement, state.changes) : undefined), [frame, placement, state.changes]);
  const face = hovered ?? chosen;
  const marked = useMemo(() => (frame && face !== undefined ? { frame, face } : undefined), [frame, face]);
  const left = useMemo(
    () => (p && q && moved && placement ? operandsOverlay(p, q, moved, placement, marked, depth, at) : {}),
    [p, q, moved, placement, marked, depth, at, theme], // eslint-disable-line react-hooks/exhaustive-deps -- colours are the theme's
  );
  const right = useMemo(
    () => (frame && placement ? sumOverlay(frame, placement, { slice: state.slice, face, depth, at: state.sum === 'hits' ? at : undefined }) : {}),
    [frame, placement, state.slice, face, depth, at, state.sum, theme], // eslint-disable-line react-hooks/exhaustive-deps -- colours are the theme's
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
            <SpacePicture label={`${state.p.name} and ${state.q.name} where they stand`} shape={operands} colours={kOperandColours} opacity={state.sum === 'hits' ? 0.6 : 1} overlay={left} grip={grip}>
              <span class="caption">P and Q</span>
            </SpacePicture>
          </div>
          <div>
            <SpacePicture
              label={`The sum: ${frame ? `${frame.vertexCount} vertices, ${frame.faceCount} faces` : 'not known yet'}`} shape={sum} colours={kFaceColours}
              opacity={state.through ? 0.5 : 1} cut={state.slice !== null && placement ? placement.height(state.slice) : undefined} overlay={right}
              onHover={(hit) => setHovered(faceAt(hit))} onPick={(hit) => setChosen(faceAt(hit))}
            >
              <span class="caption">{state.sum === 'sum' ? 'P ⊕ Q' : 'P ⊕ −Q: where Q hits P'}</span>
              <div class="status">{named && `${kindText(named)}: ${contactText(named)}`}</div>
            </SpacePicture>
          </div>
        </div>
      </Stage>
      <Panel summary={kSummary}>
        <Section title="Solids">
          <SolidCard role="P" tint="p" shape={state.p} operand={p} onShape={(shape) => change({ ...state, p: shape })} />
          <SolidCard role="Q" tint="q" shape={state.q} operand={q} onShape={(shape) => change({ ...state, q: shape })} />
        </Section>
        <MotionSection state={state} change={change} />
        <DepthSection {...facts} />
        <SumSection {...facts} />
        <SliceSection {...facts} />
        <FaceSection {...facts} face={chosen} />
      </Panel>
    </>
  );
}
