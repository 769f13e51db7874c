import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { Brush, Grid2x2Check, Grid3x3, Images, ImageUp, Paintbrush, Spline, Type, X } from 'lucide-preact';
import { leaveLabels, takesLabels, useLabels } from '../state/labels';
import { usePicture, useSample } from '../state/pictures';
import { leaveShapes, takesShapes, useShapes } from '../state/shapes';
import { startSketch } from '../state/sketch';
import { byLabels, drawn, entry, labels, picture, tool, usesTools } from '../state/store';
import { addTargets, removeTarget, targets } from '../state/targets';
import { useWord } from '../state/word';

export const kPictureTypes = 'image/png,image/jpeg,image/webp,image/bmp,image/gif,image/tiff,.tif,.tiff';

/** Where the picture comes from: a file, the brush, a word, or one of the samples. */
export function PictureInput() {
  const typing = useSignal(false);
  return (
    <section class="group" aria-labelledby="picture-title">
      <h2 id="picture-title">Picture</h2>
      <div class="sources" data-wraps={entry.value.panels !== undefined}>
        <label class="source">
          <input type="file" class="unseen" accept={kPictureTypes} onChange={onFile} />
          <ImageUp size={20} aria-hidden />
          {entry.value.pictureTitle ?? 'Image'}
        </label>
        {entry.value.panels && <TargetsButton />}
        {takesLabels() && <LabelsButton hint={kPebblesHint} types={kPictureTypes} use={useLabels} />}
        {takesShapes() && (
          <LabelsButton hint={kShapesHint} types={`${kPictureTypes},image/svg+xml,.svg`} use={useShapes} />
        )}
        {(usesTools.value ? entry.value.tools : []).map((name) =>
          name === 'word' ? (
            <button
              type="button"
              key={name}
              class="source"
              aria-expanded={typing.value}
              aria-controls="word"
              onClick={() => (typing.value = !typing.value)}
            >
              <Type size={20} aria-hidden />
              Type
            </button>
          ) : (
            <ToolButton key={name} name={name} />
          ),
        )}
      </div>
      {typing.value && entry.value.tools.includes('word') && <WordField />}
      <div class="samples" role="group" aria-label="Samples">
        {entry.value.samples.map((sample) => (
          <button
            type="button"
            key={sample.name}
            class="sample"
            aria-pressed={picture.value?.sample === sample.name}
            onClick={() => {
              tool.value = null;
              void useSample(sample);
            }}
          >
            <img
              src={`samples/thumbnails/${sample.file}`}
              alt=""
              width={76}
              height={56}
              decoding="async"
              draggable={false}
            />
            {sample.title}
          </button>
        ))}
      </div>
      {picture.value && picture.value.sample === null && (
        <p class="picture-name" title={picture.value.name}>
          {picture.value.name}
          <span>
            {' '}
            {picture.value.width} × {picture.value.height}
          </span>
        </p>
      )}
      {entry.value.panels && <TargetList />}
      {takesLabels() && byLabels.value && labels.value && (
        <LabelsName
          of="pebbles"
          name={labels.value.name}
          instead="Search for the pebbles instead"
          leave={leaveLabels}
        />
      )}
      {takesShapes() && drawn.value.shapes && (
        <LabelsName of="pieces" name={drawn.value.shapes.name} instead="Lay a grid instead" leave={leaveShapes} />
      )}
    </section>
  );
}

const kTools = {
  sketch: { title: 'Draw', hint: 'Draw the picture with a brush', Icon: Brush },
  guides: { title: 'Curves', hint: 'Draw curves that the rows of tiles follow', Icon: Spline },
  regions: { title: 'Sizes', hint: 'Paint where tiles are large and where small', Icon: Paintbrush },
  grid: { title: 'Corners', hint: 'Drag the corners of the grid to where you want them', Icon: Grid3x3 },
  edges: { title: 'Edges', hint: 'Paint which edges of the picture the grid follows', Icon: Brush },
};

function ToolButton({ name }: { name: keyof typeof kTools }) {
  const { title, hint, Icon } = kTools[name];
  const start = () => (name === 'sketch' ? startSketch() : (tool.value = name));
  return (
    <button
      type="button"
      class="source"
      title={hint}
      aria-pressed={tool.value === name}
      onClick={() => (tool.value === name ? (tool.value = null) : start())}
    >
      <Icon size={20} aria-hidden />
      {title}
    </button>
  );
}

/** More pictures of the same wood. */
function TargetsButton() {
  return (
    <label class="source" title="More pictures to be made of the same wood, as large as the first">
      <input
        type="file"
        multiple
        class="unseen"
        accept={kPictureTypes}
        onChange={({ currentTarget: input }) => {
          void addTargets([...(input.files ?? [])]);
          input.value = '';
        }}
      />
      <Images size={20} aria-hidden />
      More
    </label>
  );
}

function TargetList() {
  return targets().map((target) => (
    <p key={target.name} class="picture-name labels-name" title={target.name}>
      <span>and</span> {target.name}
      <button
        type="button"
        class="tool"
        aria-label={`Remove ${target.name}`}
        title={`Without ${target.name}`}
        onClick={() => removeTarget(target)}
      >
        <X size={15} aria-hidden />
      </button>
    </p>
  ));
}

const kPebblesHint =
  "A picture of the photo's size that says where the pebbles are: each number or colour one, black the ground";
const kShapesHint =
  "The pieces' shapes: a picture of the target's proportions, a number or colour each, or an SVG of closed paths";

interface LabelsProps {
  hint: string;
  types: string;
  use(file: File): Promise<void>;
}

/** Where the pebbles, or the pieces, are, from another program. */
function LabelsButton({ hint, types, use }: LabelsProps) {
  return (
    <label class="source" title={hint}>
      <input
        type="file"
        class="unseen"
        accept={types}
        onChange={({ currentTarget: input }) => {
          const file = input.files?.[0];
          if (file) void use(file);
          input.value = '';
        }}
      />
      <Grid2x2Check size={20} aria-hidden />
      Segmentation
    </label>
  );
}

interface LabelsNameProps {
  of: string;
  name: string;
  instead: string;
  leave(): void;
}

function LabelsName({ of, name, instead, leave }: LabelsNameProps) {
  return (
    <p class="picture-name labels-name" title={name}>
      <span>{of} by</span> {name}
      <button type="button" class="tool" aria-label="Remove segmentation" title={instead} onClick={leave}>
        <X size={15} aria-hidden />
      </button>
    </p>
  );
}

async function onFile(event: Event & { currentTarget: HTMLInputElement }): Promise<void> {
  const input = event.currentTarget;
  const file = input.files?.[0];
  if (!file) return;
  tool.value = null;
  await usePicture(file, file.name);
  input.value = ''; // so that the same file can be chosen again
}

function WordField() {
  const text = useSignal('');
  const input = useRef<HTMLInputElement>(null);
  useEffect(() => input.current?.focus(), []);
  return (
    <form
      id="word"
      class="word"
      onSubmit={(event) => {
        event.preventDefault();
        tool.value = null;
        void useWord(text.value);
      }}
    >
      <input
        ref={input}
        type="text"
        aria-label="Word"
        placeholder="A word, such as Rio"
        maxLength={40}
        value={text.value}
        onInput={(event) => (text.value = event.currentTarget.value)}
      />
      <button type="submit" class="button" disabled={!text.value.trim()}>
        Pave it
      </button>
    </form>
  );
}
