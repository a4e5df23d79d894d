// Light or dark: what the system says, until the reader chooses. Colours are those of theme.css; canvases ask for them here.
import { useEffect, useState } from 'preact/hooks';

export type Theme = 'light' | 'dark';

const kKey = 'dymsum-theme';
const system = matchMedia('(prefers-color-scheme: dark)');
const listeners = new Set<() => void>();

function chosen(): string | null {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null; // pages from disk may have no storage
  }
}

let choice = chosen();

export function theme(): Theme {
  if (choice === 'light' || choice === 'dark') return choice;
  return system.matches ? 'dark' : 'light';
}

function apply(): void {
  document.documentElement.dataset.theme = theme();
  for (const listener of listeners) listener();
}
system.addEventListener('change', apply);
apply();

export function switchTheme(): void {
  choice = theme() === 'dark' ? 'light' : 'dark';
  try {
    localStorage.setItem(kKey, choice);
  } catch {
    // the choice lasts as long as the page
  }
  apply();
}

export function useTheme(): Theme {
  const [now, show] = useState(theme);
  useEffect(() => {
    const listener = (): void => show(theme());
    listeners.add(listener);
    return () => void listeners.delete(listener);
  }, []);
  return now;
}

/** The value of a custom property, "--sum", under the theme of now. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export function motionIsReduced(): boolean {
  return matchMedia('(prefers-reduced-motion: reduce)').matches;
}
