import { ImageUp, Images, Play, X } from 'lucide-preact';
import type { Candidate, Job } from 'tessera-wasm';
import { partsOf, readColours } from '../state/colours';
import { cancelFit, fitPicture, fitProblem, fitted, fitting, knownPictures, useFit } from '../state/fit';
import { percent } from '../techniques/facts';
import { worded } from './ModelChoice';
import { kPictureTypes } from './PictureInput';

const number = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });
const kLattices = new Set(['checkerboard', 'hexagon', 'triangle', 'gaussian']);

/** A picture in, the model that explains it best out, and a button to make more of the same. */
export function FitInput() {
  const { value: busy } = fitting;
  return (
    <section class="group fit" aria-labelledby="fit-title" aria-busy={busy !== null}>
      <h2 id="fit-title">Fit a picture</h2>
      <div class="sources">
        <label class="source">
          <input type="file" class="unseen" accept={kPictureTypes} onChange={onFile} />
          <ImageUp size={20} aria-hidden />
          Picture to fit
        </label>
        {knownPictures().map(({ name, blob }) => (
          <button type="button" class="source" key={name} title={name} onClick={() => void fitPicture(blob, name)}>
            <Images size={20} aria-hidden />
            <span class="source-name">{name}</span>
          </button>
        ))}
      </div>
      {busy && <Going {...busy} />}
      {fitProblem.value && (
        <p class="field-problem" role="alert">
          {fitProblem.value}
        </p>
      )}
      {fitted.value && <Result {...fitted.value} />}
      {!busy && !fitted.value && !fitProblem.value && (
        <p class="picture-hint">Which model looks like it? Cells in a few colours, dropped here or chosen.</p>
      )}
      <p class="unseen" role="status">
        {fitted.value && `${fitted.value.name} looks like ${worded(fitted.value.fit.model)}`}
      </p>
    </section>
  );
}

async function onFile(event: Event & { currentTarget: HTMLInputElement }): Promise<void> {
  const input = event.currentTarget;
  const file = input.files?.[0];
  if (!file) return;
  void fitPicture(file, file.name);
  input.value = ''; // so that the same file can be chosen again
}

const Going = ({ name, fraction }: { name: string; fraction: number }) => (
  <div class="fit-going">
    <progress aria-label={`Fitting ${name}`} max={1} value={fraction} />
    <button type="button" class="tool" aria-label="Cancel fit" title="Cancel" onClick={() => void cancelFit()}>
      <X size={16} aria-hidden />
    </button>
  </div>
);

/** A model's one number, in words. */
function numberOf({ model, lambda }: Candidate): string {
  if (kLattices.has(model)) return `side ${number.format(lambda)} px`;
  if (model === 'poisson-lines') return `λ ${number.format(lambda)} lines per px`;
  return `λ ${number.format(lambda)} per px²`;
}

/** Those of the picture, with their shares. */
function Colours({ job: { params } }: { job: Job }) {
  const list = readColours(String(params['colors']), String(params['probabilities']));
  if (!list) return null;
  const parts = partsOf(list);
  return (
    <ul class="fit-colours" aria-label="Colours">
      {list.colours.map((colour, i) => {
        const words = `${colour}, ${percent.format(parts[i] ?? 0)} of all`;
        return (
          <li key={colour} title={words} style={{ background: colour, flexGrow: parts[i] ?? 0 }}>
            <span class="unseen">{words}</span>
          </li>
        );
      })}
    </ul>
  );
}

function Result({ name, fit }: NonNullable<typeof fitted.value>) {
  const [best, ...others] = fit.candidates;
  if (!best) return null;
  return (
    <div class="fit-result">
      <div class="fit-best">
        <img src={`models/${best.model}.png`} alt="" width={76} height={57} draggable={false} />
        <div>
          <p class="fit-name" title={name}>
            {name} looks like
          </p>
          <p>
            <strong>{worded(best.model)}</strong>
          </p>
          <p class="fit-number">{numberOf(best)}</p>
          <Colours job={fit.job} />
        </div>
        <button type="button" class="button primary slim" onClick={() => useFit(fit)}>
          <Play size={14} aria-hidden />
          Use
        </button>
      </div>
      <table class="figures">
        <caption>
          Distance from pictures that the model makes, in standard deviations; residual of W(d), root mean square
        </caption>
        <thead>
          <tr>
            <td />
            <th scope="col">distance</th>
            <th scope="col">residual</th>
          </tr>
        </thead>
        <tbody>
          {[best, ...others].map((each) => (
            <tr key={each.model}>
              <th scope="row">{worded(each.model)}</th>
              <td>{number.format(each.distance)}</td>
              <td>{number.format(each.w_residual)}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
