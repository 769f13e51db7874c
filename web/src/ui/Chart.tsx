import type { Plot } from 'tessera-wasm';
import { axisOf, pathOf, placeOn, type Axis, type Place } from '../stage/chart';

const kWidth = 460;
const kHeight = 150;
const kLeft = 50;
const kRight = 14;
const kTop = 10;
const kBottom = 40;
const kDot = 2.6;

const kLong = 10_000; // is written shorter

const small = new Intl.NumberFormat('en', { maximumSignificantDigits: 4 });
const large = new Intl.NumberFormat('en', { maximumSignificantDigits: 3, notation: 'compact' });
const shown = (value: number) => (Math.abs(value) < kLong ? small : large).format(value);

/** Curves or bars over axes; what was measured in the accent, a closed form as a line beside it. */
export function Chart({ plot }: { plot: Plot }) {
  const { bins } = plot;
  const across = bins
    ? null
    : axisOf(
        plot.series.flatMap(({ points = [] }) => points.map(([x]) => x)),
        7,
      );
  const values = plot.series.flatMap(({ points, values = [] }) => points?.map(([, v]) => v) ?? values);
  const up = axisOf(values, 4);
  const y = (value: number) => (1 - placeOn(up, value)) * kHeight;
  return (
    <figure class="chart">
      <svg
        viewBox={`${-kLeft} ${-kTop} ${kLeft + kWidth + kRight} ${kTop + kHeight + kBottom}`}
        role="img"
        aria-label={description(plot)}
      >
        {up.ticks.map((tick) => (
          <g key={tick} transform={`translate(0 ${y(tick)})`}>
            <path class="chart-grid" d={`M0 0H${kWidth}`} />
            <text x={-7} y={4.5} text-anchor="end">
              {shown(tick)}
            </text>
          </g>
        ))}
        {across && <Ticks axis={across} />}
        {bins && <Bars bins={bins} values={plot.series[0]?.values ?? []} y={y} />}
        {across && plot.series.map((series, i) => <Curve key={series.name} {...{ series, i, across, up }} />)}
        <text class="chart-label" x={kWidth} y={kHeight + 34} text-anchor="end">
          {plot.xLabel}
        </text>
      </svg>
      <figcaption>
        {plot.series.map(({ name }, i) => (
          <span key={name} class="chart-key" data-series={i}>
            {name}
          </span>
        ))}
      </figcaption>
    </figure>
  );
}

const Ticks = ({ axis }: { axis: Axis }) => (
  <>
    {axis.ticks.map((tick) => (
      <g key={tick} transform={`translate(${placeOn(axis, tick) * kWidth} ${kHeight})`}>
        <path class="chart-grid" d="M0 0v4" />
        <text y={17} text-anchor="middle">
          {shown(tick)}
        </text>
      </g>
    ))}
  </>
);

interface CurveProps {
  series: Plot['series'][number];
  i: number;
  across: Axis;
  up: Axis;
}

/** The first is what was measured, at the places where it was. */
function Curve({ series: { points = [] }, i, across, up }: CurveProps) {
  const places: readonly Place[] = points;
  const dotted = i === 0 && points.length <= 30;
  return (
    <g class="chart-series" data-series={i}>
      <path d={pathOf(places, across, up, kWidth, kHeight)} />
      {dotted &&
        places.map(([u, v]) => (
          <circle key={u} cx={placeOn(across, u) * kWidth} cy={(1 - placeOn(up, v)) * kHeight} r={kDot} />
        ))}
    </g>
  );
}

function Bars({ bins, values, y }: { bins: string[]; values: number[]; y: (value: number) => number }) {
  const step = kWidth / bins.length;
  const width = Math.min(step * 0.7, 48);
  return (
    <g class="chart-bars">
      {bins.map((bin, i) => (
        <g key={bin} transform={`translate(${(i + 0.5) * step} 0)`}>
          <rect x={-width / 2} width={width} y={y(values[i] ?? 0)} height={y(0) - y(values[i] ?? 0)} />
          <text y={kHeight + 17} text-anchor="middle">
            {bin}
          </text>
        </g>
      ))}
    </g>
  );
}

/** In words, for those who do not see it. */
function description({ title, xLabel, bins, series }: Plot): string {
  const [measured, expected] = series;
  if (bins) {
    const parts = bins.map((bin, i) => `${bin}: ${shown(measured?.values?.[i] ?? 0)}`);
    return `${title}, by ${xLabel}: ${parts.join(', ')}`;
  }
  const [first, last] = [measured?.points?.[0], measured?.points?.at(-1)];
  if (!first || !last) return title;
  const beside = expected ? `, beside ${expected.name}` : '';
  const [from, to] = [first, last].map(([x, v]) => `${shown(v)} at ${shown(x)}`);
  return `${title}, by ${xLabel}: from ${from} to ${to}${beside}`;
}
