import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { de } from "../../../clients/web/page/src/texts/de";
import { en } from "../../../clients/web/page/src/texts/en";
import { fill } from "../../../clients/web/page/src/texts/fill";

type Table = { [key: string]: string | Table };

function flat(table: Table, before = ""): [string, string][] {
  return Object.entries(table).flatMap(([key, value]) =>
    typeof value === "string" ? [[before + key, value] as [string, string]] : flat(value, `${before}${key}.`));
}

const source = new URL("../../../clients/web/page/src/", import.meta.url);
const code = readdirSync(source, { recursive: true }).map(String).filter((name) => name.endsWith(".ts") && !name.startsWith("texts/"))
  .map((name) => readFileSync(new URL(name, source), "utf8")).join("\n");
const english = flat(en as unknown as Table), german = Object.fromEntries(flat(de as unknown as Table));

describe("the texts", () => {
  test.each(english)("%s is the same in each language but for its words", (key, text) => {
    const words = (t: string) => [...t.matchAll(/\{\w+\}/g)].map(String).sort();
    expect(words(german[key]!)).toEqual(words(text));
    expect(german[key]).not.toBe("");
  });

  test("are all used", () => {
    const unused = english.map(([key]) => key).filter((key) => {
      const [group, name] = [key.split(".").slice(0, -1).join("."), key.split(".").at(-1)!];
      const [first, ...inner] = group.split(".");
      const indexed = new RegExp(`\\b${first}(\\.${inner.join("\\.")})?\\[`);
      const named = new RegExp(`(t\\.|\\b)${group.replaceAll(".", "\\.")}\\.${name.replace("-", "")}\\b`);
      return !named.test(code) && !indexed.test(code);
    });
    expect(unused).toEqual([]);
  });
});

test("values are filled in, also twice, and nothing else", () => {
  expect(fill("{a} and {a}, {b}", { a: 1 })).toBe("1 and 1, {b}");
});
