// Sentences about contacts and answers.
import type { Clearance, Contact, NoPath } from 'dymsum';
import { degrees, short } from '../../numbers/display';

/** `p` is the obstacle, `q` the robot. */
export function contactText({ kind, p, q }: Contact): string {
  return kind === 'edge_of_p' ? `edge ${p} of the obstacle, vertex ${q} of the robot` : `vertex ${p} of the obstacle, edge ${q} of the robot`;
}

export function clearanceText({ distance, error }: Clearance, overlaps: boolean): string {
  if (distance === 0 && error === 0) return 'touches';
  return overlaps ? `overlaps, depth ${short(-distance)}` : `free, clearance ${short(distance)}`;
}

const kReasons: Record<NoPath['kind'], string> = {
  start_not_free: 'The start is not free.',
  goal_not_free: 'The goal is not free.',
  separated: 'There is no path: the obstacle separates start and goal.',
  undecided: 'Undecided.',
};

/** The reason in a line, and the engine's own sentence. */
export function noPathTexts(reason: NoPath): { title: string; text: string } {
  const contact = reason.contact ? ` Contact: ${contactText(reason.contact)}.` : '';
  return { title: kReasons[reason.kind], text: reason.text.charAt(0).toUpperCase() + reason.text.slice(1) + (/[.!]$/.test(reason.text) ? '' : '.') + contact };
}

/** Angles at which the robot is free where it stands. */
export function freeAnglesText(angles: readonly { begin: number; end: number }[]): string {
  if (angles.length === 0) return 'none';
  const whole = angles.length === 1 && angles[0]!.end - angles[0]!.begin >= 2 * Math.PI - 1e-9;
  if (whole) return 'all';
  const shown = angles.slice(0, 4).map(({ begin, end }) => (begin === end ? degrees(begin) : `${degrees(begin)} to ${degrees(end)}`));
  return shown.join(', ') + (angles.length > 4 ? `, and ${angles.length - 4} more` : '');
}
