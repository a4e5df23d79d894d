// The controls that panels are made of. Each is a native input with a label, so keyboard and screen readers have it.
import type { ComponentChildren } from 'preact';
import { useId, useLayoutEffect, useRef, useState } from 'preact/hooks';
import { PlayButton } from './play_button';

export function Section({ title, children }: { title: string; children: ComponentChildren }) {
  return (
    <section class="section" aria-label={title}>
      <h2>{title}</h2>
      {children}
    </section>
  );
}

export interface Tick {
  at: number;
  /** stands out */
  strong: boolean;
  label: string;
}

interface SliderProps {
  label: string;
  value: number;
  min: number;
  max: number;
  step: number | 'any';
  /** what is shown of the value */
  text?: string;
  ticks?: readonly Tick[];
  onInput: (value: number) => void;
  /** the thumb was let go */
  onDone: (value: number) => void;
  /** with a button that moves it to and fro */
  plays?: boolean;
}

export function Slider(props: SliderProps) {
  const { label, value, min, max, step, text, ticks, onInput, onDone, plays } = props, id = useId();
  const read = (event: Event): number => (event.currentTarget as HTMLInputElement).valueAsNumber;
  return (
    <div class="field">
      <div class="label">
        <label for={id}>{label}</label>
        <output for={id}>{text ?? String(value)}</output>
      </div>
      {plays && <PlayButton {...props} />}
      {ticks && <Ticks ticks={ticks} min={min} max={max} />}
      <input
        id={id} type="range" min={min} max={max} step={step} value={value} aria-valuetext={text}
        onInput={(e) => onInput(read(e))} onChange={(e) => onDone(read(e))}
      />
    </div>
  );
}

function Ticks({ ticks, min, max }: { ticks: readonly Tick[]; min: number; max: number }) {
  const inside = ticks.filter((t) => t.at >= min && t.at <= max);
  return (
    <div class="ticks" aria-hidden="true">
      {inside.map((t) => (
        <i key={t.label} class={t.strong ? 'strong' : ''} title={t.label} style={{ left: `${(100 * (t.at - min)) / (max - min)}%` }} />
      ))}
    </div>
  );
}

/** What is chosen, its name, and a sentence that says what it is. */
export type Option<T extends string> = readonly [T, string, string];

interface ChoiceProps<T extends string> {
  label: string;
  options: readonly Option<T>[];
  value: T;
  onChange: (value: T) => void;
}

export function Choice<T extends string>({ label, options, value, onChange }: ChoiceProps<T>) {
  const name = useId();
  return (
    <div class="choice" role="radiogroup" aria-label={label}>
      {options.map(([key, text, hint]) => (
        <label key={key} title={hint}>
          <input type="radio" name={name} value={key} checked={key === value} onChange={() => onChange(key)} />
          {text}
        </label>
      ))}
    </div>
  );
}

interface ToggleProps {
  label: string;
  /** a sentence that says what it does */
  hint: string;
  value: boolean;
  onChange: (value: boolean) => void;
  /** how what it shows is drawn */
  swatch?: ComponentChildren;
}

export function Toggle({ label, hint, value, onChange, swatch }: ToggleProps) {
  return (
    <label class="toggle" title={hint}>
      <input type="checkbox" checked={value} onChange={(e) => onChange(e.currentTarget.checked)} />
      {swatch}
      {label}
    </label>
  );
}

/** Names and values; nothing for values that are not known yet. */
export function Readouts({ rows }: { rows: readonly (readonly [string, string | number | undefined])[] }) {
  return (
    <dl class="readouts">
      {rows.map(([name, value]) => [<dt key={name}>{name}</dt>, <dd key={`${name} value`}>{value ?? '–'}</dd>])}
    </dl>
  );
}

interface NumberFieldProps {
  label: string;
  value: string;
  /** of texts that it refuses it says why */
  check: (text: string) => string | undefined;
  onCommit: (text: string) => void;
}

/**
 * A number as text, "3/2" or "1.01": exact. What is being typed stays, whatever else changes on the page meanwhile. A text that is
 * refused stays, too, marked and with the reason below it, until it is mended, taken back by Escape, or another value is in force.
 */
export function NumberField({ label, value, check, onCommit }: NumberFieldProps) {
  const [typed, setTyped] = useState<string | undefined>();
  const [refusal, setRefusal] = useState<string | undefined>();
  const input = useRef<HTMLInputElement>(null), isOpen = useRef(false), id = useId(); // open: typed, and neither taken nor refused yet
  const say = (wrong: string | undefined): void => {
    input.current?.setCustomValidity(wrong ?? '');
    setRefusal(wrong);
  };
  const drop = (): void => {
    isOpen.current = false;
    setTyped(undefined);
    say(undefined);
  };
  // Before anything else can be typed: what came after the value stays.
  useLayoutEffect(() => {
    if (!isOpen.current) drop();
  }, [value]); // eslint-disable-line react-hooks/exhaustive-deps -- drop is the same in all renders
  const commit = (): void => {
    if (!isOpen.current) return;
    isOpen.current = false;
    const text = input.current!.value.trim(), wrong = text === value ? undefined : check(text);
    say(wrong);
    if (wrong !== undefined) return;
    setTyped(undefined);
    if (text !== value) onCommit(text);
  };
  const type = (text: string): void => {
    isOpen.current = true;
    setTyped(text);
    if (refusal !== undefined) say(text.trim() === value ? undefined : check(text.trim()));
  };
  return (
    <div class="number">
      <label class="field">
        <span class="label">{label}</span>
        <input
          ref={input} type="text" class="mono" value={typed ?? value} spellcheck={false} aria-invalid={refusal !== undefined} aria-describedby={refusal !== undefined ? id : undefined}
          onInput={(e) => type(e.currentTarget.value)} onChange={commit} onBlur={commit} onKeyDown={(e) => e.key === 'Escape' && drop()}
        />
      </label>
      {refusal !== undefined && <p class="refused" id={id} aria-live="polite">{refusal}</p>}
    </div>
  );
}
