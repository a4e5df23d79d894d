// Of a file of several shapes, which other pages take one of: the way to the page that takes all of them.
import type { EngineError } from '../../engine/client';
import { bytesOf, isMade, type Shape } from '../../engine/shape';
import type { Shell } from '../../shell/page';

/** Whether an error says that a file holds several shapes; there is no code of its own for it. */
export function isOfSeveral(error: Pick<EngineError, 'code' | 'message'> | undefined): boolean {
  return error?.code === 'malformed' && /holds \d+ shapes/.test(error.message);
}

export function NestingOffer({ shape, error, shell }: { shape: Shape; error: EngineError | undefined; shell: Shell }) {
  if (!isOfSeveral(error) || isMade(shape)) return null;
  const data = bytesOf(shape), bytes = typeof data === 'string' ? new TextEncoder().encode(data) : data;
  return (
    <div class="row">
      <button onClick={() => shell.openOn('nesting', [{ name: shape.name, bytes }])}>Nest the shapes of {shape.name}</button>
    </div>
  );
}
