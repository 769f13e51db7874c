import { useSignal } from '@preact/signals';
import { Check, Contrast, FolderOpen, Moon, Redo2, Share2, Sun, Undo2 } from 'lucide-preact';
import { redo, undo } from '../state/edits';
import { openJob } from '../state/jobs';
import { alertWith, edits, entry, inputRole } from '../state/store';
import { kThemes, theme } from '../state/theme';

export function Header() {
  const { past, future } = edits.value;
  return (
    <div class="title-row">
      <div class="title">
        <h1>{entry.value.title}</h1>
        <p>
          {entry.value.sentence} {inputRole.value && <span>Drop your own picture anywhere.</span>}
        </p>
      </div>
      <div class="actions" role="toolbar" aria-label="Job">
        <button
          type="button"
          class="tool"
          aria-label="Undo"
          title="Undo (Ctrl+Z)"
          aria-disabled={!past.length}
          onClick={undo}
        >
          <Undo2 size={18} aria-hidden />
        </button>
        <button
          type="button"
          class="tool"
          aria-label="Redo"
          title="Redo (Ctrl+Shift+Z)"
          aria-disabled={!future.length}
          onClick={redo}
        >
          <Redo2 size={18} aria-hidden />
        </button>
        <span class="tool-gap" />
        <label class="tool" title="Open a saved job, or an SVG that Tessera made">
          <input type="file" class="unseen" accept=".json,.svg,application/json,image/svg+xml" onChange={onJob} />
          <FolderOpen size={18} aria-hidden />
          <span>Open job</span>
        </label>
        <ShareButton />
        <ThemeButton />
      </div>
    </div>
  );
}

async function onJob(event: Event & { currentTarget: HTMLInputElement }): Promise<void> {
  const input = event.currentTarget;
  const file = input.files?.[0];
  if (file) await openJob(file);
  input.value = '';
}

function ShareButton() {
  const copied = useSignal(false);
  const share = async () => {
    try {
      await navigator.clipboard.writeText(location.href);
      copied.value = true;
      setTimeout(() => (copied.value = false), 2000);
    } catch {
      alertWith('The browser does not allow copying. The link is in the address bar.');
    }
  };
  return (
    <button type="button" class="tool" title="Copy a link to this job" onClick={() => void share()}>
      {copied.value ? <Check size={18} aria-hidden /> : <Share2 size={18} aria-hidden />}
      <span aria-live="polite">{copied.value ? 'Link copied' : 'Share'}</span>
    </button>
  );
}

const kThemeIcons = { auto: Contrast, light: Sun, dark: Moon };

function ThemeButton() {
  const Icon = kThemeIcons[theme.value];
  const words = { auto: 'as the system', light: 'light', dark: 'dark' }[theme.value];
  return (
    <button
      type="button"
      class="tool"
      aria-label={`Theme: ${words}`}
      title={`Theme: ${words}`}
      onClick={() => (theme.value = kThemes[(kThemes.indexOf(theme.value) + 1) % kThemes.length] ?? 'auto')}
    >
      <Icon size={18} aria-hidden />
    </button>
  );
}
