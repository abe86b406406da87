// Numbers as people read them. A missing value is a dash, never a zero.

export const MISSING = "–";

/** Uses a true minus sign, so that columns of numbers line up. Never returns "-0". */
export function fixed(value: number | undefined | null, digits: number): string {
  if (value === undefined || value === null || !Number.isFinite(value)) return MISSING;
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}

export function percent(share: number | undefined | null): string {
  return share === undefined || share === null ? MISSING : `${Math.floor(100 * Math.min(1, Math.max(0, share)))} %`;
}

/** Bytes with a unit. */
export function bytes(count: number): string {
  if (count < 1000) return `${count} B`;
  return count < 1e6 ? `${(count / 1e3).toFixed(1)} kB` : `${(count / 1e6).toFixed(1)} MB`;
}
