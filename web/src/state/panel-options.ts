// What the parameter "panels" says of each panel, as core/parquetry/panel_options.h reads it:
// "oak dpi=300 margin=5; walnut machine=10:10,160:10,10:110".

export type PanelOptions = Readonly<Record<string, string>>; // "dpi": "300"

export function readPanelOptions(text: string): Map<string, PanelOptions> {
  const all = new Map<string, PanelOptions>();
  for (const entry of text.split(/[;\n]/)) {
    const [name, ...words] = entry.trim().split(/\s+/);
    if (!name) continue;
    all.set(name, Object.fromEntries(words.map((word) => [word.split('=')[0]!, word.slice(word.indexOf('=') + 1)])));
  }
  return all;
}

export const writePanelOptions = (all: ReadonlyMap<string, PanelOptions>): string =>
  [...all]
    .filter(([, options]) => Object.keys(options).length > 0)
    .map(([name, options]) => [name, ...Object.entries(options).map(([key, value]) => `${key}=${value}`)].join(' '))
    .join('; ');

/** With one option of one panel changed; an empty value takes it out. */
export function withOption(text: string, panel: string, key: string, value: string): string {
  const all = readPanelOptions(text);
  const { [key]: _, ...others } = all.get(panel) ?? {};
  all.set(panel, value === '' ? others : { ...others, [key]: value });
  return writePanelOptions(all);
}

/** With a panel's options under another name; none: without them. */
export function renamed(text: string, from: string, to: string | null): string {
  const entries = [...readPanelOptions(text)].filter(([name]) => name !== from || to !== null);
  return writePanelOptions(new Map(entries.map(([name, options]) => [name === from && to ? to : name, options])));
}

/** Only of panels that are there. */
export const onlyOf = (text: string, names: readonly string[]): string =>
  writePanelOptions(new Map([...readPanelOptions(text)].filter(([name]) => names.includes(name))));

const kLongest = 40;

/** A file's name as a panel's: letters, digits, '-' and '_', not one of `taken`. */
export function panelName(file: string, taken: readonly string[]): string {
  const stem = file
    .replace(/\.[^.]*$/, '')
    .normalize('NFKD')
    .replace(/[^\w-]+/g, '-')
    .replace(/^-+|-+$/g, '');
  const plain = stem.slice(0, kLongest - 3) || 'panel';
  for (let n = 1; ; ++n) {
    const name = n === 1 ? plain : `${plain}-${n}`;
    if (!taken.includes(name)) return name;
  }
}

export const isPanelName = (name: string): boolean => /^[\w-]{1,40}$/.test(name) && /^[\x21-\x7e]*$/.test(name);
