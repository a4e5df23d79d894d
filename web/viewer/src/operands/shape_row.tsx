// One operand in a panel: its role and colour, its name among those to choose from, a file in its place, or none.
import { shapeOfFile, type Shape } from '../engine/shape';
import { chooseFiles } from '../shell/files';

interface ShapeRowProps {
  role: string;
  /** the role's colours: --p and --p-fill for "p" */
  tint: string;
  /** of the list of shapes, for those who do not see it */
  label: string;
  catalogue: readonly Shape[];
  shape: Shape | null;
  /** how many vertices or faces it has */
  size?: number | undefined;
  onShape: (shape: Shape) => void;
  /** where the shape may be left out */
  onNone?: () => void;
}

export function ShapeRow({ role, tint, label, catalogue, shape, size, onShape, onNone }: ShapeRowProps) {
  const isKnown = catalogue.some((s) => s.name === shape?.name);
  const choose = (name: string): void => {
    const chosen = catalogue.find((s) => s.name === name);
    if (chosen) onShape(chosen);
  };
  return (
    <div class="row">
      <svg class="swatch" viewBox="0 0 14 14" aria-hidden="true">
        <rect x="1" y="1" width="12" height="12" rx="2" fill={`var(--${tint}-fill)`} stroke={`var(--${tint})`} stroke-width="2" />
      </svg>
      <strong>{role}</strong>
      <select aria-label={label} value={isKnown ? shape!.name : ''} onChange={(e) => choose(e.currentTarget.value)} style={{ flex: 1, minWidth: 0 }}>
        {!isKnown && <option value="">{shape?.name ?? 'add one …'}</option>}
        {catalogue.map(({ name }) => (
          <option key={name}>{name}</option>
        ))}
      </select>
      <span style={{ color: 'var(--quiet)' }}>{size ?? ''}</span>
      <button aria-label={`Open a file as ${role}`} onClick={() => chooseFiles((files) => onShape(shapeOfFile(files[0]!)))}>
        Open…
      </button>
      {shape && onNone && (
        <button class="plain" style={{ padding: '0 6px' }} aria-label={`Leave out ${role}`} title={`Leave out ${role}`} onClick={onNone}>
          ×
        </button>
      )}
    </div>
  );
}
