import { entry, outcome, piece } from '../state/store';
import { cuts, shownPiece } from '../state/wood';
import type { PieceFacts } from '../worker/protocol';

const number = new Intl.NumberFormat('en');
const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
const length = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

/** What the pointer is on: "stone 1,204: 71 px², 4 sides"; "pebble 12: 54 × 46 mm". */
export function PieceLabel() {
  const { value: facts } = piece;
  if (entry.value.panels) return <CutLabel />;
  if (!facts) return null;
  const axes = axesOf(facts);
  const { kind, id, area, vertices, orientation } = facts;
  const lies = axes?.direction ?? orientation;
  return (
    <p class="piece-label">
      <strong>
        {kind} {number.format(id)}
      </strong>
      {axes
        ? `: ${length.format(axes.a)} × ${length.format(axes.b)} mm`
        : `: ${whole.format(area)} px², ${vertices} sides`}
      <span
        class="piece-direction"
        style={{ transform: `rotate(${lies}deg)` }}
        title={`lies at ${whole.format(lies)}°`}
      />
    </p>
  );
}

/** "C12: row 12, column 3, cost 51,171". */
function CutLabel() {
  const cut = shownPiece.value < 0 ? undefined : cuts.value[shownPiece.value];
  if (!cut) return null;
  return (
    <p class="piece-label">
      <span>
        <strong>{cut.id}</strong>
        {`: row ${cut.row}, column ${cut.column}, cost ${number.format(cut.cost)}`}
      </span>
    </p>
  );
}

/** Of a piece that was measured: its axes in mm, and where the longer one points, degrees from x towards y. */
function axesOf({ id }: PieceFacts): { a: number; b: number; direction: number } | null {
  const { ids, columns } = outcome.value?.pieces ?? {};
  const i = ids?.indexOf(id) ?? -1;
  const [a, b, direction] = ['a_mm', 'b_mm', 'a_axis_deg'].map((name) => columns?.[name]?.[i]);
  return a === undefined || b === undefined || direction === undefined ? null : { a, b, direction };
}
