import { render } from 'preact';
import { Engine } from './engine/client';
import { embeddedModule } from './engine/embedded_module';
import EngineWorker from './engine/worker?worker&inline';
import { pages } from './pages';
import { followAddress, followDocument } from './shell/address';
import { App } from './shell/app';
import { embeddedDocument, type EmbeddedDocument } from './shell/embedded';
import { History, type Document } from './shell/history';
import { checkedDocument, firstDocument, openedDocument } from './shell/opening';
import { fromHash } from './shell/permalink';
import './shell/theme.css';
import './shell/layout.css';
import './shell/controls.css';

/** What the address says, else what stands in the page, else the first example. */
async function start(): Promise<Document> {
  const linked = await fromHash(location.hash);
  if (linked) return checkedDocument(pages, linked);
  const embedded = embeddedDocument();
  return embedded ? openedDocument(pages, embedded) : firstDocument(pages[0]);
}

let firstError: unknown;
const history = new History(
  await start().catch((error: unknown) => {
    firstError = error;
    return firstDocument(pages[0]);
  }),
);
const engine = new Engine(() => new EngineWorker(), embeddedModule);
let reportLater: (error: unknown) => void = (error) => console.error(error);

function open(embedded: EmbeddedDocument): void {
  try {
    history.open(openedDocument(pages, embedded));
  } catch (error) {
    reportLater(error);
  }
}
render(<App pages={pages} engine={engine} history={history} firstError={firstError} onReport={(report) => (reportLater = report)} />, document.getElementById('app')!);
followDocument(history);
followAddress((linked) => open(linked as EmbeddedDocument), (error) => reportLater(error));
// Other scripts of the page open documents by this event: `dymsum view` does when a file has changed.
addEventListener('dymsum-open', (event) => open((event as CustomEvent<EmbeddedDocument>).detail));
