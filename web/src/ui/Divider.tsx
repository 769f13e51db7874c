import { ChevronsLeftRight } from 'lucide-preact';
import { divider } from '../stage/viewport';

const kStep = 0.02;

const set = (value: number) => (divider.value = Math.min(1, Math.max(0, value)));

function onKey(event: KeyboardEvent): void {
  const steps: Record<string, number> = {
    ArrowLeft: divider.value - kStep,
    ArrowDown: divider.value - kStep,
    ArrowRight: divider.value + kStep,
    ArrowUp: divider.value + kStep,
    PageDown: divider.value - 5 * kStep,
    PageUp: divider.value + 5 * kStep,
    Home: 0,
    End: 1,
  };
  const next = steps[event.key];
  if (next === undefined) return;
  event.preventDefault();
  set(next);
}

function onMove(event: PointerEvent & { currentTarget: HTMLElement }): void {
  if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
  const box = event.currentTarget.parentElement?.getBoundingClientRect();
  if (box) set((event.clientX - box.left) / box.width);
}

/** Drag it over the stage: the picture on its left, the pieces on its right. */
export function Divider() {
  const percent = Math.round(divider.value * 100);
  return (
    <>
      {divider.value > 0 && <div class="divider-line" style={{ left: `${divider.value * 100}%` }} />}
      {divider.value > 0.08 && (
        <span class="divider-word before" style={{ right: `${100 - divider.value * 100}%` }}>
          before
        </span>
      )}
      {divider.value > 0 && divider.value < 0.92 && (
        <span class="divider-word" style={{ left: `${divider.value * 100}%` }}>
          after
        </span>
      )}
      <div
        class="divider-grip"
        role="slider"
        tabIndex={0}
        aria-label="Before and after"
        aria-valuemin={0}
        aria-valuemax={100}
        aria-valuenow={percent}
        aria-valuetext={`${percent}% before`}
        title="Drag to compare with the picture"
        style={{ left: `clamp(22px, ${divider.value * 100}%, calc(100% - 22px))` }}
        onKeyDown={onKey}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={onMove}
        onDblClick={() => set(0)}
      >
        <ChevronsLeftRight size={18} aria-hidden />
      </div>
    </>
  );
}
