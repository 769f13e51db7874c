import { piece } from '../state/store';

const number = new Intl.NumberFormat('en');
const area = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** What the pointer is on: "stone 1,204: 71 px², 4 sides". */
export function PieceLabel() {
  const { value: facts } = piece;
  if (!facts) return null;
  const { kind, id, area: size, vertices, orientation } = facts;
  return (
    <p class="piece-label">
      <strong>
        {kind} {number.format(id)}
      </strong>
      : {area.format(size)} px², {vertices} sides
      <span
        class="piece-direction"
        style={{ transform: `rotate(${orientation}deg)` }}
        title={`lies at ${area.format(orientation)}°`}
      />
    </p>
  );
}
