// Dark or light: the system's preference, until the user chooses.

const KEY = "lockstep.theme";
const listeners: (() => void)[] = [];

function isDark(): boolean {
  const chosen = document.documentElement.dataset["theme"];
  return chosen !== undefined ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
}

function tell(): void {
  listeners.forEach((listener) => listener());
}

/** Calls the listener at each change, because canvases must be drawn again in the new colours. */
export function onTheme(listener: () => void): void {
  listeners.push(listener);
}

export function startTheme(): void {
  try {
    const chosen = localStorage.getItem(KEY);
    if (chosen === "dark" || chosen === "light") document.documentElement.dataset["theme"] = chosen;
  } catch {
    // storage may be forbidden: then the system's choice holds
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", tell);
}

export function switchTheme(): void {
  const chosen = isDark() ? "light" : "dark";
  document.documentElement.dataset["theme"] = chosen;
  try {
    localStorage.setItem(KEY, chosen);
  } catch {
    // the choice is not remembered
  }
  tell();
}

/** The present value of a palette's colour, as #rrggbb. */
export function paletteColour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
