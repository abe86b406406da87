// The texts in the person's language: the one that was chosen, else the browser's.
import { de } from "./de";
import { en, type Texts } from "./en";
import { fill } from "./fill";

export const LANGUAGES: Record<string, Texts> = { en, de };
const KEY = "lockstep.language";

function stored(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null; // storage may be forbidden
  }
}

export function language(): string {
  const wanted = stored() ?? navigator.language.slice(0, 2);
  return wanted in LANGUAGES ? wanted : "en";
}

/** Loads the page again in the other language; the session's cookie stays valid. */
export function switchLanguage(): void {
  try {
    localStorage.setItem(KEY, language() === "en" ? "de" : "en");
  } catch {
    return;
  }
  location.reload();
}

export const t: Texts = LANGUAGES[language()] ?? en;
export { fill };
