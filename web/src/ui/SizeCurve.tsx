import { Ruler } from 'lucide-preact';
import { curvePath, placeOf, sizeCurve } from '../stage/sizes';
import { half, scaleIsKnown } from '../state/pebbles';
import { outcome, tool } from '../state/store';

const kWidth = 420;
const kHeight = 104;
const kMarks = [16, 50, 84] as const;
const size = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

/** What part of the pebbles is finer than a size, with the sizes that 16, 50 and 84 % of them do not exceed. */
export function SizeCurve() {
  const { value: done } = outcome;
  const curve = sizeCurve(done?.pieces?.columns['b_mm'] ?? []);
  if (!done || !curve) return null;
  const marks = kMarks.map((percent) => ({ percent, at: done.result.metrics[`d${percent}_mm`] ?? 0 }));
  const words = marks.map(({ percent, at }) => `D${percent} ${size.format(at)} mm`);
  const x = (at: number) => placeOf(curve, at) * kWidth;
  return (
    <section class="sizes" aria-labelledby="sizes-title">
      <div class="sizes-head">
        <h2 id="sizes-title">Grain sizes</h2>
        {marks.map(({ percent, at }) => (
          <span key={percent}>
            D<sub>{percent}</sub> <strong>{size.format(at)}</strong> mm
          </span>
        ))}
      </div>
      <svg
        viewBox={`-42 -8 ${kWidth + 58} ${kHeight + 30}`}
        role="img"
        aria-label={`Grain sizes: ${words.join(', ')}`}
      >
        {[0, 50, 100].map((percent) => (
          <g key={percent} transform={`translate(0 ${(1 - percent / 100) * kHeight})`}>
            <path class="sizes-grid" d={`M0 0H${kWidth}`} />
            <text x={-6} y={3.5} text-anchor="end">
              {percent}%
            </text>
          </g>
        ))}
        {curve.ticks.map((tick) => (
          <g key={tick} transform={`translate(${x(tick)} 0)`}>
            <path class="sizes-grid" d={`M0 0V${kHeight + 4}`} />
            <text y={kHeight + 17} text-anchor="middle">
              {size.format(tick)}
            </text>
          </g>
        ))}
        {marks.map(({ percent, at }) => (
          <path key={percent} class="sizes-mark" d={`M0 ${(1 - percent / 100) * kHeight}H${x(at)}V${kHeight}`} />
        ))}
        <path class="sizes-curve" d={curvePath(curve, kWidth, kHeight)} />
        {marks.map(({ percent, at }) => (
          <circle key={percent} class="sizes-dot" cx={x(at)} cy={(1 - percent / 100) * kHeight} r={3.5} />
        ))}
      </svg>
      <p class="sizes-foot">
        {scaleIsKnown.value ? (
          'Share of pebbles finer than a b axis, mm'
        ) : (
          <>
            b axis in mm, the photo taken as 1 m wide.{' '}
            <button
              type="button"
              class="link"
              onClick={() => {
                half.value = 'photo';
                tool.value = 'ruler';
              }}
            >
              <Ruler size={13} aria-hidden /> Set the scale
            </button>
          </>
        )}
      </p>
    </section>
  );
}
