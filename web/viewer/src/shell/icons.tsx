// Line icons, 18 by 18.
function Icon({ d }: { d: string }) {
  return (
    <svg width="18" height="18" viewBox="0 0 18 18" fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">
      <path d={d} />
    </svg>
  );
}
export const UndoIcon = () => <Icon d="M6.5 3.5 3 7l3.5 3.5M3 7h7.5a4 4 0 0 1 0 8H7" />;
export const RedoIcon = () => <Icon d="M11.5 3.5 15 7l-3.5 3.5M15 7H7.5a4 4 0 0 0 0 8H11" />;
export const OpenIcon = () => <Icon d="M2 14V4.5A1 1 0 0 1 3 3.5h3.5l2 2H14a1 1 0 0 1 1 1V14a.8.8 0 0 1-.8.8H2.8A.8.8 0 0 1 2 14Z" />;
export const SaveIcon = () => <Icon d="M9 2.5v8.5m-3.5-3.2L9 11l3.5-3.2M3 14.8h12" />;
export const LinkIcon = () => <Icon d="M7.5 10.5a3 3 0 0 0 4.3 0l2.7-2.7a3 3 0 0 0-4.3-4.3L9.2 4.5M10.5 7.5a3 3 0 0 0-4.3 0L3.5 10.2a3 3 0 0 0 4.3 4.3l1-1" />;
export const ThemeIcon = () => <Icon d="M15 10.6A6.3 6.3 0 1 1 7.4 3a5 5 0 0 0 7.6 7.6Z" />;
export const HelpIcon = () => <Icon d="M6.6 6.6a2.4 2.4 0 1 1 3.5 2.2c-.8.4-1.1.9-1.1 1.8M9 13.6v.1" />;
export const Logo = () => (
  <svg width="22" height="22" viewBox="0 0 22 22" aria-hidden="true">
    <path d="M4 6.5 9.5 2.5l9 3.5v8L13 19.5 3.5 16Z" fill="var(--sum-fill)" stroke="var(--sum)" stroke-width="1.6" stroke-linejoin="round" />
    <path d="M8 8.2 11.3 6l4 4.6-3.8 4.2Z" fill="var(--p-fill)" stroke="var(--p)" stroke-width="1.4" stroke-linejoin="round" />
  </svg>
);
