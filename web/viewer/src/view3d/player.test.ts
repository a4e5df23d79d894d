import { expect, test } from 'vitest';
import { Player } from './player';

/** Frames that come when the test says so. */
function clock() {
  let run: ((ms: number) => void) | undefined;
  let cancelled = 0;
  return {
    frame: (next: (ms: number) => void): number => ((run = next), 1),
    cancelFrame: (): void => void ((run = undefined), ++cancelled),
    tick: (ms: number): void => {
      const now = run;
      run = undefined;
      now?.(ms);
    },
    waiting: (): boolean => run !== undefined,
  };
}

test('plays to the end and asks for no more frames', () => {
  const at = clock(), seen: [number, boolean][] = [];
  const player = new Player((share, playing) => seen.push([share, playing]), { seconds: 2, frame: at.frame, cancelFrame: at.cancelFrame });
  player.play(0.5);
  for (const ms of [100, 600, 1100]) at.tick(ms);
  expect(seen).toEqual([[0.75, true], [1, false]]);
  expect(player.playing).toBe(false);
  expect(at.waiting()).toBe(false);
});

test('pausing tells where it stands; from the end it starts over', () => {
  const at = clock(), seen: [number, boolean][] = [];
  const player = new Player((share, playing) => seen.push([share, playing]), { seconds: 1, frame: at.frame, cancelFrame: at.cancelFrame });
  player.play(1);
  at.tick(0);
  at.tick(250);
  player.pause();
  expect(seen).toEqual([[0.25, true], [0.25, false]]);
  expect(at.waiting()).toBe(false);
});

test('where motion is reduced there are only a few still pictures', () => {
  const at = clock(), seen: number[] = [];
  const player = new Player((share) => seen.push(share), { seconds: 1, stills: 2, frame: at.frame, cancelFrame: at.cancelFrame });
  player.play(0);
  for (let ms = 0; ms <= 1000; ms += 50) at.tick(ms);
  expect(seen).toEqual([0.5, 1]);
});
