// Follows the server of `dymsum view`: its inputs are taken anew whenever a file changes.
import { programData, type ProgramData } from './embedded';
import type { Shell } from './page';

const kGone = 'The server of this page does not answer: has `dymsum view` ended? What is shown no longer follows the files.';

export function followServer({ revision = 0 }: ProgramData, take: (data: ProgramData) => void, report: Shell['report']): void {
  const read = async (): Promise<void> => {
    const answer = await fetch('data.json');
    const data = programData(await answer.text());
    if (data) take(data);
  };
  let takeBack: (() => void) | undefined;
  // After a lost connection the browser comes back by itself, and tells the revision that it knows.
  const events = new EventSource(`events?revision=${revision}`);
  events.addEventListener('change', () => void read().catch(report));
  events.addEventListener('error', () => (takeBack ??= report(new Error(kGone))));
  events.addEventListener('open', () => {
    takeBack?.();
    takeBack = undefined;
  });
}
