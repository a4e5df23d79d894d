import { useEffect, useRef } from 'preact/hooks';
import { kKeys } from './keyboard';

export function Help({ version, onClose }: { version: string; onClose: () => void }) {
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
      <p style={{ color: 'var(--quiet)' }}>dymsum {version}: exact Minkowski sums that stay exact while shapes move. Nothing leaves this page.</p>
      <form method="dialog">
        <button class="primary">Close</button>
      </form>
    </dialog>
  );
}
