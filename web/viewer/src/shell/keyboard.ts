// Keys that hold on every page. A page has its own on its picture, which has to have the focus.
import { useEffect } from 'preact/hooks';

export interface Commands {
  undo: () => void;
  redo: () => void;
  open: () => void;
  examples: () => void;
  help: () => void;
  theme: () => void;
  cancel: () => void;
  page: (index: number) => void;
}

export const kKeys: readonly (readonly [string, string])[] = [
  ['Ctrl Z, Ctrl Shift Z', 'undo, redo'],
  ['1 … 9', 'go to a page'],
  ['O', 'open files'],
  ['E', 'examples'],
  ['T', 'light or dark'],
  ['Esc', 'stop what is being computed'],
  ['?', 'this list'],
  ['arrows, + −, 0', 'in the picture: move, zoom, fit'],
  ['Alt arrows', 'in the picture: move the shape'],
  ['Tab, then Space', 'every control'],
];

/** Texts have keys of their own; lists only letters. */
function isTyping({ target, ctrlKey, metaKey }: KeyboardEvent): boolean {
  return target instanceof HTMLElement && target.matches(ctrlKey || metaKey ? 'input[type=text], textarea' : 'input[type=text], textarea, select');
}

function commandOf(e: KeyboardEvent, c: Commands): (() => void) | undefined {
  const key = e.key.toLowerCase();
  if (e.ctrlKey || e.metaKey) {
    if (key === 'z') return e.shiftKey ? c.redo : c.undo;
    return key === 'y' ? c.redo : undefined;
  }
  if (e.altKey) return undefined;
  if (/^[1-9]$/.test(key)) return () => c.page(Number(key) - 1);
  return { o: c.open, e: c.examples, t: c.theme, '?': c.help, escape: c.cancel }[key];
}

export function useKeyboard(commands: Commands): void {
  useEffect(() => {
    const onKey = (e: KeyboardEvent): void => {
      if (e.defaultPrevented || isTyping(e) || document.querySelector('dialog[open]')) return;
      const command = commandOf(e, commands);
      if (!command) return;
      e.preventDefault();
      command();
    };
    addEventListener('keydown', onKey);
    return () => removeEventListener('keydown', onKey);
  }, [commands]);
}
