// Looks into a file that was taken: it is one shape, or holds many.
import { useEffect, useState } from 'preact/hooks';
import type { FileShape } from '../../engine/shape';
import type { PageProps } from '../../shell/page';
import { kFree, placeBesideAnother, withParts, type NestingState } from './state';

/** A file of several shapes of which one is refused. */
export interface RefusedFile {
  file: FileShape;
  reason: string;
  /** Nests what the library's repair makes of its shapes. */
  repair: () => void;
}

type Named = { name: string; text: string };

/** Parts named as in the file; those that were repaired bear a star. */
function partsOf(shapes: readonly Named[], mark: '' | '*'): FileShape[] {
  return shapes.map(({ name, text }, k) => ({ name: `${name || `part ${k}`}${mark}.wkt`, text }));
}

export function useOpened({ state, change, shell }: PageProps<NestingState>): RefusedFile | undefined {
  const { unopened } = state, [refused, setRefused] = useState<RefusedFile | undefined>();
  useEffect(() => {
    if (!unopened) return undefined;
    let isWanted = true;
    setRefused(undefined);
    const becomesA = (): void => {
      const opened = { ...state, a: unopened, at: state.a.name === unopened.name ? placeBesideAnother(state.at) : kFree };
      delete opened.unopened;
      change(opened, 'aside');
    };
    const nest = (parts: FileShape[], how: 'aside' | 'done'): void => change(withParts(state, parts, kFree), how);
    const read = (repair: boolean): Promise<Named[]> => shell.engine.ask('shapesOfFile', { shape: unopened, repair });
    const offer = (error: unknown, shapes: Named[]): void => {
      if (!isWanted) return;
      if (shapes.length < 2) return becomesA(); // it is shown with the place where it is wrong
      const stays = { ...state };
      delete stays.unopened;
      change(stays, 'aside');
      setRefused({ file: unopened, reason: error instanceof Error ? error.message : String(error), repair: () => nest(partsOf(shapes, '*'), 'done') });
      shell.report(error);
    };
    read(false).then(
      (shapes) => isWanted && (shapes.length > 1 ? nest(partsOf(shapes, ''), 'aside') : becomesA()),
      (error: unknown) => read(true).then((shapes) => offer(error, shapes), () => offer(error, [])),
    );
    return () => (isWanted = false);
  }, [unopened]); // eslint-disable-line react-hooks/exhaustive-deps -- once for each file
  useEffect(() => setRefused(undefined), [state.a, state.b]);
  return refused;
}
