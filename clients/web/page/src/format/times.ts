// Times as people read them.
import { MISSING } from "./numbers";

/** A job's time left as 0:07, 12:05 or 1:02:03. */
export function duration(seconds: number | undefined | null): string {
  if (seconds === undefined || seconds === null || !Number.isFinite(seconds) || seconds < 0) return MISSING;
  const whole = Math.ceil(seconds);
  const two = (n: number) => String(n).padStart(2, "0");
  const s = two(whole % 60), m = Math.floor(whole / 60) % 60, h = Math.floor(whole / 3600);
  return h > 0 ? `${h}:${two(m)}:${s}` : `${m}:${s}`;
}

/** A time in ISO 8601 as 14:05, in this browser's time zone. */
export function timeOfDay(time: string): string {
  const date = new Date(time);
  const two = (n: number) => String(n).padStart(2, "0");
  return Number.isNaN(date.getTime()) ? MISSING : `${two(date.getHours())}:${two(date.getMinutes())}`;
}

/** An age in a unit that fits it: 80 ms, 1.4 s, 12 s, 3 min, 2 h. */
export function age(milliseconds: number | undefined | null): string {
  if (milliseconds === undefined || milliseconds === null) return MISSING;
  if (milliseconds < 1000) return `${Math.round(milliseconds / 10) * 10} ms`;
  const seconds = milliseconds / 1000;
  if (seconds < 10) return `${seconds.toFixed(1)} s`;
  if (seconds < 120) return `${Math.floor(seconds)} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}
