// What a page of the viewer is. Its state is plain JSON: permalinks, undo and embedded documents hold nothing else.
import type { ComponentType } from 'preact';
import type { Engine } from '../engine/client';
import type { Parameters } from './embedded';

/** A file that was dropped, chosen or embedded. */
export interface InputFile {
  name: string;
  bytes: Uint8Array;
}

export interface Example<S> {
  name: string;
  state: S;
}

/** A file to be saved. `make` runs when it is asked for. */
export interface Download {
  label: string;
  fileName: string;
  make: () => Promise<string | Uint8Array>;
}

/** What the shell offers to a page. Stays the same object as long as the page is shown. */
export interface Shell {
  engine: Engine;
  /**
   * Shows an error, with its evidence, until the state changes, the reader closes it, or what is given is called: see useReport for
   * errors of what is computed.
   */
  report: (error: unknown) => () => void;
  /** Tells something in passing, also to screen readers: "copied". */
  announce: (text: string) => void;
  /** Goes to another page with these files. Throws what that page says. */
  openOn: (page: string, files: readonly InputFile[]) => void;
  /** What the download menu lists. */
  setDownloads: (downloads: readonly Download[]) => void;
}

/**
 * live: one of many changes of a drag, which undo takes back together; done: a change of its own, or the last of a drag;
 * aside: nothing that undo takes back, such as where the reader looks.
 */
export type Change<S> = (next: S, how?: 'live' | 'done' | 'aside') => void;

export interface PageProps<S> {
  state: S;
  change: Change<S>;
  shell: Shell;
}

export interface Page<S> {
  /** The name in the address: lower case letters. */
  id: string;
  title: string;
  /** One sentence: what is to be seen here. */
  summary: string;
  /** At least one; the first is shown where no state is given. */
  examples: readonly [Example<S>, ...Example<S>[]];
  /** A state of this page from what a permalink or a document holds. Throws an Error that says what is wrong. */
  parse: (value: unknown) => S;
  /** The state with these files taken up. Throws an Error that says what this page can take. */
  take: (files: readonly InputFile[], state: S) => S;
  /**
   * The state as the options of a command ask for it, whose inputs it has taken: so many; no parameters where there are only
   * inputs. Without this, as it is.
   */
  command?: (parameters: Parameters, state: S, inputs: number) => S;
  /** Renders a <Stage> and a <Panel>. */
  View: ComponentType<PageProps<S>>;
}

/** A page among others; the shell hands its state only to itself. */
export type AnyPage = Page<unknown>;

export function asAnyPage<S>(page: Page<S>): AnyPage {
  return page as unknown as AnyPage;
}
