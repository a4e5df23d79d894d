// An exact value: a press copies the whole of it.
import { clipped } from '../numbers/display';
import type { Shell } from './page';
import { copy } from './save';

export function ExactText({ label, text, shell }: { label: string; text: string; shell: Shell }) {
  const take = async (): Promise<void> => {
    await copy(text);
    shell.announce(`${label} is copied.`);
  };
  return (
    <button class="exact mono" aria-label={`Copy ${label}`} title="Copy" onClick={() => void take()}>
      {clipped(text)}
    </button>
  );
}
