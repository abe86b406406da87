#!/usr/bin/env python3
"""Writes clients/web/page/src/api/contract.ts, the types of the page, from the schemas in clients/web/openapi.yaml.

Usage: make_contract.py ROOT [--check]

Each schema under components becomes a type, except those of the commands' bodies. An inner schema with a title becomes
a type with this name. --check writes nothing and exits with 1 if contract.ts differs from what would be written.
"""
import argparse
import json
import pathlib
import sys

import yaml

HEAD = """// Made from clients/web/openapi.yaml by clients/web/make_contract.py: change it there. The state comes as patches, in which
// null removes a member, so an absent member counts as null.

export type Maybe<T> = T | null | undefined;
"""
PLAIN = {"string": "string", "integer": "number", "number": "number", "boolean": "boolean"}


class Contract:
    def __init__(self, schemas):
        self.types = {}
        for name, schema in schemas.items():
            if name.startswith("Command_"):
                self.type_of(schema)  # only for the types with a title within
            else:
                self.define(name, schema)

    def define(self, name, schema):
        """Adds the type `name` behind the types that it contains."""
        inner = {key: value for key, value in schema.items() if key != "title"}
        is_interface = inner.get("type") == "object" and "properties" in inner
        text = f"interface {name} {self.members(inner)}" if is_interface else f"type {name} = {self.type_of(inner)};"
        if self.types.setdefault(name, text) != text:
            sys.exit(f"clients/web/openapi.yaml: two schemas have the title {name}")

    def members(self, schema, indent="  "):
        required = schema.get("required", [])
        lines = [indent + self.member(name, member, name in required) for name, member in schema["properties"].items()]
        return "{\n" + "\n".join(lines) + "\n}"

    def member(self, name, schema, is_required):
        if is_nullable(schema):
            return f"{name}?: Maybe<{self.type_of(schema)}>;"
        is_constant = "const" in schema  # the page need not write it in its own values
        return f"{name}{'' if is_required and not is_constant else '?'}: {self.type_of(schema)};"

    def type_of(self, schema):
        """The type without null."""
        if "title" in schema:
            self.define(schema["title"], schema)
            return schema["title"]
        if "$ref" in schema:
            return schema["$ref"].rsplit("/", 1)[1]
        if "const" in schema or "enum" in schema:
            values = schema.get("enum", [schema.get("const")])
            return " | ".join(json.dumps(value) for value in values if value is not None)
        if "oneOf" in schema:
            return " | ".join(self.type_of(one) for one in schema["oneOf"] if one.get("type") != "null")
        kinds = [kind for kind in as_list(schema.get("type", [])) if kind != "null"]
        return " | ".join(self.type_of_kind(kind, schema) for kind in kinds) or "unknown"

    def type_of_kind(self, kind, schema):
        if kind == "array":
            item = self.type_of(schema["items"])
            return f"({item})[]" if " | " in item else f"{item}[]"
        if kind != "object":
            return PLAIN[kind]
        if "properties" in schema:
            required = schema.get("required", [])
            return "{ " + " ".join(self.member(name, member, name in required)
                                   for name, member in schema["properties"].items()).rstrip(";") + " }"
        others = schema.get("additionalProperties")
        return f"Record<string, {self.type_of(others)}>" if isinstance(others, dict) else "Record<string, never>"


def as_list(kind):
    return kind if isinstance(kind, list) else [kind]


def is_nullable(schema):
    return ("null" in as_list(schema.get("type", [])) or None in schema.get("enum", [])
            or any(is_nullable(one) for one in schema.get("oneOf", [])))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    given = parser.parse_args()
    document = yaml.safe_load((given.root / "clients/web/openapi.yaml").read_text())
    types = Contract(document["components"]["schemas"]).types
    made = HEAD + "".join(f"\nexport {text}\n" for text in types.values())
    file = given.root / "clients/web/page/src/api/contract.ts"
    if not given.check:
        file.write_text(made)
    elif not file.exists() or file.read_text() != made:
        sys.exit(f"{file}: is not what openapi.yaml says; run: clients/web/make_contract.py .")


if __name__ == "__main__":
    main()
