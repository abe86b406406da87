// Computes which lines of a long text are in view. Browsers limit the height of an element, so the scroll bar of a very
// long text is compressed: its range covers the text in proportion, and each line still has its full height.

/** Browsers draw elements of this height without errors. Pixels. */
export const MOST_HEIGHT = 8_000_000;

export interface Lines {
  readonly count: number;
  /** Height of a line, pixels. */
  readonly height: number;
  /** Height of the view, pixels. */
  readonly view: number;
}

export function contentHeight(lines: Lines): number {
  return Math.min(lines.count * lines.height, MOST_HEIGHT);
}

function scrolls(lines: Lines): { bar: number; text: number } {
  return {
    bar: Math.max(0, contentHeight(lines) - lines.view),
    text: Math.max(0, lines.count * lines.height - lines.view),
  };
}

export interface Window {
  /** The first line to draw, from 0, and how many. */
  readonly first: number;
  readonly count: number;
  /** Where the first line begins, in pixels from the top of the content. */
  readonly top: number;
}

/** The lines to draw at a position of the scroll bar. */
export function windowAt(lines: Lines, scrolled: number): Window {
  const { bar, text } = scrolls(lines);
  const hidden = bar > 0 ? (Math.min(scrolled, bar) / bar) * text : 0; // pixels of text above the view
  const first = Math.floor(hidden / lines.height);
  const count = Math.min(lines.count - first, Math.ceil(lines.view / lines.height) + 1);
  return { first, count, top: Math.min(scrolled, bar) - (hidden - first * lines.height) };
}

/** The scroll position that puts a line (from 0) at a share of the view's height. */
export function scrollTo(lines: Lines, line: number, share: number): number {
  const { bar, text } = scrolls(lines);
  if (text === 0) return 0;
  const hidden = line * lines.height - share * (lines.view - lines.height);
  return Math.round((Math.min(text, Math.max(0, hidden)) / text) * bar);
}
