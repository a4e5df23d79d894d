// A document that stands in the page: what `dymsum view` and `-o x.html` write.
import type { InputFile } from './page';

/** <script type="application/json" id="dymsum-document">: a page with its state, or files to open on it. */
export interface EmbeddedDocument {
  page?: string;
  state?: unknown;
  files?: readonly ({ name: string; text: string } | { name: string; base64: string })[];
}

export function embeddedDocument(): EmbeddedDocument | undefined {
  const text = document.getElementById('dymsum-document')?.textContent;
  return text ? (JSON.parse(text) as EmbeddedDocument) : undefined;
}

export function filesOf(embedded: EmbeddedDocument): InputFile[] {
  return (embedded.files ?? []).map((file) => ({
    name: file.name,
    bytes: 'text' in file ? new TextEncoder().encode(file.text) : Uint8Array.from(atob(file.base64), (c) => c.charCodeAt(0)),
  }));
}
