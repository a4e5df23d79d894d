import type { Engine } from '../engine/client';
import { HelpIcon, LinkIcon, Logo, OpenIcon, RedoIcon, SaveIcon, ThemeIcon, UndoIcon } from './icons';
import type { Commands } from './keyboard';
import { Menu, type MenuItem } from './menu';
import { useEngineStatus } from './notices';
import type { Pages } from './opening';

interface HeaderProps {
  pages: Pages;
  shown: string;
  engine: Engine;
  commands: Commands;
  canUndo: boolean;
  canRedo: boolean;
  examples: readonly MenuItem[];
  examplesOpen: boolean;
  onExamples: (open: boolean) => void;
  downloads: readonly MenuItem[];
  onShare: () => void;
}

function Tabs({ pages, shown, commands }: Pick<HeaderProps, 'pages' | 'shown' | 'commands'>) {
  return (
    <nav class="tabs" aria-label="Pages">
      {pages.map((page, index) => (
        <a
          key={page.id} href={`#/${page.id}`} aria-current={page.id === shown ? 'page' : undefined} title={page.summary}
          onClick={(e) => (e.preventDefault(), commands.page(index))}
        >
          {page.title}
        </a>
      ))}
    </nav>
  );
}

export function Header(props: HeaderProps) {
  const { engine, commands } = props;
  const status = useEngineStatus(engine);
  return (
    <header class="header">
      <span class="brand" title={status.version && `dymsum ${status.version}${status.simd ? ', SIMD' : ''}`}>
        <Logo /> dymsum
      </span>
      <Tabs {...props} />
      <Menu label="Examples" items={props.examples} open={props.examplesOpen} onOpen={props.onExamples} />
      <button class="icon plain" aria-label="Undo" title="Undo (Ctrl Z)" disabled={!props.canUndo} onClick={commands.undo}>
        <UndoIcon />
      </button>
      <button class="icon plain" aria-label="Redo" title="Redo (Ctrl Shift Z)" disabled={!props.canRedo} onClick={commands.redo}>
        <RedoIcon />
      </button>
      <button class="icon plain" aria-label="Open files" title="Open files (O)" onClick={commands.open}>
        <OpenIcon />
      </button>
      <Menu label="Download" items={props.downloads}>
        <SaveIcon />
      </Menu>
      <button class="icon plain" aria-label="Copy a link to what is shown" title="Copy a link to what is shown" onClick={props.onShare}>
        <LinkIcon />
      </button>
      <button class="icon plain" aria-label="Light or dark" title="Light or dark (T)" onClick={commands.theme}>
        <ThemeIcon />
      </button>
      <button class="icon plain" aria-label="Keys" title="Keys (?)" onClick={commands.help}>
        <HelpIcon />
      </button>
    </header>
  );
}
