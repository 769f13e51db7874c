import { useSignal } from '@preact/signals';
import { ImageUp } from 'lucide-preact';
import { useEffect } from 'preact/hooks';
import { openJob } from '../state/jobs';
import { fitPicture } from '../state/fit';
import { isJobFile, usePicture } from '../state/pictures';
import { tool } from '../state/store';

async function takeFile(file: File, forFit = false): Promise<void> {
  tool.value = null;
  if (forFit && !isJobFile(file)) return fitPicture(file, file.name);
  await (isJobFile(file) ? openJob(file) : usePicture(file, file.name || 'pasted.png'));
}

const isOverFit = ({ target }: DragEvent) => target instanceof Element && target.closest('.fit') !== null;

/** Files dropped anywhere or pasted; a veil says so while they hover. */
export function DropTarget() {
  const hovering = useSignal<'page' | 'fit' | null>(null);
  useEffect(() => {
    const aborter = new AbortController();
    const on = <K extends keyof WindowEventMap>(type: K, listener: (event: WindowEventMap[K]) => void) =>
      window.addEventListener(type, listener, { signal: aborter.signal });
    on('dragover', (event) => {
      event.preventDefault();
      const files = event.dataTransfer?.types.includes('Files') ?? false;
      hovering.value = !files ? null : isOverFit(event) ? 'fit' : 'page';
    });
    on('dragleave', (event) => {
      if (event.relatedTarget === null) hovering.value = null;
    });
    on('drop', (event) => {
      event.preventDefault();
      hovering.value = null;
      const file = event.dataTransfer?.files[0];
      if (file) void takeFile(file, isOverFit(event));
    });
    on('paste', (event) => {
      const file = event.clipboardData?.files[0];
      if (file) void takeFile(file);
    });
    return () => aborter.abort();
  }, []);
  if (!hovering.value) return null;
  return (
    <div class="drop-veil">
      <p>
        <ImageUp size={40} aria-hidden />
        {hovering.value === 'fit' ? 'Drop the picture to fit' : 'Drop a picture or a job'}
      </p>
    </div>
  );
}
