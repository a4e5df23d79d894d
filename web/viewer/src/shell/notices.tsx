// What lies over the picture for a while: errors, progress, and what is told in passing.
import { useEffect, useState } from 'preact/hooks';
import { EngineError, type Engine, type EngineStatus } from '../engine/client';

const kQuietMs = 400; // work that is shorter shows no bar

export function useEngineStatus(engine: Engine): EngineStatus {
  const [status, show] = useState(engine.status);
  useEffect(() => {
    const update = (): void => show(engine.status);
    update();
    return engine.subscribe(update);
  }, [engine]);
  return status;
}

export function ProgressNotice({ engine }: { engine: Engine }) {
  const { since, stage, fraction, state } = useEngineStatus(engine);
  const [long, setLong] = useState(false);
  useEffect(() => {
    setLong(false);
    if (since === 0) return undefined;
    const timer = setTimeout(() => setLong(true), kQuietMs);
    return () => clearTimeout(timer);
  }, [since]);
  if (!long || since === 0 || state === 'broken') return null;
  return (
    <div class="notice" role="status">
      <span>{stage || (state === 'starting' ? 'starting' : 'computing')}</span>
      <div class="progress-bar" role="progressbar" aria-label="Progress" {...(fraction === undefined ? {} : { 'aria-valuenow': Math.round(100 * fraction) })}>
        <div class={fraction === undefined ? 'unknown' : ''} style={fraction === undefined ? {} : { width: `${100 * fraction}%` }} />
      </div>
      <button class="plain" style={{ minHeight: 0, padding: '0 6px' }} onClick={() => engine.cancel()}>
        Cancel
      </button>
    </div>
  );
}

export function ErrorNotice({ error, onClose }: { error: unknown; onClose: () => void }) {
  const known = error instanceof EngineError ? error : undefined;
  const message = error instanceof Error ? error.message : String(error);
  return (
    <div class="notice error" role="alert">
      <p>
        {known && known.code !== 'cancelled' && <strong>{known.code.replaceAll('_', ' ')}: </strong>}
        {message}
      </p>
      <button class="plain" style={{ minHeight: 0, padding: '0 6px' }} aria-label="Close the message" onClick={onClose}>
        ×
      </button>
    </div>
  );
}
