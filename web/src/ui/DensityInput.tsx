import { ImageUp, X } from 'lucide-preact';
import { changeDensity } from '../state/edits';
import { usePicture } from '../state/pictures';
import { drawn, known, params } from '../state/store';
import { kPictureTypes } from './PictureInput';

/** Of a technique that needs no picture: one that tells where points are many. */
export function DensityInput() {
  const { density } = drawn.value;
  return (
    <section class="group" aria-labelledby="picture-title">
      <h2 id="picture-title">Picture</h2>
      <div class="sources">
        <label class="source" title={known.value?.inputs[0]?.help}>
          <input type="file" class="unseen" accept={kPictureTypes} onChange={onFile} />
          <ImageUp size={20} aria-hidden />
          Image
        </label>
      </div>
      {!density && <p class="picture-hint">None is needed. Points are many where one is dark.</p>}
      {density && (
        <p class="picture-name">
          {density.name}
          <button
            type="button"
            class="tool"
            aria-label={`Remove ${density.name}`}
            title={`Remove ${density.name}`}
            onClick={() => changeDensity(null, params.value)}
          >
            <X size={15} aria-hidden />
          </button>
        </p>
      )}
    </section>
  );
}

async function onFile(event: Event & { currentTarget: HTMLInputElement }): Promise<void> {
  const input = event.currentTarget;
  const file = input.files?.[0];
  if (!file) return;
  await usePicture(file, file.name);
  input.value = ''; // so that the same file can be chosen again
}
