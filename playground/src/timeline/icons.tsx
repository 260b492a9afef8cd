// The signs on the buttons of time.

const icon = (path: string) => () => (
  <svg viewBox="0 0 16 16" width="14" height="14" fill="currentColor" aria-hidden="true" focusable="false">
    <path d={path} />
  </svg>
);

export const ToStart = icon("M2 2h2v12H2zM14 2v12L5 8z");
export const ToEnd = icon("M12 2h2v12h-2zM2 2v12l9-6z");
export const Back = icon("M11 3v10L4 8z");
export const Forward = icon("M5 3v10l7-5z");
