import type { ComponentType } from 'preact';
import { useEffect, useRef } from 'preact/hooks';
import { painter } from '../state/page';
import { entry, inputRole, outcome, picture, tool } from '../state/store';
import { listenToGestures } from '../stage/gestures';
import { toPicture } from '../stage/view';
import { comparable, stageSize, view } from '../stage/viewport';
import { toggleAt } from '../state/pebbles';
import { chooseAt, onWoodKey } from '../state/wood';
import type { Tool } from '../techniques/entry';
import { Divider } from './Divider';
import { LayerSwitches } from './LayerSwitches';
import { PieceLabel } from './PieceLabel';
import { EdgesSheet } from './EdgesSheet';
import { GridSheet } from './GridSheet';
import { Guides } from './Guides';
import { ChosenPebbles, onPebbleKey, PebbleSheet, PebbleTools } from './PebbleTools';
import { Regions } from './Regions';
import { Sketch } from './Sketch';
import { ChosenPiece } from './ChosenPiece';
import { StageRuler } from './Ruler';
import { ZoomTools } from './ZoomTools';

/** What lies over the stage while it is drawn on. */
const kTools: Partial<Record<Tool, ComponentType>> = {
  sketch: Sketch,
  guides: Guides,
  regions: Regions,
  grid: GridSheet,
  edges: EdgesSheet,
  pick: PebbleSheet,
  split: PebbleSheet,
  add: PebbleSheet,
  ruler: PebbleSheet,
};

export function Stage() {
  const ToolHere = tool.value && kTools[tool.value];
  const { solid, panels } = entry.value;
  const onKey = solid ? onPebbleKey : panels && onWoodKey;
  return (
    <section class="stage" aria-label="Stage" onKeyDown={onKey}>
      <StageCanvas />
      {solid && <ChosenPebbles />}
      {panels && <ChosenPiece />}
      {panels && <StageRuler />}
      {ToolHere ? (
        <ToolHere />
      ) : (
        <>
          {comparable.value && <Divider />}
          <LayerSwitches />
          <PieceLabel />
        </>
      )}
      {solid && <PebbleTools />}
      <ZoomTools />
    </section>
  );
}

function StageCanvas() {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = box.current;
    const canvas = element?.querySelector('canvas');
    if (!element || !canvas) return;
    const offscreen = canvas.transferControlToOffscreen();
    painter.postMessage({ type: 'canvas', canvas: offscreen }, [offscreen]);
    const resized = new ResizeObserver(() => {
      const { clientWidth: width, clientHeight: height } = element;
      stageSize.value = { width, height };
      painter.postMessage({ type: 'stage', width, height, ratio: devicePixelRatio });
    });
    resized.observe(element);
    const silence = listenToGestures(element, (at) => {
      const place = toPicture(view.value, at);
      if (entry.value.solid) toggleAt(place);
      if (entry.value.panels) chooseAt(place);
    });
    return () => {
      resized.disconnect();
      silence();
    };
  }, []);
  return (
    <div
      ref={box}
      class="stage-canvas"
      tabIndex={0}
      role="img"
      aria-label={description()}
      aria-describedby="stage-keys"
    >
      <canvas />
      <p id="stage-keys" class="unseen">
        Arrow keys move, plus and minus zoom, 0 fits, 1 shows true size.
        {entry.value.panels && ' N and B choose the next piece and the one before, Escape none.'}
      </p>
    </div>
  );
}

function description(): string {
  const { value: done } = outcome;
  const facts = done ? `: ${entry.value.facts(done.result).join(', ')}` : '';
  const of = inputRole.value ? ` of ${picture.value?.name ?? 'nothing yet'}` : '';
  return `${entry.value.title}${of}${facts}`;
}
