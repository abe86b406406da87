// Colours of heights, from low to high: brighter is higher, also without colour vision (viridis of Matplotlib, CC0).

const STOPS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]] as const;

export type Rgb = readonly [number, number, number];

/** `share`: 0 is the lowest, 1 the highest. */
export function colourOf(share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (STOPS.length - 1);
  const first = Math.min(STOPS.length - 2, Math.floor(at));
  const mix = (i: 0 | 1 | 2) => Math.round(STOPS[first]![i] + (STOPS[first + 1]![i] - STOPS[first]![i]) * (at - first));
  return [mix(0), mix(1), mix(2)];
}

/** The distance of contour lines, 1, 2 or 5 times a power of ten: 4 to 10 of them lie within `range`. 0 of no range. */
export function contourStep(range: number): number {
  if (!(range > 0)) return 0;
  const rough = range / 10;
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find((factor) => factor * power >= rough * (1 - 1e-9)) ?? 10);
}
