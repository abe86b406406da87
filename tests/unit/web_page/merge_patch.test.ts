import { describe, expect, test } from "vitest";
import { mergePatch, type Json } from "../../../clients/web/page/src/state/merge_patch";

// The table of RFC 7396, appendix A: original, patch, result.
const RFC: [string, string, string][] = [
  ['{"a":"b"}', '{"a":"c"}', '{"a":"c"}'],
  ['{"a":"b"}', '{"b":"c"}', '{"a":"b","b":"c"}'],
  ['{"a":"b"}', '{"a":null}', "{}"],
  ['{"a":"b","b":"c"}', '{"a":null}', '{"b":"c"}'],
  ['{"a":["b"]}', '{"a":"c"}', '{"a":"c"}'],
  ['{"a":"c"}', '{"a":["b"]}', '{"a":["b"]}'],
  ['{"a":{"b":"c"}}', '{"a":{"b":"d","c":null}}', '{"a":{"b":"d"}}'],
  ['{"a":[{"b":"c"}]}', '{"a":[1]}', '{"a":[1]}'],
  ['["a","b"]', '["c","d"]', '["c","d"]'],
  ['{"a":"b"}', '["c"]', '["c"]'],
  ['{"a":"foo"}', "null", "null"],
  ['{"a":"foo"}', '"bar"', '"bar"'],
  ['{"e":null}', '{"a":1}', '{"e":null,"a":1}'],
  ["[1,2]", '{"a":"b","c":null}', '{"a":"b"}'],
  ["{}", '{"a":{"bb":{"ccc":null}}}', '{"a":{"bb":{}}}'],
];

describe("a merge patch", () => {
  test.each(RFC)("of %s by %s is %s", (target, patch, result) => {
    expect(JSON.parse(JSON.stringify(mergePatch(JSON.parse(target) as Json, JSON.parse(patch) as Json)))).toEqual(JSON.parse(result));
  });

  test("changes neither of its arguments", () => {
    const target = { a: { b: 1, c: 2 } }, patch = { a: { b: null } };
    mergePatch(target, patch);
    expect([target, patch]).toEqual([{ a: { b: 1, c: 2 } }, { a: { b: null } }]);
  });

  test("cannot reach an object's prototype", () => {
    mergePatch({}, JSON.parse('{"__proto__": {"polluted": 1}}') as Json);
    expect(({} as Record<string, unknown>)["polluted"]).toBeUndefined();
  });
});
