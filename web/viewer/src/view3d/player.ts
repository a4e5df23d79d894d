// Plays something from 0 to 1. Where motion is to be reduced it goes on in a few still steps instead.

export interface PlayerOptions {
  /** of the whole */
  seconds: number;
  /** goes on where it is, in so many steps, instead of moving */
  stills?: number;
  /** for tests; else that of the browser */
  frame?: (run: (ms: number) => void) => number;
  cancelFrame?: (handle: number) => void;
}

export class Player {
  private handle = 0;
  private share = 0;
  private start = 0;
  private readonly frame;
  private readonly cancelFrame;

  /** `show` is called for every frame with the share, and once more, with `playing` false, when it ends or is paused. */
  constructor(
    private readonly show: (share: number, playing: boolean) => void,
    private readonly options: PlayerOptions,
  ) {
    this.frame = options.frame ?? ((run: (ms: number) => void) => requestAnimationFrame(run));
    this.cancelFrame = options.cancelFrame ?? ((handle: number) => cancelAnimationFrame(handle));
  }

  get playing(): boolean {
    return this.handle !== 0;
  }

  /** From a share on; from the beginning if that is the end. */
  play(from: number): void {
    this.stop();
    this.share = from >= 1 ? 0 : from;
    this.start = NaN;
    this.handle = this.frame(this.step);
  }

  pause(): void {
    if (!this.playing) return;
    this.stop();
    this.show(this.share, false);
  }

  /** Without a word. */
  stop(): void {
    if (this.playing) this.cancelFrame(this.handle);
    this.handle = 0;
  }

  private readonly step = (ms: number): void => {
    if (Number.isNaN(this.start)) this.start = ms - 1000 * this.options.seconds * this.share;
    const reached = Math.min(1, (ms - this.start) / (1000 * this.options.seconds));
    const { stills } = this.options;
    const share = stills === undefined || reached === 1 ? reached : Math.floor(reached * stills) / stills;
    const done = reached === 1;
    const seen = this.share;
    this.share = share;
    this.handle = done ? 0 : this.frame(this.step);
    if (done || share !== seen) this.show(share, !done);
  };
}
