// A remedy in the words of this page: its buttons where it has them, otherwise where to type a shell command.
import type { Texts } from "../texts/en";
import { fill } from "../texts/fill";

const COMMAND = /lockstep (home|resume|stop|reset)\b/g;
const LOOK = /lockstep status\b/g;
const OTHER_COMMAND = /\blockstep [a-z]/;

export function pageRemedy(remedy: string, { commands }: Texts): string {
  const buttons: Record<string, string> = {
    home: commands.home, resume: commands.resume, stop: commands.stop, reset: commands.reset,
  };
  const text = remedy.replace(COMMAND, (_, verb: string) => buttons[verb]!).replace(LOOK, commands.thisPage);
  return fill(OTHER_COMMAND.test(text) ? commands.shellRemedy : commands.remedy, { remedy: text });
}
