// What can be done about a file that is refused: the library's repair, or one of several shapes.
import { useState } from 'preact/hooks';
import type { FileShape, Shape } from '../engine/shape';
import type { Shell } from '../shell/page';

interface RepairRowProps {
  role: string;
  shape: FileShape;
  shell: Shell;
  onShape: (shape: Shape) => void;
}

interface Choices {
  of: FileShape;
  shapes: FileShape[];
}

export function RepairRow({ role, shape, shell, onShape }: RepairRowProps) {
  const [choices, setChoices] = useState<Choices | undefined>();
  const repair = async (): Promise<void> => {
    const all = await shell.engine.ask('shapesOfFile', { shape, repair: true });
    const shapes = all.map(({ name, text }) => ({ name: `${name || shape.name}*.wkt`, text }));
    if (shapes.length === 1) onShape(shapes[0]!);
    else setChoices({ of: shape, shapes });
  };
  if (choices?.of === shape)
    return (
      <select aria-label={`Shapes of the file of ${role}`} onChange={(e) => onShape(choices.shapes[e.currentTarget.selectedIndex - 1]!)}>
        <option>choose one of {choices.shapes.length} shapes</option>
        {choices.shapes.map(({ name }) => (
          <option key={name}>{name.replace(/\*\.wkt$/, '')}</option>
        ))}
      </select>
    );
  return (
    <div class="row">
      <button aria-label={`Repair ${role}`} onClick={() => void repair().catch(shell.report)}>
        Repair, or choose one of several shapes
      </button>
    </div>
  );
}
