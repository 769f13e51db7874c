import { signal } from '@preact/signals';
import { Printer, Zap } from 'lucide-preact';
import { useEffect, useMemo } from 'preact/hooks';
import { dpiOf, found, marksOf, panels, seenOf } from '../state/panels';
import type { PanelFile } from '../state/drawn';
import { outcome, run } from '../state/store';
import { calm } from '../state/theme';
import { choosePiece, cutAt, cuts, onWoodKey, pointed, shownPiece } from '../state/wood';
import { counted, percent } from '../techniques/facts';
import { NoWood, ScanTools, ScanToolSheet, scanTool } from './ScanTools';
import { Ruler } from './Ruler';

const kInchMm = 25.4;
const kUnknownDpi = 300;
const kSecondsACut = 0.25; // of the preview, which hurries

/** Whether a dot goes along the cuts. */
const cutting = signal(false);

const length = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** Beside the finished piece: the wood that it is cut from. */
export function WoodView() {
  return (
    <div class="field-view wood-view" onKeyDown={onWoodKey}>
      <div
        class="wood-sheets"
        tabIndex={0}
        role="application"
        aria-label="Wood with its cuts. N and B choose the next piece and the one before, Escape none."
      >
        {panels().map((panel) => (
          <Sheet key={panel.name} panel={panel} />
        ))}
      </div>
      <WoodLabel />
      <div class="scan-tools tool-group" role="toolbar" aria-label="Scans">
        <ScanTools />
      </div>
      <div class="wood-tools tool-group">
        <CutPreview />
        <Assembly />
      </div>
    </div>
  );
}

function useAddress(blob: Blob | undefined): string | undefined {
  const address = useMemo(() => blob && URL.createObjectURL(blob), [blob]);
  useEffect(() => () => address && URL.revokeObjectURL(address), [address]);
  return address;
}

const outline = (ring: readonly number[]) => {
  let words = '';
  for (let k = 0; k < ring.length; k += 2)
    words += `${k ? 'L' : 'M'}${ring[k]!.toFixed(2)} ${ring[k + 1]!.toFixed(2)}`;
  return words && `${words}Z`;
};

function Sheet({ panel }: { panel: PanelFile }) {
  const made =
    run.value || scanTool.value ? undefined : outcome.value?.wood?.panels.find(({ name }) => name === panel.name);
  const address = useAddress(made?.picture);
  const { value: all } = cuts;
  const own = useMemo(
    () => all.filter((cut) => cut.panel === panel.name).map((cut) => outline(cut.onPanel)),
    [all, panel.name],
  );
  const seen = seenOf(panel);
  if (!seen) return null;
  const dpi = Number(dpiOf(panel)) || seen.dpi || kUnknownDpi;
  const width = made?.widthMm ?? (seen.width * kInchMm) / dpi;
  const height = made?.heightMm ?? (seen.height * kInchMm) / dpi;
  const chosen = shownPiece.value < 0 ? undefined : all[shownPiece.value];
  const marks = marksOf(panel);
  const scale = width / seen.width; // mm to a pixel of the scan
  const used = run.value ? undefined : outcome.value?.result.metrics[`wood_used_${panel.name}`];
  const pieceUnder = (event: PointerEvent & { currentTarget: SVGSVGElement }) => {
    const matrix = event.currentTarget.getScreenCTM();
    if (!matrix || run.value) return -1;
    return cutAt(panel.name, new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse()));
  };
  return (
    <figure class="wood-sheet" data-panel={panel.name} data-cuts={own.length}>
      <svg
        viewBox={`0 0 ${width} ${height}`}
        aria-hidden={!scanTool.value}
        onPointerMove={(event) => event.pointerType === 'mouse' && (pointed.value = pieceUnder(event))}
        onPointerLeave={() => (pointed.value = -1)}
        onClick={(event) =>
          choosePiece(pieceUnder(event as unknown as PointerEvent & { currentTarget: SVGSVGElement }))
        }
      >
        <image href={address ?? seen.address} width={width} height={height} preserveAspectRatio="none" />
        {!made && <NoWood panel={panel} scan={seen} scale={scale} />}
        {!made && !scanTool.value && <path class="wood-cuts" d={own.join('')} />}
        {marks.map(({ x, y }) => (
          <circle class="wood-mark" cx={x * scale} cy={y * scale} r={((found(panel)?.markPx ?? 0) * scale) / 2} />
        ))}
        <Ruler width={width} height={height} letter={width / 38} />
        {made && cutting.value && !calm.value && <Laser order={made.order} radius={width / 130} />}
        {chosen?.panel === panel.name && <path class="wood-chosen" d={outline(chosen.onPanel)} />}
        {scanTool.value && <ScanToolSheet panel={panel} scan={seen} scale={scale} />}
      </svg>
      <figcaption>
        <strong>{panel.name}</strong> {length.format(width)} × {length.format(height)} mm
        {marks.length > 0 && `, ${counted(marks.length, 'marks')}`}
        {used !== undefined && `, ${percent.format(used)} used`}
        {run.value && own.length > 0 && `, ${own.length} cut`}
      </figcaption>
    </figure>
  );
}

/** Where the piece comes from that is pointed at or chosen. */
function WoodLabel() {
  const cut = shownPiece.value < 0 ? undefined : cuts.value[shownPiece.value];
  const [x, y] = cut ? middleOf(cut.onPanel) : [0, 0];
  return (
    <p class="field-label wood-label" role="status" hidden={!cut}>
      {cut && (
        <>
          <strong>{cut.id}</strong> from {cut.panel}, {length.format(x)} × {length.format(y)} mm from its top left,
          turned {length.format(cut.turn)}°
        </>
      )}
    </p>
  );
}

function middleOf(ring: readonly number[]): [number, number] {
  const corners = ring.length / 2;
  const mean = (first: number) => ring.reduce((sum, v, k) => (k % 2 === first ? sum + v : sum), 0) / corners;
  return [mean(0), mean(1)];
}

/** Goes along the cuts as the laser will, again and again. */
function Laser({ order, radius }: { order: readonly string[]; radius: number }) {
  const { value: all } = cuts;
  const way = useMemo(() => {
    const rings = new Map(all.map(({ id, onPanel }) => [id, onPanel]));
    return order.map((id) => outline(rings.get(id) ?? [])).join('');
  }, [all, order]);
  const motion = { dur: `${Math.max(1, order.length * kSecondsACut)}s`, repeatCount: 'indefinite', path: way };
  return (
    <circle class="laser" r={radius}>
      <animateMotion {...motion} />
    </circle>
  );
}

/** Not offered to those who want no motion. */
function CutPreview() {
  if (calm.value || !outcome.value?.wood || run.value) return null;
  return (
    <button
      type="button"
      class="tool"
      aria-pressed={cutting.value}
      title="Watch the order in which the pieces are cut"
      onClick={() => (cutting.value = !cutting.value)}
    >
      <Zap size={17} aria-hidden />
      Cut
    </button>
  );
}

/** The guide to put the pieces together, to look at and to print. */
function Assembly() {
  const address = useAddress(outcome.value?.wood?.assembly);
  if (!address || run.value) return null;
  return (
    <a class="tool" href={address} target="_blank" rel="noopener" title="Outlines and labels, to print">
      <Printer size={17} aria-hidden />
      Assembly
    </a>
  );
}
