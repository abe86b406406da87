"""The server's interface according to clients/web/openapi.yaml, and the responses that were seen."""
import json
import pathlib
import re

import jsonschema
import yaml

# Every path may refuse a request from elsewhere, a method that it does not have, a head that is not clear, and a client
# that sent too many wrong tokens.
EVERYWHERE = {400: "bad-head", 403: "foreign-", 405: "wrong-method", 429: "too-many-tokens", 505: "bad-head"}


class Contract:
    def __init__(self, root):
        self.document = yaml.safe_load((pathlib.Path(root) / "clients/web/openapi.yaml").read_text())
        self.components = self.document["components"]
        self.seen = set()  # (method, path of the document, status)

    def operations(self):
        """{(method, path): operation}"""
        return {(method.upper(), path): operation for path, methods in self.document["paths"].items()
                for method, operation in methods.items()}

    def path_of(self, path):
        """The document's path: /api/reports/{name} for /api/reports/a.html. None if it has no such path."""
        plain = path.split("?")[0]
        for known in self.document["paths"]:
            if re.fullmatch(re.sub(r"\{\w+\}", "[^/]+", known), plain):
                return known
        return None

    def errors(self, schema, value):
        """`schema` may refer to the document's components."""
        validator = jsonschema.Draft202012Validator({"components": self.components, **schema})
        return [f"{error.json_path}: {error.message}" for error in validator.iter_errors(value)]

    def is_command(self, verb, body):
        return not self.errors({"$ref": f"#/components/schemas/Command_{verb}"}, body)

    def response(self, method, path, answer):
        """The declared response; None if the document has none with this status."""
        declared = self.operations().get((method, path), {}).get("responses", {}).get(str(answer.status))
        if declared is None and answer.status in EVERYWHERE:
            code = json.loads(answer.body)["code"] if answer.body else ""
            declared = {"$ref": "#/components/responses/Problem"} if code.startswith(EVERYWHERE[answer.status]) else None
        if declared is not None and "$ref" in declared:
            declared = self.components["responses"][declared["$ref"].split("/")[-1]]
        return declared

    def check(self, method, asked, answer):
        """Checks that the document describes the answer of a path that it has."""
        path = self.path_of(asked)
        if path is None or method == "HEAD":
            return
        where = f"{method} {asked}: {answer.status}"
        declared = self.response(method, path, answer)
        assert declared is not None, f"{where} is not in openapi.yaml: {answer.body[:300]}"
        self.seen.add((method, path, answer.status))
        content = declared.get("content", {})
        kind = answer.headers.get("content-type", "").split(";")[0]
        assert kind in content or (not content and not answer.body), f"{where}: {kind} is not in openapi.yaml"
        if kind in ("application/json", "application/problem+json"):
            errors = self.errors(content[kind]["schema"], json.loads(answer.body))
            assert not errors, f"{where}: {errors}"
