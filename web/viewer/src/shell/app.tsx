// The shell: shows the page of the document, and does what is the same on all of them.
import { useCallback, useEffect, useMemo, useState } from 'preact/hooks';
import { EngineError, type Engine } from '../engine/client';
import { chooseFiles, useDroppedFiles } from './files';
import { Header } from './header';
import { Help } from './help';
import type { History } from './history';
import { useKeyboard, type Commands } from './keyboard';
import { ErrorNotice, ProgressNotice } from './notices';
import { firstDocument, pageOf, withFiles, type Pages } from './opening';
import type { Download, InputFile, Shell } from './page';
import { fitsAddress, mayFitAddress, toHash } from './permalink';
import { copy, save } from './save';
import { switchTheme } from './theme';

interface AppProps {
  pages: Pages;
  engine: Engine;
  history: History;
  /** the reader has to choose what to look at */
  showExamples: boolean;
  /** what went wrong before there was an app */
  firstError: unknown;
  /** is given how the shell shows errors that come from outside of it */
  onReport: (report: Shell['report']) => void;
}

/** What was told in passing, for a while. */
function useAnnouncement(): [string, (text: string) => void] {
  const [text, setText] = useState('');
  useEffect(() => {
    const timer = setTimeout(() => setText(''), 2500);
    return () => clearTimeout(timer);
  }, [text]);
  return [text, setText];
}

function useHistory(history: History): History['document'] {
  const [, again] = useState(0);
  useEffect(() => history.subscribe(() => again((n) => n + 1)), [history]);
  return history.document;
}

function useCommands(props: AppProps, take: (files: InputFile[]) => void, show: (what: 'help' | 'examples') => void, setError: (error: unknown) => void): Commands {
  const { pages, engine, history } = props;
  return useMemo(
    () => ({
      undo: () => {
        setError(undefined);
        history.undo();
      },
      redo: () => {
        setError(undefined);
        history.redo();
      },
      open: () => chooseFiles(take),
      examples: () => show('examples'),
      help: () => show('help'),
      theme: switchTheme,
      cancel: () => {
        if (engine.status.state === 'busy') engine.cancel();
      },
      page: (index) => {
        const page = pages[index];
        if (page && page.id !== history.document.page) history.change(history.lastOf(page.id) ?? firstDocument(page));
      },
    }),
    [pages, engine, history, take, show, setError],
  );
}

export function App(props: AppProps) {
  const { pages, engine, history, onReport } = props;
  const document = useHistory(history);
  const [error, setError] = useState<unknown>(props.firstError);
  const [said, announce] = useAnnouncement();
  const [open, setOpen] = useState<'help' | 'examples' | undefined>(props.showExamples ? 'examples' : undefined);
  const [downloads, setDownloads] = useState<readonly Download[]>([]);
  const report = useCallback((e: unknown) => {
    if (e instanceof EngineError && e.code === 'cancelled') announce('Cancelled.');
    else setError(e);
    return () => setError((now: unknown) => (now === e ? undefined : now)); // another notice stays
  }, [announce]);
  useEffect(() => onReport(report), [onReport, report]);
  const take = useCallback((files: InputFile[]) => {
    try {
      setError(undefined);
      history.change(withFiles(pages, history.document, files));
    } catch (e) {
      setError(e);
    }
  }, [pages, history]);
  const commands = useCommands(props, take, setOpen, setError);
  useKeyboard(commands);
  const dropping = useDroppedFiles(take);
  const shell = useMemo<Shell>(() => {
    const openOn = (id: string, files: readonly InputFile[]): void => {
      const other = pageOf(pages, id), { state } = history.lastOf(id) ?? firstDocument(other);
      setError(undefined);
      history.change({ page: id, state: other.take(files, state) });
    };
    return { engine, report, announce, setDownloads, openOn };
  }, [pages, engine, history, report, announce]);
  const page = pageOf(pages, document.page);
  useEffect(() => setDownloads([]), [page]);

  const share = async (): Promise<void> => {
    const hash = mayFitAddress(history.document) ? await toHash(history.document) : undefined;
    if (hash === undefined || !fitsAddress(hash)) return void report(new Error('The shapes are too large for a link: it would have more than a million letters, which not all browsers open. Send the files instead.'));
    window.history.replaceState(window.history.state, '', hash);
    await copy(location.href);
    announce('The link is copied.');
  };
  return (
    <>
      <Header
        pages={pages} shown={page.id} engine={engine} commands={commands} canUndo={history.canUndo} canRedo={history.canRedo}
        examplesOpen={open === 'examples'} onExamples={(o) => setOpen(o ? 'examples' : undefined)} onShare={() => void share()}
        examples={page.examples.map(({ name, state }) => ({ label: name, run: () => history.change({ page: page.id, state }) }))}
        downloads={downloads.map((d) => ({ label: d.label, run: () => void save(d).catch(report) }))}
      />
      <main class={dropping ? 'page dropping' : 'page'}>
        <page.View
          key={`${page.id} ${history.opened}`} state={document.state} shell={shell}
          change={(state, how) => {
            if (how === 'aside') return history.amend({ page: page.id, state });
            setError(undefined);
            history.change({ page: page.id, state }, how);
          }}
        />
        <div class="overlay">
          {error !== undefined && <ErrorNotice error={error} onClose={() => setError(undefined)} />}
          <ProgressNotice engine={engine} />
          {said && <div class="notice">{said}</div>}
        </div>
        <div class="unseen" aria-live="polite">{said}</div>
      </main>
      {open === 'help' && <Help engine={engine} onClose={() => setOpen(undefined)} />}
    </>
  );
}
