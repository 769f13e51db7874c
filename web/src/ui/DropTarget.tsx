import { useSignal } from '@preact/signals';
import { ImageUp } from 'lucide-preact';
import { useEffect } from 'preact/hooks';
import { openJob } from '../state/jobs';
import { isJobFile, usePicture } from '../state/pictures';
import { tool } from '../state/store';

async function takeFile(file: File): Promise<void> {
  tool.value = null;
  await (isJobFile(file) ? openJob(file) : usePicture(file, file.name || 'pasted.png'));
}

/** Files dropped anywhere or pasted; a veil says so while they hover. */
export function DropTarget() {
  const hovering = useSignal(false);
  useEffect(() => {
    const aborter = new AbortController();
    const on = <K extends keyof WindowEventMap>(type: K, listener: (event: WindowEventMap[K]) => void) =>
      window.addEventListener(type, listener, { signal: aborter.signal });
    on('dragover', (event) => {
      event.preventDefault();
      hovering.value = event.dataTransfer?.types.includes('Files') ?? false;
    });
    on('dragleave', (event) => {
      if (event.relatedTarget === null) hovering.value = false;
    });
    on('drop', (event) => {
      event.preventDefault();
      hovering.value = false;
      const file = event.dataTransfer?.files[0];
      if (file) void takeFile(file);
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
        Drop a picture or a job
      </p>
    </div>
  );
}
