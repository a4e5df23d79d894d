// A region among the operands, and what can be done where its file is refused.
import { isMade, type Shape } from '../engine/shape';
import type { Shell } from '../shell/page';
import { kCatalogue } from './catalogue';
import { RepairRow } from './repair_row';
import { ShapeRow } from './shape_row';
import type { Operand } from './use_operand';

interface OperandCardProps {
  role: string;
  tint: string;
  shape: Shape;
  operand: Operand;
  onShape: (shape: Shape) => void;
  onNone?: () => void;
  /** beside the catalogue */
  choices?: readonly Shape[];
  shell: Shell;
}

export function OperandCard({ shape, operand, choices = [], shell, ...row }: OperandCardProps) {
  const { outline, error } = operand;
  return (
    <>
      <ShapeRow {...row} label={`Shape of ${row.role}`} catalogue={[...choices, ...kCatalogue]} shape={shape} size={outline && outline.shape.vertices.length / 2} />
      {error && <p class="refused">{error.message}</p>}
      {error && !isMade(shape) && <RepairRow role={row.role} shape={shape} shell={shell} onShape={row.onShape} />}
    </>
  );
}
