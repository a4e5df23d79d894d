// A button with a list below it; arrows go through the list, Escape closes it.
import type { ComponentChildren } from 'preact';
import { useEffect, useRef, useState } from 'preact/hooks';

export interface MenuItem {
  label: string;
  run: () => void;
}

interface MenuProps {
  label: string;
  /** the button's content, where it is not the label */
  children?: ComponentChildren;
  items: readonly MenuItem[];
  open?: boolean;
  onOpen?: (open: boolean) => void;
}

export function Menu({ label, children, items, open, onOpen }: MenuProps) {
  const [own, setOwn] = useState(false);
  const isOpen = open ?? own;
  const show = onOpen ?? setOwn;
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (isOpen) root.current?.querySelector<HTMLElement>('li button')?.focus();
  }, [isOpen]);
  const onKey = (e: KeyboardEvent): void => {
    if (!isOpen) return;
    if (e.key === 'Escape') {
      show(false);
      root.current?.querySelector<HTMLElement>(':scope > button')?.focus();
    } else if (e.key === 'ArrowDown' || e.key === 'ArrowUp') {
      const buttons = [...root.current!.querySelectorAll<HTMLElement>('li button')];
      const now = buttons.indexOf(document.activeElement as HTMLElement);
      buttons.at((now + (e.key === 'ArrowDown' ? 1 : -1) + buttons.length) % buttons.length)?.focus();
    } else return;
    e.preventDefault();
    e.stopPropagation();
  };
  const onLeave = (e: FocusEvent): void => {
    if (!root.current?.contains(e.relatedTarget as Node | null)) show(false);
  };
  return (
    <div class="menu" ref={root} onKeyDown={onKey} onFocusOut={onLeave}>
      <button class={children ? 'icon plain' : 'plain'} aria-haspopup="true" aria-expanded={isOpen} aria-label={label} title={label} onClick={() => show(!isOpen)}>
        {children ?? label}
      </button>
      {isOpen && (
        <ul>
          {items.map((item) => (
            <li key={item.label}>
              <button onClick={() => (show(false), item.run())}>{item.label}</button>
            </li>
          ))}
          {items.length === 0 && <li style={{ padding: '6px 10px' }}>nothing yet</li>}
        </ul>
      )}
    </div>
  );
}
