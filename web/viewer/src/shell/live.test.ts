import { expect, it, vi } from 'vitest';
import { followServer } from './live';

it('says when the server is gone, once, and takes it back when it is there again', () => {
  const listeners = new Map<string, () => void>();
  vi.stubGlobal('EventSource', class {
    addEventListener(type: string, listener: () => void): void {
      listeners.set(type, listener);
    }
  });
  const said: unknown[] = [], report = (error: unknown) => {
    said.push(error);
    return () => void said.push('taken back');
  };
  followServer({ format: 1 }, () => undefined, report);
  listeners.get('open')!();
  expect(said).toEqual([]);
  listeners.get('error')!();
  listeners.get('error')!();
  expect(said.map(String)).toEqual([expect.stringContaining('The server of this page does not answer')]);
  listeners.get('open')!();
  expect(said[1]).toBe('taken back');
  listeners.get('error')!();
  expect(said.length).toBe(3);
});
