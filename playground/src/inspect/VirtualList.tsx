// A list of which only the visible rows exist, so that hundreds of thousands of rows stay fast. All rows have the same
// height. Arrow keys move the active row, Enter and space choose it.

import { useSignal } from "@preact/signals";
import type { ComponentChildren } from "preact";
import { useEffect, useId, useRef } from "preact/hooks";
import "../styles/list.css";

/** Rows beyond the visible ones, so that scrolling shows no gaps. */
const MARGIN = 4;

interface Props {
  label: string;
  count: number;
  /** px */
  rowHeight: number;
  row: (index: number) => ComponentChildren;
  rowClass?: (index: number) => string;
  selected?: (index: number) => boolean;
  several?: boolean;
  choose: (index: number, event: { ctrlKey: boolean; metaKey: boolean; shiftKey: boolean }) => void;
  /** A row that is scrolled to whenever it changes. */
  reveal?: number | null;
  /** A person scrolls. */
  onScrolled?: () => void;
}

export function VirtualList({ label, count, rowHeight, row, ...more }: Props) {
  const box = useRef<HTMLDivElement>(null);
  const id = useId();
  const top = useSignal(0);
  const height = useSignal(300);
  const active = useSignal(-1);

  useEffect(() => {
    const element = box.current;
    if (!element) return;
    const observer = new ResizeObserver(() => {
      height.value = element.clientHeight;
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, [height]);

  const scrollTo = (index: number) => {
    const element = box.current;
    if (!element) return;
    const [first, last] = [element.scrollTop, element.scrollTop + element.clientHeight - rowHeight];
    const wanted = index * rowHeight;
    if (wanted < first) element.scrollTop = wanted;
    else if (wanted > last) element.scrollTop = wanted - element.clientHeight + 2 * rowHeight;
  };
  const reveal = more.reveal ?? null;
  useEffect(() => {
    if (reveal !== null && reveal >= 0) scrollTo(reveal);
  }, [reveal]);

  const onKeyDown = (event: KeyboardEvent) => {
    const page = Math.max(1, Math.floor(height.value / rowHeight) - 1);
    const steps: Record<string, number> = {
      ArrowDown: 1,
      ArrowUp: -1,
      PageDown: page,
      PageUp: -page,
      Home: -count,
      End: count,
    };
    const step = steps[event.key];
    if (step !== undefined) {
      event.preventDefault();
      event.stopPropagation();
      active.value = Math.min(count - 1, Math.max(0, active.value + step));
      more.onScrolled?.();
      scrollTo(active.value);
    } else if ((event.key === "Enter" || event.key === " ") && active.value >= 0 && active.value < count) {
      event.preventDefault();
      event.stopPropagation();
      more.choose(active.value, event);
    }
  };

  const first = Math.max(0, Math.floor(top.value / rowHeight) - MARGIN);
  const last = Math.min(count, Math.ceil((top.value + height.value) / rowHeight) + MARGIN);
  const rows = [];
  for (let index = first; index < last; index++) {
    rows.push(
      // biome-ignore lint/a11y/useKeyWithClickEvents: the list hears the keys
      <div
        key={index}
        tabIndex={-1}
        id={`${id}-${index}`}
        role="option"
        aria-selected={more.selected?.(index) ?? false}
        aria-setsize={count}
        aria-posinset={index + 1}
        class={`row ${index === active.value ? "active" : ""} ${more.rowClass?.(index) ?? ""}`}
        style={{ transform: `translateY(${index * rowHeight}px)`, height: `${rowHeight}px` }}
        onClick={(event) => {
          active.value = index;
          more.choose(index, event);
        }}
      >
        {row(index)}
      </div>,
    );
  }
  const shown = active.value >= first && active.value < last;
  return (
    <div
      ref={box}
      class="virtual"
      role="listbox"
      tabIndex={0}
      aria-label={label}
      aria-multiselectable={more.several}
      aria-activedescendant={shown ? `${id}-${active.value}` : undefined}
      onScroll={(event) => {
        top.value = event.currentTarget.scrollTop;
      }}
      onWheel={more.onScrolled}
      onTouchMove={more.onScrolled}
      onKeyDown={onKeyDown}
    >
      <div role="presentation" style={{ height: `${count * rowHeight}px` }}>
        {rows}
      </div>
    </div>
  );
}
