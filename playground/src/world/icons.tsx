// Pictures of the toolbar's buttons.

const icon = (path: string) => () => (
  <svg viewBox="0 0 20 20" width="18" height="18" aria-hidden="true" focusable="false">
    <path
      d={path}
      fill="none"
      stroke="currentColor"
      stroke-width="1.6"
      stroke-linecap="round"
      stroke-linejoin="round"
    />
  </svg>
);

export const Above = icon("M3.5 3.5h13v13h-13zM3.5 10h13M10 3.5v13");
export const Cube = icon("M10 2.5l6.5 3.6v7.8L10 17.5l-6.5-3.6V6.1zM3.7 6.2L10 9.8l6.3-3.6M10 9.8v7.5");
export const Fit = icon("M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4M8 8h4v4H8z");
export const Follow = icon(
  "M10 5.5a4.5 4.5 0 1 0 0 9a4.5 4.5 0 1 0 0-9M10 2v3.5M10 14.5V18M2 10h3.5M14.5 10H18",
);
export const Measure = icon("M2.5 13.5l11-11 4 4-11 11zM6 10l1.8 1.8M8.8 7.2l1.8 1.8M11.6 4.4l1.8 1.8");
export const Move = icon(
  "M10 2v16M2 10h16M7.5 4.5L10 2l2.5 2.5M7.5 15.5L10 18l2.5-2.5M4.5 7.5L2 10l2.5 2.5M15.5 7.5L18 10l-2.5 2.5",
);
export const Layers = icon("M10 3l7.5 4L10 11 2.5 7zM2.8 10.5L10 14.3l7.2-3.8M2.8 13.8L10 17.5l7.2-3.7");
