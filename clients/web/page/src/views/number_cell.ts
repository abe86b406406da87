// A number in a table that can be changed: Enter or leaving it saves, Escape undoes the change.
import { h, setAttribute } from "../dom/element";
import { fixed } from "../format/numbers";

/** A number as people write it, with a comma or a point; undefined if it is not a number. */
export function parseNumber(text: string): number | undefined {
  const value = Number(text.trim().replace(",", ".").replace("−", "-"));
  return text.trim() === "" || !Number.isFinite(value) ? undefined : value;
}

export class NumberCell {
  readonly input: HTMLInputElement;
  private value = 0;

  constructor(label: string, private readonly digits: number, private readonly save: (value: number) => void) {
    this.input = h("input", { type: "text", inputmode: "decimal", class: "number-cell", "aria-label": label, on: {
      keydown: (event) => {
        if (event.key === "Enter") this.commit();
        else if (event.key === "Escape") this.restore();
        else return;
        event.stopPropagation(); // elsewhere Escape stops the machine
      },
      blur: () => this.commit(),
    } });
  }

  show(value: number, isEditable: boolean): void {
    setAttribute(this.input, "readonly", !isEditable);
    if (document.activeElement === this.input) return;
    this.value = value;
    this.restore();
  }

  private restore(): void {
    this.input.value = fixed(this.value, this.digits);
    setAttribute(this.input, "aria-invalid", undefined);
  }

  private commit(): void {
    const value = parseNumber(this.input.value);
    setAttribute(this.input, "aria-invalid", value === undefined ? "true" : undefined);
    if (value === undefined || fixed(value, this.digits) === fixed(this.value, this.digits)) return;
    this.value = value;
    this.save(value);
  }
}
