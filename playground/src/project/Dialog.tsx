// A dialog in front of the page.

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";

interface Properties {
  title: string;
  close: () => void;
  children: ComponentChildren;
}

export function Dialog({ title, close, children }: Properties) {
  const element = useRef<HTMLDialogElement>(null);
  useEffect(() => {
    const dialog = element.current;
    dialog?.showModal();
    const onClick = (event: MouseEvent) => event.target === dialog && close();
    dialog?.addEventListener("click", onClick);
    return () => dialog?.removeEventListener("click", onClick);
  }, []);
  return (
    <dialog ref={element} class="dialog" aria-label={title} onClose={close}>
      <div class="dialog-content">
        <header class="row">
          <h2>{title}</h2>
          <span class="spread" />
          <button type="button" class="icon" aria-label="Close" onClick={close}>
            ✕
          </button>
        </header>
        {children}
      </div>
    </dialog>
  );
}
