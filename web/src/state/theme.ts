// Light, dark, or as the system has it; remembered.

import { effect, signal } from '@preact/signals';

export const kThemes = ['auto', 'light', 'dark'] as const;
export type Theme = (typeof kThemes)[number];

const kKey = 'tessera-theme';
const dark = matchMedia('(prefers-color-scheme: dark)');
const calmQuery = matchMedia('(prefers-reduced-motion: reduce)');

function remembered(): Theme {
  try {
    return kThemes.find((theme) => theme === localStorage.getItem(kKey)) ?? 'auto';
  } catch {
    return 'auto'; // storage may be forbidden
  }
}

export const theme = signal<Theme>(remembered());
/** What is shown in the end. */
export const shade = signal<'light' | 'dark'>('light');
export const calm = signal(calmQuery.matches);

export function bindTheme(): void {
  const systemDark = signal(dark.matches);
  dark.addEventListener('change', () => (systemDark.value = dark.matches));
  calmQuery.addEventListener('change', () => (calm.value = calmQuery.matches));
  effect(() => {
    const chosen = theme.value === 'auto' ? (systemDark.value ? 'dark' : 'light') : theme.value;
    document.documentElement.dataset['theme'] = chosen;
    shade.value = chosen;
    try {
      localStorage.setItem(kKey, theme.value);
    } catch {
      // Not remembered, then.
    }
  });
}
