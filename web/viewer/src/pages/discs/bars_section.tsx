// The barcode, the bar that is looked at, and cuts at what lasts.
import { short } from '../../numbers/display';
import { Choice, NumberField, Readouts, Section, Slider, Toggle } from '../../shell/controls';
import { ExactText } from '../../shell/exact_text';
import type { PageProps } from '../../shell/page';
import { Results } from '../../shell/results';
import { alphaOf } from './alpha_section';
import { Barcode, lifeOf, reachOf, significanceOf } from './barcode';
import { checkLength, kConcavities, type DiscState } from './state';
import type { DiscData } from './use_discs';

type BarsProps = PageProps<DiscState> & { data: DiscData };

function ChosenBar({ state, data, shell }: BarsProps) {
  const chosen = data.bars.find(([k]) => k === state.bar)?.[1], { texts } = data;
  if (!chosen || !texts) return null;
  const born = chosen.born === 'corner' ? `at the corner of vertex ${chosen.vertex}` : 'in a neck';
  return (
    <>
      <p style={{ margin: '6px 0' }}>{`Born ${born}, ${chosen.died === 'never' ? 'never dies' : `${chosen.died} at ${short(chosen.deathAlpha)}`}.`}</p>
      <ExactText label="the exact birth" text={`birth: ${texts.birth}`} shell={shell} />
      <ExactText label="the exact death" text={`death: ${texts.death}`} shell={shell} />
    </>
  );
}

/** Which lives count, and how deep pockets are. */
function Counting({ state, change }: BarsProps) {
  const { concavity } = state, tolerance = String(state.hybridTolerance);
  return (
    <>
      <Choice label="How deep pockets are" options={kConcavities} value={concavity} onChange={(to) => change({ ...state, concavity: to, bar: null })} />
      {concavity === 'hybrid2' && (
        <NumberField label="pockets no deeper by shortest paths" value={tolerance} check={checkLength} onCommit={(text) => change({ ...state, hybridTolerance: alphaOf({ alpha: text }) })} />
      )}
      <div class="fields">
        <NumberField label="lives from α" value={state.alphaFrom} check={checkLength} onCommit={(alphaFrom) => change({ ...state, alphaFrom })} />
        <NumberField label="up to α" value={state.alphaTo} check={(text) => (text === '' ? undefined : checkLength(text))} onCommit={(alphaTo) => change({ ...state, alphaTo })} />
      </div>
    </>
  );
}

export function BarsSection(props: BarsProps) {
  const { state, change, data } = props, { bars, barCount, cuts } = data, within = { from: state.alphaFrom, to: state.alphaTo };
  const persistence = alphaOf({ alpha: state.persistence }), longest = Math.max(0, ...bars.map(([, b]) => significanceOf(b, within)).filter(Number.isFinite));
  const most = Math.max(longest * 1.05 || reachOf(bars), persistence);
  const to = (value: number, how: 'live' | 'done'): void => change({ ...state, cuts: true, persistence: String(value) }, how);
  return (
    <Section title={`Barcode: ${bars.length < barCount ? `the longest ${bars.length} of ` : ''}${barCount} bars`}>
      <Results {...data.barsStanding}>{null}</Results>
      <Barcode
        bars={bars} alpha={alphaOf(state)} chosen={state.bar} onChoose={(bar) => change({ ...state, bar })}
        isKept={(bar) => (state.cuts ? significanceOf(bar, within) : lifeOf(bar, within)) >= persistence}
      />
      <ChosenBar {...props} />
      <Toggle
        label="discs that touch twice, and their bridges" hint="Discs of this diameter that touch the shape on two sides, and the lines between where they touch."
        value={state.bridges} onChange={(bridges) => change({ ...state, bridges })}
      />
      <Toggle label="cuts" hint="Cuts the shape at the pockets whose bars are long enough, and tints the pieces." value={state.cuts} onChange={(on) => change({ ...state, cuts: on })} />
      <Slider
        label="at pockets that last and are deep, at least τ" value={persistence} min={0} max={most} step={10 ** Math.floor(Math.log10(most / 500))} text={short(persistence)}
        onInput={(v) => to(v, 'live')} onDone={(v) => to(v, 'done')}
      />
      <Counting {...props} />
      {state.cuts && cuts && <Readouts rows={[['cuts', cuts.cuts.length], ['pieces', cuts.areas.length]]} />}
    </Section>
  );
}
