// The document as the hash of the address: #/page/state, the state as compressed JSON in the alphabet of addresses. Others
// write #data=, the data that a program would put into the page, packed in the same way.
import { programData, type ProgramData } from './embedded';
import { shapesIn } from '../engine/shape';
import type { Document } from './history';

async function through(bytes: Uint8Array, stream: GenericTransformStream): Promise<Uint8Array> {
  const out = new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array>);
  return new Uint8Array(await new Response(out).arrayBuffer());
}

function toAddress(bytes: Uint8Array): string {
  let text = '';
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

function fromAddress(text: string): Uint8Array {
  if (!/^[\w-]+$/.test(text)) throw new Error('not the alphabet of addresses');
  return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
}

async function unpacked(packed: string): Promise<string> {
  return new TextDecoder().decode(await through(fromAddress(packed), new DecompressionStream('deflate-raw')));
}

const kMostLetters = 1_000_000; // Firefox opens no longer address, Chromium none of twice as many

const kLargeText = 16 * kMostLetters; // numbers as text pack to a third and more: no more than this is tried

/** Whether a document may fit into an address; for the others nothing needs to be packed. */
export function mayFitAddress({ state }: Document): boolean {
  let letters = 0;
  for (const shape of shapesIn(state)) letters += 'text' in shape ? shape.text.length : 0;
  return letters <= kLargeText;
}

/** Whether browsers open an address that ends with this. */
export function fitsAddress(hash: string): boolean {
  return hash.length <= kMostLetters;
}

export async function toHash(document: Document): Promise<string> {
  const json = new TextEncoder().encode(JSON.stringify(document.state));
  return `#/${document.page}/${toAddress(await through(json, new CompressionStream('deflate-raw')))}`;
}

/** Nothing for an address of something else; `#/page` gives a document without state. Throws where the address is damaged. */
export async function fromHash(hash: string): Promise<Document | undefined> {
  if (!hash.startsWith('#/') || hash === '#/') return undefined;
  const [, page, packed] = /^#\/([a-z]+)(?:\/([\w-]*))?$/.exec(hash) ?? [];
  if (!page) throw new Error('The address is damaged: it has something that no link to this viewer has. Was it copied whole, and nothing else with it?');
  if (!packed) return { page, state: undefined };
  try {
    return { page, state: JSON.parse(await unpacked(packed)) as unknown };
  } catch {
    throw new Error('The address is damaged: what follows the name of the page is no state of it. Was it copied whole?');
  }
}

/** Nothing for an address without data. Throws where it is damaged. */
export async function dataFromHash(hash: string): Promise<ProgramData | undefined> {
  if (!hash.startsWith('#data=')) return undefined;
  const text = await unpacked(hash.slice('#data='.length)).catch(() => {
    throw new Error('The address is damaged: what follows #data= cannot be unpacked. Was it copied whole?');
  });
  return programData(text);
}
