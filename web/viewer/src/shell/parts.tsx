// The two halves of a page: the picture, and the panel beside it or, on narrow screens, below it.
import type { ComponentChildren } from 'preact';

export function Stage({ children }: { children: ComponentChildren }) {
  return <div class="stage">{children}</div>;
}

export function Panel({ summary, children }: { summary: string; children: ComponentChildren }) {
  return (
    <aside class="panel" aria-label="Controls">
      <p class="summary">{summary}</p>
      {children}
    </aside>
  );
}
