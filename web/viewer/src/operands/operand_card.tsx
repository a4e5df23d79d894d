// One operand in the panel: its name, how it is drawn, and what can be put in its place.
import { isMade, shapeOfFile, type Shape } from '../engine/shape';
import type { Shell } from '../shell/page';
import { chooseFiles } from '../shell/files';
import { kCatalogue } from './catalogue';
import { RepairRow } from './repair_row';
import type { Operand } from './use_operand';

interface OperandCardProps {
  role: string;
  /** the role's colours: --p and --p-fill for "p" */
  tint: string;
  shape: Shape;
  operand: Operand;
  onShape: (shape: Shape) => void;
  shell: Shell;
}

export function OperandCard({ role, tint, shape, operand, onShape, shell }: OperandCardProps) {
  const known = kCatalogue.find((s) => s.name === shape.name);
  const choose = (name: string): void => {
    const chosen = kCatalogue.find((s) => s.name === name);
    if (chosen) onShape(chosen);
  };
  return (
    <>
    <div class="row">
      <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
        <rect x="1" y="1" width="12" height="12" rx="2" fill={`var(--${tint}-fill)`} stroke={`var(--${tint})`} stroke-width="2" />
      </svg>
      <strong>{role}</strong>
      <select aria-label={`Shape of ${role}`} value={known?.name ?? ''} onChange={(e) => choose(e.currentTarget.value)} style={{ flex: 1, minWidth: 0 }}>
        {!known && <option value="">{shape.name}</option>}
        {kCatalogue.map(({ name }) => (
          <option key={name}>{name}</option>
        ))}
      </select>
      <span style={{ color: 'var(--quiet)' }}>{operand.outline ? operand.outline.shape.vertices.length / 2 : ''}</span>
      <button aria-label={`Open a file as ${role}`} onClick={() => chooseFiles((files) => onShape(shapeOfFile(files[0]!)))}>
        Open…
      </button>
    </div>
    {operand.error && <p class="refused">{operand.error.message}</p>}
    {operand.error && !isMade(shape) && <RepairRow role={role} shape={shape} shell={shell} onShape={onShape} />}
    </>
  );
}
