import { useEffect } from 'preact/hooks';
import type { Shell } from './page';

/** Shows the error of what is computed, for as long as it is one; with none it takes the notice back. */
export function useReport(shell: Shell, error: unknown): void {
  useEffect(() => (error === undefined ? undefined : shell.report(error)), [shell, error]);
}
