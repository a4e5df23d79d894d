// Moves a slider to and fro until it is pressed again. Not there for readers who want little motion.
import { useEffect, useRef, useState } from 'preact/hooks';
import { motionIsReduced } from './theme';

interface PlayProps {
  label: string;
  value: number;
  min: number;
  max: number;
  onInput: (value: number) => void;
  onDone: (value: number) => void;
}

const kSeconds = 12; // from one end to the other

export function PlayButton(props: PlayProps) {
  const [playing, setPlaying] = useState(false);
  const now = useRef(props), goesOn = useRef(false); // effects end late: a frame may come after the press
  now.current = props;
  useEffect(() => {
    goesOn.current = playing;
    if (!playing) return undefined;
    let frame = 0, last = performance.now(), up = true;
    const next = (time: number): void => {
      if (!goesOn.current) return;
      const { value, min, max, onInput } = now.current, way = ((max - min) * Math.min(time - last, 100)) / 1000 / kSeconds;
      if (up ? value + way > max : value - way < min) up = !up;
      onInput(value + (up ? way : -way));
      last = time;
      frame = requestAnimationFrame(next);
    };
    frame = requestAnimationFrame(next);
    return () => cancelAnimationFrame(frame);
  }, [playing]);
  if (motionIsReduced()) return null;
  const press = (): void => {
    goesOn.current = false;
    if (playing) props.onDone(props.value);
    setPlaying(!playing);
  };
  return (
    <button class="play" aria-pressed={playing} aria-label={`${playing ? 'Stop' : 'Play'}: ${props.label}`} title={playing ? 'Stop' : 'Play'} onClick={press}>
      <svg width="12" height="12" viewBox="0 0 12 12" fill="currentColor" aria-hidden="true">
        <path d={playing ? 'M2 1h3v10H2zM7 1h3v10H7z' : 'M2.5 1 11 6l-8.5 5z'} />
      </svg>
    </button>
  );
}
