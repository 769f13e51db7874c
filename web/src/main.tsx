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
import { bindStatistics } from './state/statistics';
import { engine, graphics, outcome } from './state/store';
import { bindTheme } from './state/theme';
import { App } from './ui/App';
import type { Graphics } from './worker/protocol';

declare global {
  interface Window {
    /** What runs here, for people who report a problem, and for checks. */
    tessera: { version: string; threads: number; isolated: boolean; gl: Graphics | null };
  }
}

effect(() => {
  const { version = __TESSERA_VERSION__, threads = 0 } = engine.value ?? {};
  window.tessera = { version, threads, isolated: crossOriginIsolated, gl: graphics.value };
});

bindTheme();
bindViewport();
bindKeys();
bindStatistics();

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
