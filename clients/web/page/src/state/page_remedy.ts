// A remedy in the words of this page: its buttons where it has them, otherwise where to type a shell command.
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

const ACTION = /\{([a-z-]+)\}/g;
const SHELL_COMMAND = /\blockstep [a-z]/;

export function pageRemedy(remedy: string, { actions, commands }: Texts): string {
  const text = remedy.replace(ACTION, (_, action: string) => actions[action as keyof typeof actions] ?? action);
  return fill(SHELL_COMMAND.test(text) ? commands.shellRemedy : commands.remedy, { remedy: text });
}
