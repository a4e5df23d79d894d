// Looks into a file that was taken: it is one shape, or holds many.
import { useEffect } from 'preact/hooks';
import type { PageProps } from '../../shell/page';
import { kFree, placeBesideAnother, withParts, type NestingState } from './state';

export function useOpened({ state, change, shell }: PageProps<NestingState>): void {
  const { unopened } = state;
  useEffect(() => {
    if (!unopened) return undefined;
    let isWanted = true;
    const take = (shapes: { name: string; text: string }[]): void => {
      if (!isWanted) return;
      const opened = { ...state, a: unopened, at: state.a.name === unopened.name ? placeBesideAnother(state.at) : kFree };
      delete opened.unopened;
      const parts = shapes.map(({ name, text }, k) => ({ name: `${name || `part ${k}`}.wkt`, text }));
      change(parts.length > 1 ? withParts(state, parts, kFree) : opened, 'aside');
    };
    // A file that is refused becomes A: it is shown with the place where it is wrong.
    shell.engine.ask('shapesOfFile', { shape: unopened, repair: false }).then(take, () => take([]));
    return () => (isWanted = false);
  }, [unopened]); // eslint-disable-line react-hooks/exhaustive-deps -- once for each file
}
