import { effect } from '@preact/signals';
import { render } from 'preact';
import './style/base.css';
import './style/layout.css';
import './style/controls.css';
import './style/stage.css';
import './style/field.css';
import './style/statistics.css';
import './style/wood.css';
import './style/phone.css';
import { bindViewport } from './stage/viewport';
import { bindAddress, openAddress } from './state/address';
import { bindKeys } from './state/keys';
import { bindGrid, gliding, grid, type Shown } from './state/live-grid';
import { bindStatistics } from './state/statistics';
import { engine, graphics, outcome } from './state/store';
import { bindTheme } from './state/theme';
import { App } from './ui/App';
import type { Graphics } from './worker/protocol';

declare global {
  interface Window {
    /** What runs here, for people who report a problem, and for checks. */
    tessera: {
      version: string;
      threads: number;
      isolated: boolean;
      gl: Graphics | null;
      /** That is worked on. */
      readonly grid: Shown | null;
    };
  }
}

effect(() => {
  const { version = __TESSERA_VERSION__, threads = 0 } = engine.value ?? {};
  window.tessera = {
    version,
    threads,
    isolated: crossOriginIsolated,
    gl: graphics.value,
    get grid() {
      return grid.peek() && { ...grid.peek()!, atRest: grid.peek()!.atRest && !gliding.peek() };
    },
  };
});

bindTheme();
bindViewport();
bindKeys();
bindStatistics();
bindGrid();

void openAddress().then(bindAddress);

const root = document.getElementById('app');
if (root) render(<App />, root);

// After the first stones, so as not to compete with them for the line and the processor.
if (import.meta.env.PROD && 'serviceWorker' in navigator) {
  const done = effect(() => {
    if (!outcome.value) return;
    void navigator.serviceWorker.register('./sw.js');
    done();
  });
}
