// Which document a permalink, an embedded document or files make.
import { shapeOfFile } from '../engine/shape';
import { filesOf, type EmbeddedDocument } from './embedded';
import type { Document } from './history';
import type { AnyPage, InputFile } from './page';

export type Pages = readonly [AnyPage, ...AnyPage[]];

export function pageOf(pages: Pages, id: string): AnyPage {
  const page = pages.find((p) => p.id === id);
  if (!page) throw new Error(`There is no page "${id}". There are: ${pages.map((p) => p.id).join(', ')}.`);
  return page;
}

export function firstDocument(page: AnyPage): Document {
  return { page: page.id, state: page.examples[0].state };
}

/** A document that came from outside, checked. */
export function checkedDocument(pages: Pages, document: Document): Document {
  const page = pageOf(pages, document.page);
  return document.state === undefined ? firstDocument(page) : { page: page.id, state: page.parse(document.state) };
}

/** Where each file has a page, but none that takes all of them. */
function togetherError(pages: Pages, files: readonly InputFile[]): Error | undefined {
  const takers = files.map((file) => pages.filter((page) => takes(page, [file])));
  if (takers.some((of) => of.length === 0) || pages.some((page) => takers.every((of) => of.includes(page)))) return undefined;
  const texts = files.map(({ name }, k) => `"${name}" is for ${takers[k]!.map((page) => page.title).join(', ')}`);
  return new Error(`No page takes these files together: ${texts.join('; ')}. Open them one after the other.`);
}

function takes(page: AnyPage, files: readonly InputFile[]): boolean {
  try {
    page.take(files, page.examples[0].state);
    return true;
  } catch {
    return false;
  }
}

/** The page that is shown takes the files if it can, else the first other one that can. Throws what the page that is shown says. */
export function withFiles(pages: Pages, now: Document, files: readonly InputFile[]): Document {
  const shown = pageOf(pages, now.page);
  try {
    return { page: shown.id, state: shown.take(files, now.state) };
  } catch (refusal) {
    for (const page of pages) {
      if (page === shown) continue;
      try {
        return { page: page.id, state: page.take(files, page.examples[0].state) };
      } catch {
        continue;
      }
    }
    throw togetherError(pages, files) ?? refusal;
  }
}

export function openedDocument(pages: Pages, embedded: EmbeddedDocument): Document {
  const document = checkedDocument(pages, { page: embedded.page ?? pages[0].id, state: embedded.state });
  const files = filesOf(embedded);
  if (files.length === 0) return document;
  const { page, state } = withFiles(pages, document, files), { command } = pageOf(pages, page);
  return command && embedded.state === undefined ? { page, state: command(embedded.parameters ?? {}, state, files.length) } : { page, state };
}

/** Makes of a document the one with files of these names as they are now; the same object where it has none that changed. */
export function withNewFiles(files: readonly InputFile[]): (document: Document) => Document {
  const now = new Map(files.map((file) => [file.name, shapeOfFile(file)]));
  const renewed = (value: unknown): unknown => {
    if (typeof value !== 'object' || value === null) return value;
    const { name, text } = value as Record<string, unknown>, file = typeof name === 'string' && typeof text === 'string' ? now.get(name) : undefined;
    if (file) return file.text === text ? value : file;
    const parts = Object.entries(value).map(([key, part]) => [key, part, renewed(part)] as const);
    if (parts.every(([, before, after]) => before === after)) return value;
    return Array.isArray(value) ? parts.map(([, , after]) => after) : Object.fromEntries(parts.map(([key, , after]) => [key, after]));
  };
  return (document) => {
    const state = renewed(document.state);
    return state === document.state ? document : { ...document, state };
  };
}
