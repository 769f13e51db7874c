import type { Plugin } from 'vite';

/** The development server puts styles into the page and scripts into its head, which the page's policy forbids. */
export function policyOnlyInBuilds(): Plugin {
  return {
    name: 'tessera-policy-only-in-builds',
    apply: 'serve',
    transformIndexHtml: (html) => html.replace(/<meta\s+http-equiv="Content-Security-Policy"[^>]*>/, ''),
  };
}
