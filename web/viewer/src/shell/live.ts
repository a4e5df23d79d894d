// Follows the server of `dymsum view`: its inputs are taken anew whenever a file changes.
import { programData, type ProgramData } from './embedded';

export function followServer({ revision = 0 }: ProgramData, take: (data: ProgramData) => void, report: (error: unknown) => void): void {
  const read = async (): Promise<void> => {
    const answer = await fetch('data.json');
    const data = programData(await answer.text());
    if (data) take(data);
  };
  // After a lost connection the browser comes back by itself, and tells the revision that it knows.
  new EventSource(`events?revision=${revision}`).addEventListener('change', () => void read().catch(report));
}
