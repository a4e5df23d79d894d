// What the program puts into the page, or a link into its address: docs/design/viewer.md says what it holds.
import type { InputFile } from './page';

export type EmbeddedFile = { name: string; text: string } | { name: string; base64: string };
/** The verb of a command and its options, as they were written. */
export type Parameters = Readonly<Record<string, string | true | readonly string[]>>;

export interface EmbeddedDocument {
  page?: string;
  state?: unknown;
  inputs?: readonly EmbeddedFile[];
  parameters?: Parameters;
}
/** As the program writes it: with a server behind the page, or without. */
export interface ProgramData extends EmbeddedDocument {
  format: number;
  live?: boolean;
  /** of no page: the reader is to choose what to look at; the program calls it page "home" */
  gallery?: true;
  revision?: number;
}

const kFormat = 1;

/** Nothing for an empty text. Throws an Error for data of another version. */
export function programData(text: string): ProgramData | undefined {
  if (text.trim() === '') return undefined;
  const { page, ...data } = JSON.parse(text) as ProgramData;
  if (data.format !== kFormat) throw new Error(`This viewer reads data of format ${kFormat}, and what it was given has format ${String(data.format)}.`);
  if (page === 'home') return { ...data, gallery: true };
  return page === undefined ? data : { ...data, page };
}

export function embeddedData(): ProgramData | undefined {
  return programData(document.getElementById('dymsum-data')?.textContent ?? '');
}

export function filesOf(embedded: EmbeddedDocument): InputFile[] {
  return (embedded.inputs ?? []).map((file) => ({
    name: file.name,
    bytes: 'text' in file ? new TextEncoder().encode(file.text) : Uint8Array.from(atob(file.base64), (c) => c.charCodeAt(0)),
  }));
}
