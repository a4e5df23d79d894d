// One region by itself, with its numbers, and the offer of a second one.
import type { RegionFormat } from 'dymsum';
import { useEffect } from 'preact/hooks';
import { useAnswer } from '../../engine/use_answer';
import { shortText } from '../../numbers/display';
import { kCatalogue } from '../../operands/catalogue';
import { OperandCard } from '../../operands/operand_card';
import { ShapeRow } from '../../operands/shape_row';
import { useOperand } from '../../operands/use_operand';
import { Readouts, Section } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { Change, Shell } from '../../shell/page';
import { Panel, Stage } from '../../shell/parts';
import { Results } from '../../shell/results';
import { useReport } from '../../shell/use_report';
import { colour } from '../../shell/theme';
import { PlaneView } from '../../view2d/plane_view';
import { NestingOffer } from '../nesting/offer';
import type { AloneState, SumPageState } from './state';

interface AloneProps {
  state: AloneState;
  change: Change<SumPageState>;
  shell: Shell;
}

const kFiles = { svg: 'Picture (SVG)', wkt: 'Shape (WKT)', geojson: 'Shape (GeoJSON)', poly: 'Shape (.poly)' } as const satisfies Partial<Record<RegionFormat, string>>;

function useDownloads({ engine, setDownloads }: Shell, { p }: AloneState, isThere: boolean): void {
  useEffect(() => {
    const formats = isThere ? (Object.keys(kFiles) as (keyof typeof kFiles)[]) : [];
    setDownloads(formats.map((format) => ({ label: kFiles[format], fileName: `shape.${format}`, make: () => engine.ask('regionFile', { shape: p, format }) })));
  }, [engine, setDownloads, p, isThere]);
}

export function AloneView({ state, change, shell }: AloneProps) {
  const operand = useOperand(shell, state.p), { outline, error } = operand;
  const numbers = useAnswer(shell.engine, 'regionNumbers', operand.ready ? { shape: state.p } : undefined);
  useReport(shell, numbers.error);
  useDownloads(shell, state, operand.ready);
  const known = numbers.of?.shape === state.p && !error ? numbers.value : undefined, { x, y } = error?.evidence ?? {};
  const summary = `${state.p.name} by itself.`;
  return (
    <>
      <Stage>
        <PlaneView
          label={`${summary} ${known ? `${known.vertices} vertices, ${known.holes} holes` : ''}`} home={outline?.box} homeKey={operand.of?.name ?? ''} camera={state.camera}
          onCamera={(camera) => change({ ...state, camera }, 'aside')} shows={outline}
          paint={(painter) => {
            outline?.paint(painter, colour('--p-fill'), { colour: colour('--p'), width: 1.5 });
            if (x !== undefined && y !== undefined) painter.wrong({ x, y }, colour('--error'));
          }}
        />
      </Stage>
      <Panel summary={summary}>
        <Section title="Shapes">
          <OperandCard shell={shell} role="P" tint="p" shape={state.p} operand={operand} onShape={(p) => change({ ...state, p })} />
          <NestingOffer shape={state.p} error={error} shell={shell} />
          <ShapeRow role="Q" tint="q" label="Shape of Q" catalogue={kCatalogue} shape={null} onShape={(q) => change({ ...state, q })} />
        </Section>
        <Section title="Shape">
          <Results {...numbers} refused={error !== undefined}>
            <Readouts rows={[['parts', known?.parts], ['holes', known?.holes], ['vertices', known?.vertices], ['area', known && shortText(known.area)]]} />
            {known?.exact && <ExactText label="the exact area" text={known.exact} shell={shell} />}
          </Results>
        </Section>
      </Panel>
    </>
  );
}
