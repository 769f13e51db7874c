import { view } from '../stage/viewport';
import { outcome } from '../state/store';
import { pieceScale, shownPiece } from '../state/wood';
import { outlineOf } from './PebbleTools';

/** The piece of wood that is pointed at or was chosen, outlined on the finished picture. */
export function ChosenPiece() {
  const pieces = outcome.value?.pieces;
  if (!pieces || shownPiece.value < 0) return null;
  const { scale, x, y } = view.value;
  return (
    <svg class="chosen-pebbles chosen-piece" aria-hidden="true">
      <g transform={`translate(${x} ${y}) scale(${scale / pieceScale.value})`}>
        <path d={outlineOf(pieces, shownPiece.value)} />
      </g>
    </svg>
  );
}
