import type { Page, PageProps } from '../../shell/page';
import { parseShape, shapeOfFile, type Shape } from '../../engine/shape';
import { useAnswer } from '../../engine/use_answer';
import { Panel, Stage } from '../../shell/parts';

interface SumState {
  p: Shape;
  q: Shape;
}

const kSummary = 'P ⊕ Q: all sums of a point of P and a point of Q.';

function View({ state, shell }: PageProps<SumState>) {
  const frame = useAnswer(shell.engine, 'sumFrame', { p: state.p, q: state.q });
  return (
    <>
      <Stage>
        <canvas aria-label="The sum" />
      </Stage>
      <Panel summary={kSummary}>{frame.value?.shape.vertices.length}</Panel>
    </>
  );
}

export const sumPage: Page<SumState> = {
  id: 'sum',
  title: 'Sum',
  summary: kSummary,
  examples: [{ name: 'gear and star', state: { p: { name: 'gear', make: 'gear', args: [12, 3, 4] }, q: { name: 'star', make: 'star', args: [5, 0.5, 1] } } }],
  parse: (value) => {
    const { p, q } = value as Record<string, unknown>;
    return { p: parseShape(p), q: parseShape(q) };
  },
  take: (files, state) => ({ ...state, p: shapeOfFile(files[0]!) }),
  View,
};
