// What is known of the newest question: greyed while it is that of an older one, and where there is none, why.
import type { ComponentChildren } from 'preact';
import { EngineError } from '../engine/client';
import type { Standing } from '../engine/use_answer';

interface ResultsProps extends Standing {
  /** An operand is refused: nothing is asked. */
  refused?: boolean;
  children: ComponentChildren;
}

function reasonOf(error: unknown): string {
  if (error instanceof EngineError && error.code === 'cancelled') return 'Cancelled: this has not been computed.';
  return `Not computed: ${error instanceof Error ? error.message : String(error)}`;
}

export function Results({ waiting, error, again, refused, children }: ResultsProps) {
  return (
    <div class={waiting ? 'stale' : ''} aria-busy={waiting}>
      {refused && <p class="refused">Not computed: one of the shapes is refused.</p>}
      {error !== undefined && !refused && <p class="refused">{reasonOf(error)}</p>}
      {error instanceof EngineError && error.code === 'cancelled' && !refused && (
        <div class="row">
          <button onClick={again}>Compute it</button>
        </div>
      )}
      {children}
    </div>
  );
}
