import { currentParams, picture } from '../state/store';
import { view } from '../stage/viewport';

const kLetter = 10; // CSS px

/** Along the target: how large it will be. */
export function StageRuler() {
  const { width = 0, height = 0 } = picture.value ?? {};
  const mm = Number(currentParams()['imageSizeMm']) / Math.min(width, height); // to a pixel
  const { scale, x, y } = view.value;
  if (!(mm > 0 && mm < Infinity)) return null;
  return (
    <svg class="chosen-pebbles" aria-hidden="true">
      <g transform={`translate(${x} ${y}) scale(${scale / mm})`}>
        <Ruler width={width * mm} height={height * mm} letter={(kLetter * mm) / scale} />
      </g>
    </svg>
  );
}

interface Props {
  /** mm. */
  width: number;
  height: number;
  /** How high its figures are, mm. */
  letter: number;
}

const kSteps = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
const kApart = 4; // figures' heights between two of them

/** Millimetres along the upper and the left side of what it lies on, whose units they are. */
export function Ruler({ width, height, letter }: Props) {
  const figures = kSteps.find((step) => step >= kApart * letter) ?? 2000;
  const fine = figures / 10;
  let lines = '';
  for (let i = 1; i * fine < width; ++i) lines += `M${i * fine} 0V${letter * tickOf(i)}`;
  for (let i = 1; i * fine < height; ++i) lines += `M0 ${i * fine}H${letter * tickOf(i)}`;
  const places = (length: number) =>
    Array.from({ length: Math.floor((length - letter) / figures) }, (_, i) => (i + 1) * figures);
  return (
    <g class="ruler" style={{ fontSize: `${letter}px` }}>
      <path d={lines} />
      {places(width).map((at) => (
        <text key={at} x={at + letter * 0.2} y={letter * 1.3}>
          {at}
        </text>
      ))}
      {places(height).map((at) => (
        <text key={`${at} down`} x={letter * 0.5} y={at + letter}>
          {at}
        </text>
      ))}
    </g>
  );
}

const tickOf = (i: number) => (i % 10 === 0 ? 1 : i % 5 === 0 ? 0.6 : 0.35);
