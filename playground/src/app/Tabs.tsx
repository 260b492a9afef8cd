// Panels of which one is shown, with the keys that are usual for tabs.

import type { Signal } from "@preact/signals";
import type { ComponentType } from "preact";

export interface Tab {
  name: string;
  label: string;
  panel: ComponentType;
  /** A number beside the label, left out if 0. */
  count?: number;
}

export function Tabs({ tabs, chosen, label }: { tabs: Tab[]; chosen: Signal<string>; label: string }) {
  const shown = tabs.find((tab) => tab.name === chosen.value) ?? tabs[0];
  if (!shown) return null;
  const choose = (name: string) => {
    chosen.value = name;
    document.getElementById(`tab-${name}`)?.focus();
  };
  const onKeyDown = (event: KeyboardEvent) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const next = tabs[(tabs.indexOf(shown) + step + tabs.length) % tabs.length];
    if (next) choose(next.name);
  };
  const Panel = shown.panel;
  return (
    <div class="tabs">
      <div role="tablist" aria-label={label} onKeyDown={onKeyDown}>
        {tabs.map((tab) => (
          <button
            key={tab.name}
            id={`tab-${tab.name}`}
            type="button"
            role="tab"
            aria-selected={tab === shown}
            aria-controls={`panel-${tab.name}`}
            tabIndex={tab === shown ? 0 : -1}
            onClick={() => choose(tab.name)}
          >
            <span class="label" data-label={tab.label}>
              {tab.label}
            </span>
            {tab.count ? <span class="count">{tab.count}</span> : null}
          </button>
        ))}
      </div>
      <div role="tabpanel" id={`panel-${shown.name}`} aria-labelledby={`tab-${shown.name}`} class="panel">
        <Panel />
      </div>
    </div>
  );
}
