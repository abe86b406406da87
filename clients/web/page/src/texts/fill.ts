// Fills values into texts.

/** "Line {line}" with { line: 7 } is "Line 7". A word without a value stays as it is. */
export function fill(text: string, values: Record<string, string | number>): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => (name in values ? String(values[name]) : whole));
}
