// One solid by itself, with its numbers, and the offer of a second one.
import type { MeshFormat } from 'dymsum';
import { useEffect, useMemo } from 'preact/hooks';
import { useAnswer } from '../../engine/use_answer';
import { short } from '../../numbers/display';
import { ShapeRow } from '../../operands/shape_row';
import { Readouts, Section, Toggle } from '../../shell/controls';
import type { Change, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { Results } from '../../shell/results';
import { useReport } from '../../shell/use_report';
import { useTheme } from '../../shell/theme';
import { boxOf, Placement } from '../../view3d/placement';
import { SpacePicture } from '../../view3d/space_picture';
import { kSolids } from './catalogue';
import { aloneOverlay, aloneSurface, kOperandColours } from './pictures';
import { kThinHint, type AloneState, type SolidsPageState } from './state';
import { useSolid } from './use_solids';

interface AloneProps {
  state: AloneState;
  change: Change<SolidsPageState>;
  shell: Shell;
}

const kFormats = ['glb', 'stl', 'off', 'obj', 'ply'] as const satisfies MeshFormat[];

function useDownloads({ engine, setDownloads }: Shell, { p: shape, thin }: AloneState, isThere: boolean): void {
  useEffect(() => {
    const formats = isThere ? kFormats : [];
    setDownloads(formats.map((format) => ({ label: `Solid (${format.toUpperCase()})`, fileName: `solid.${format}`, make: () => engine.ask('solidAloneFile', { shape, thin, format }) })));
  }, [engine, setDownloads, shape, thin, isThere]);
}

export function AloneView({ state, change, shell }: AloneProps) {
  const { p: shape, thin } = state, solid = useSolid(shell, shape, thin), ready = solid !== undefined && !solid.error, theme = useTheme();
  const numbers = useAnswer(shell.engine, 'solidAlone', ready ? { shape, thin } : undefined);
  useReport(shell, numbers.error);
  useDownloads(shell, state, ready);
  const placement = useMemo(() => solid && Placement.inSight(boxOf(solid.vertices)), [solid]);
  const surface = useMemo(() => (solid && placement ? aloneSurface(solid, placement) : undefined), [solid, placement]);
  const overlay = useMemo(() => (solid && placement ? aloneOverlay(solid, placement) : {}), [solid, placement, theme]); // eslint-disable-line react-hooks/exhaustive-deps -- colours are the theme's
  const known = ready && numbers.of?.shape === shape && numbers.of.thin === thin ? numbers.value : undefined, summary = `${shape.name} by itself.`;
  return (
    <>
      <Stage>
        <SpacePicture label={`${summary} ${known ? `${known.vertices} vertices, ${known.faces} faces` : ''}`} shape={surface} colours={kOperandColours} opacity={state.through ? 0.5 : 1} overlay={overlay} />
      </Stage>
      <Panel summary={summary}>
        <Section title="Solids">
          <ShapeRow role="P" tint="p" label="Solid P" catalogue={kSolids} shape={shape} size={solid && solid.faceStarts.length - 1} onShape={(p) => change({ ...state, p })} />
          <ShapeRow role="Q" tint="q" label="Solid Q" catalogue={kSolids} shape={null} onShape={(q) => change({ ...state, q })} />
          <Toggle label="Parts of files without volume count, too" hint={kThinHint} value={thin} onChange={(to) => change({ ...state, thin: to })} />
        </Section>
        <Section title="Solid">
          <Results {...numbers} refused={solid?.error !== undefined}>
            <Readouts rows={[['Vertices, faces', known && `${known.vertices}, ${known.faces}`], ['Shells', known?.shells], ['Volume', known && short(known.volume)], ['Surface', known && short(known.area)]]} />
          </Results>
          <Toggle label="See through" hint="Draws the solid half transparent." value={state.through} onChange={(through) => change({ ...state, through })} />
        </Section>
      </Panel>
    </>
  );
}
