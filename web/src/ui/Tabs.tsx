import { useSignal } from '@preact/signals';
import { schema } from 'tessera-wasm/description';
import { technique } from '../state/store';
import { openTab } from '../state/tabs';
import { techniques } from '../techniques/index';
import type { TechniqueEntry } from '../techniques/entry';
import { Mark } from './Mark';

/** The engine's word on it. */
const isThere = ({ name }: TechniqueEntry) => name in schema.$defs;

function onKey(event: KeyboardEvent & { currentTarget: HTMLElement }): void {
  const tabs = [...event.currentTarget.querySelectorAll<HTMLElement>('[role=tab]')];
  const at = tabs.indexOf(document.activeElement as HTMLElement);
  const steps: Record<string, number> = {
    ArrowDown: at + 1,
    ArrowRight: at + 1,
    ArrowUp: at - 1,
    ArrowLeft: at - 1,
    Home: 0,
    End: tabs.length - 1,
  };
  const next = steps[event.key];
  if (next === undefined) return;
  event.preventDefault();
  tabs[(next + tabs.length) % tabs.length]?.focus();
}

export function Tabs() {
  const asked = useSignal(''); // a technique that is not there yet, pressed nevertheless
  return (
    <header class="rail">
      <a class="brand" href="./" aria-label="Tessera, start page">
        <Mark />
        <span>Tessera</span>
      </a>
      <div class="tabs" role="tablist" aria-label="Techniques" aria-orientation="vertical" onKeyDown={onKey}>
        {techniques.map((entry) => {
          const there = isThere(entry);
          const selected = entry.name === technique.value;
          return (
            <button
              type="button"
              role="tab"
              key={entry.name}
              id={`tab-${entry.name}`}
              class="tab"
              aria-label={entry.title}
              aria-selected={selected}
              aria-controls="work"
              aria-disabled={!there}
              aria-describedby={there ? undefined : `soon-${entry.name}`}
              tabIndex={selected ? 0 : -1}
              title={there ? entry.sentence : `${entry.title} is not there yet`}
              data-asked={asked.value === entry.name}
              onClick={() => {
                asked.value = there ? '' : entry.name;
                if (there) void openTab(entry.name);
              }}
            >
              <entry.icon />
              <span class="tab-title">{entry.title}</span>
              {!there && (
                <span class="tab-soon" id={`soon-${entry.name}`}>
                  not there yet
                </span>
              )}
            </button>
          );
        })}
      </div>
    </header>
  );
}
