// The page's drawings, as paths in a square of 24.

export const ICONS = {
  home: "M3 11 12 3l9 8v10h-6v-6H9v6H3Z",
  play: "M6 4v16l14-8Z",
  pause: "M6 4h4v16H6ZM14 4h4v16h-4Z",
  stop: "M5 5h14v14H5Z",
  emergency: "M8 2h8l6 6v8l-6 6H8l-6-6V8ZM11 6v8h2V6ZM11 16v2h2v-2Z",
  reset: "M12 4V1L7 6l5 5V7a5 5 0 1 1-5 5H4a8 8 0 1 0 8-8Z",
  up: "M12 5 20 16H4Z",
  down: "M12 19 4 8h16Z",
  left: "M5 12 16 4v16Z",
  right: "M19 12 8 20V4Z",
  fit: "M3 3h7v2H5v5H3ZM14 3h7v7h-2V5h-5ZM3 14h2v5h5v2H3ZM19 14h2v7h-7v-2h5Z",
  upload: "M12 3 19 11h-5v6h-4v-6H5ZM4 19h16v2H4Z",
  check: "m9 16.2-4.2-4.2L3.4 13.4 9 19 21 7l-1.4-1.4Z",
  warning: "M12 2 23 21H1ZM11 9v6h2V9ZM11 16.5v2h2v-2Z",
  close: "m6.4 5 12.6 12.6-1.4 1.4L5 6.4ZM17.6 5 19 6.4 6.4 19 5 17.6Z",
  theme: "M12 2a10 10 0 1 0 0 20 10 10 0 0 0 0-20ZM12 4v16a8 8 0 0 1 0-16Z",
  leave: "M3 3h9v2H5v14h7v2H3ZM15.6 7 21 12l-5.4 5-1.3-1.5 2.7-2.5H9v-2h8l-2.7-2.5Z",
  keyboard: "M2 6h20v12H2ZM5 9v2h2V9ZM9 9v2h2V9ZM13 9v2h2V9ZM17 9v2h2V9ZM7 13v2h10v-2Z",
  follow: "M11 2h2v4h-2ZM11 18h2v4h-2ZM2 11h4v2H2ZM18 11h4v2h-4ZM12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8Z",
} as const;
