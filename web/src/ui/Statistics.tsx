import { useSignal } from '@preact/signals';
import { ChevronDown, Download } from 'lucide-preact';
import type { Measured, Plot } from 'tessera-wasm';
import { figuresOf } from '../state/figures';
import { reportText, statistics, statisticsProblem, unfolded, upToDate } from '../state/statistics';
import { entry } from '../state/store';
import { save } from './Bar';
import { Chart } from './Chart';

/** What the chips are called. */
const kTitles: Readonly<Record<string, string>> = {
  same_cell: 'W(d)',
  ripley_k: 'K',
  pair_correlation: 'g',
  transitions: 'Colours',
  autocorrelation: 'Autocorrelation',
};

const titleOf = ({ name, title }: Plot) => kTitles[name] ?? title;

/** Below the stage: the measured curve over the model's closed form, and numbers beside theirs. */
export function Statistics() {
  const { value: open } = unfolded;
  return (
    <section class="statistics" aria-labelledby="statistics-title">
      <h2 id="statistics-title">
        <button
          type="button"
          class="fold"
          aria-expanded={open}
          aria-controls="statistics"
          onClick={() => (unfolded.value = !open)}
        >
          Statistics
          <ChevronDown size={16} aria-hidden />
        </button>
      </h2>
      <div
        id="statistics"
        class="statistics-body"
        hidden={!open}
        aria-busy={!upToDate.value && !statisticsProblem.value}
      >
        {open && <Inside />}
      </div>
    </section>
  );
}

function Inside() {
  const { value: taken } = statistics;
  if (statisticsProblem.value) return <p role="alert">{statisticsProblem.value}</p>;
  if (!taken) return <p class="statistics-wait">Measuring…</p>;
  return <Results {...taken} measured={taken.measured} />;
}

function Results(taken: NonNullable<typeof statistics.value>) {
  const { report, plots, csv } = taken.measured;
  const chosen = useSignal('');
  const plot = plots.find(({ name }) => name === chosen.value) ?? plots[0];
  if (!plot) return null;
  return (
    <>
      <div class="statistics-plot">
        <div class="plot-choice" role="group" aria-label="Curve">
          {plots.map((each) => (
            <button
              type="button"
              key={each.name}
              class="chip"
              title={each.title}
              aria-pressed={each === plot}
              onClick={() => (chosen.value = each.name)}
            >
              {titleOf(each)}
            </button>
          ))}
        </div>
        <Chart plot={plot} />
      </div>
      <div class="statistics-side">
        <Figures report={report} />
        <p class="statistics-files">
          <Saved title="JSON" name="statistics.json" type="application/json" text={() => reportText(taken)} />
          <Saved title="CSV" name="statistics.csv" type="text/csv" text={() => csv} />
          <Saved title="SVG" name={`${plot.name}.svg`} type="image/svg+xml" text={() => plot.svg} />
        </p>
      </div>
    </>
  );
}

function Figures({ report }: { report: Measured['report'] }) {
  const rows = figuresOf(report);
  const compared = rows.some(({ expected }) => expected);
  return (
    <table class="figures">
      <thead>
        <tr>
          <td />
          <th scope="col">measured</th>
          {compared && <th scope="col">{report.kind === 'points' ? 'Poisson' : 'closed form'}</th>}
        </tr>
      </thead>
      <tbody>
        {rows.map(({ title, colour, measured, expected }) => (
          <tr key={title}>
            <th scope="row">
              {colour && <span class="figure-colour" style={{ background: colour }} />}
              {title}
            </th>
            <td>{measured}</td>
            {compared && <td>{expected || '–'}</td>}
          </tr>
        ))}
      </tbody>
      {report.kind === 'picture' && <caption>Of the PNG; lengths in its pixels</caption>}
      {report.kind === 'cells' && !report['comparison'] && (
        <caption>{entry.value.title}s of this kind have no closed form here</caption>
      )}
    </table>
  );
}

function Saved({ title, name, type, text }: { title: string; name: string; type: string; text(): string }) {
  const press = () => {
    const address = URL.createObjectURL(new Blob([text()], { type }));
    save({ address, name });
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
  };
  return (
    <button type="button" class="link" aria-label={`Save statistics as ${title}`} onClick={press}>
      <Download size={13} aria-hidden />
      {title}
    </button>
  );
}
