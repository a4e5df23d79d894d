import { render } from 'preact';
import { Engine } from './engine/client';
import { embeddedModule } from './engine/embedded_module';
import EngineWorker from './engine/worker?worker&inline';
import { pages } from './pages';
import { entryOf, followHistory } from './shell/address';
import { App } from './shell/app';
import { embeddedData, filesOf, type EmbeddedDocument, type ProgramData } from './shell/embedded';
import { History, type Document } from './shell/history';
import { followServer } from './shell/live';
import { checkedDocument, firstDocument, openedDocument, withFiles, withNewFiles } from './shell/opening';
import type { Shell } from './shell/page';
import { dataFromHash, fromHash } from './shell/permalink';
import './shell/theme.css';
import './shell/layout.css';
import './shell/controls.css';

/** The document with the files that a server has now. */
function withInputs(document: Document, data: ProgramData): Document {
  const files = filesOf(data);
  return files.length > 0 ? withFiles(pages, document, files) : document;
}

/** What stood here before the page was loaded again, where the address has no room for it. */
function documentOfEntry(): Document | undefined {
  const document = entryOf(window.history.state);
  return document && location.hash === `#/${document.page}` ? checkedDocument(pages, document) : undefined;
}

/** Nothing for an address that says nothing. Of a live page files are the server's. */
async function documentOfAddress(): Promise<Document | undefined> {
  const linked = await fromHash(location.hash);
  if (linked) {
    const document = checkedDocument(pages, linked);
    return server ? withInputs(document, server) : document;
  }
  const data = await dataFromHash(location.hash);
  return data && openedDocument(pages, data);
}

let isGallery = false;
function documentOfPage(): Document | undefined {
  const data = embeddedData();
  isGallery = data?.gallery === true;
  return data && openedDocument(pages, data);
}

/** What the address says, else what stands in the page, also where the address is damaged, else the first example. */
async function start(report: (error: unknown) => void): Promise<Document> {
  for (const make of [documentOfEntry, documentOfAddress, documentOfPage]) {
    try {
      const document = await make();
      if (document) return document;
    } catch (error) {
      report(error);
    }
  }
  return firstDocument(pages[0]);
}

/** What the server behind this page told it, where there is one. */
function serverData(): ProgramData | undefined {
  try {
    const data = embeddedData();
    return data?.live ? data : undefined;
  } catch {
    return undefined; // documentOfPage() says what is wrong
  }
}
const server = serverData();
let newest = server;

let firstError: unknown;
const history = new History(await start((error) => (firstError ??= error)));
const engine = new Engine(() => new EngineWorker(), embeddedModule);
let reportLater: Shell['report'] = (error) => {
  console.error(error);
  return () => undefined;
};

function open(embedded: EmbeddedDocument): void {
  try {
    history.open(openedDocument(pages, embedded));
  } catch (error) {
    reportLater(error);
  }
}
/** What was wrong with a file may be right now: what is still wrong is told again. */
function renew(data: ProgramData): void {
  newest = data;
  const present = withInputs(history.document, data);
  reportLater(undefined);
  history.renew(present, withNewFiles(filesOf(data)));
}
render(<App pages={pages} showExamples={isGallery} engine={engine} history={history} firstError={firstError} onReport={(report) => (reportLater = report)} />, document.getElementById('app')!);
followHistory(history, (linked) => open((newest ? withNewFiles(filesOf(newest))(linked) : linked) as EmbeddedDocument), (error) => reportLater(error));
if (server)
  followServer(server, renew, (error) => reportLater(error));
// Other scripts of the page open documents by this event.
addEventListener('dymsum-open', (event) => open((event as CustomEvent<EmbeddedDocument>).detail));
