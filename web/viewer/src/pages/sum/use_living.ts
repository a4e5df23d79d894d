// The bar that is pointed at or chosen, and where what it stands for is in the picture.
import { useMemo, useState } from 'preact/hooks';
import { useAnswer } from '../../engine/use_answer';
import type { Shell } from '../../shell/page';
import { isUniform } from '../scale';
import type { Life, Lives } from './families';
import { aliveIn, kNotAlive, type Alive } from './living';
import type { SumData } from './use_sum';

export interface Living {
  chosen: Life | undefined;
  choose: (life: Life | undefined) => void;
  hovered: Life | undefined;
  hover: (life: Life | undefined) => void;
  alive: Alive;
}

/** A life of these lives; of others it says nothing. */
function useLife(lives: Lives | undefined): [Life | undefined, (life: Life | undefined) => void] {
  const [{ life, of }, set] = useState<{ life: Life | undefined; of: Lives | undefined }>({ life: undefined, of: undefined });
  return [of === lives ? life : undefined, (next) => set({ life: next, of: lives })];
}

export function useLiving(shell: Shell, { sum, of }: SumData, lives: Lives | undefined): Living {
  const [chosen, choose] = useLife(lives), [hovered, hover] = useLife(lives), life = hovered ?? chosen;
  const isOfFamily = of !== undefined && of.motion === 'scale' && !of.pull && isUniform(of.scale);
  const isThere = life !== undefined && isOfFamily && life.hole !== null;
  const question = useMemo(() => (isThere && of ? { ...of, hole: life.hole! } : undefined), [isThere, of, life]);
  const ring = useAnswer(shell.engine, 'ringOfHole', question);
  const alive = useMemo((): Alive => {
    if (!life || !sum || !isOfFamily) return kNotAlive;
    const isNow = ring.of === question && ring.value !== undefined && ring.value >= 0;
    return { ...aliveIn(sum.shape, life), ring: isNow ? ring.value : undefined };
  }, [life, sum, isOfFamily, ring.of, ring.value, question]);
  return { chosen, choose, hovered, hover, alive };
}
