import { useEffect, useRef } from 'preact/hooks';
import type { Engine } from '../engine/client';
import { useAnswer } from '../engine/use_answer';
import { kKeys } from './keyboard';

const kNothing = {};

export function Help({ engine, onClose }: { engine: Engine; onClose: () => void }) {
  const memory = useAnswer(engine, 'memory', kNothing).value, { version, simd } = engine.status;
  const dialog = useRef<HTMLDialogElement>(null);
  useEffect(() => dialog.current?.showModal(), []);
  return (
    <dialog ref={dialog} onClose={onClose} aria-labelledby="help-title">
      <h2 id="help-title">Keys</h2>
      <table>
        <tbody>
          {kKeys.map(([keys, does]) => (
            <tr key={keys}>
              <td>
                <kbd>{keys}</kbd>
              </td>
              <td>{does}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p>Drop a file on the page to open it. The address keeps all that is shown: copy it to share the picture.</p>
      <p style={{ color: 'var(--quiet)' }}>
        dymsum {version}: exact Minkowski sums that stay exact while shapes move. Nothing leaves this page.{' '}
        {memory !== undefined && `The engine${simd ? ', with vector instructions,' : ''} holds ${Math.round(memory / 1e6)} MB.`}
      </p>
      <form method="dialog">
        <button class="primary">Close</button>
      </form>
    </dialog>
  );
}
