import { effect, untracked } from '@preact/signals';
import { render } from 'preact';
import './style/base.css';
import './style/layout.css';
import './style/controls.css';
import './style/stage.css';
import './style/phone.css';
import { bindViewport } from './stage/viewport';
import { bindAddress, openAddress } from './state/address';
import { bindKeys } from './state/keys';
import { engine, graphics } from './state/store';
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

const root = document.getElementById('app');
if (root) render(<App />, root);

let opened = false;
effect(() => {
  const { value: info } = engine;
  if (!info) return;
  if (opened) return; // an engine that came up after another was stopped
  opened = true;
  void untracked(openAddress).then(bindAddress);
});

// After the first stones, so as not to compete with them for the line.
if (import.meta.env.PROD && 'serviceWorker' in navigator) {
  addEventListener('load', () => setTimeout(() => void navigator.serviceWorker.register('./sw.js'), 2000));
}
