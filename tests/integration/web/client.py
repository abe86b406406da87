"""Requests as a script makes them."""
import http.client
import json
import socket
import time


def expect(is_so, what):
    if not is_so:
        raise AssertionError(what)


def refused(answer, status, code):
    """Checks that an answer is a refusal. Returns its problem."""
    problem = answer.json()
    expect(answer.status == status and problem["code"] == code, f"{status} {code} awaited: {answer.status} {problem}")
    expect(problem["detail"] and answer.headers["content-type"] == "application/problem+json", problem)
    return problem


class Answer:
    def __init__(self, response):
        self.status = response.status
        self.headers = {name.lower(): value for name, value in response.getheaders()}
        self.body = response.read()

    def json(self):
        return json.loads(self.body)


class Client:
    """Each answer is compared with the contract."""

    def __init__(self, port, token, contract):
        self.port = port
        self.token = token
        self.contract = contract

    def request(self, method, path, body=None, headers=None, token=None):
        all_headers = {}
        chosen = self.token if token is None else token
        if chosen:
            all_headers["Authorization"] = f"Bearer {chosen}"
        if isinstance(body, (dict, list)):
            body = json.dumps(body)
            all_headers["Content-Type"] = "application/json"
        all_headers.update(headers or {})
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            connection.request(method, path, body, all_headers)
            answer = Answer(connection.getresponse())
            self.contract.check(method, path, answer)
            return answer
        finally:
            connection.close()

    def get(self, path, **more):
        return self.request("GET", path, **more)

    def command(self, verb, body=None, **more):
        return self.request("POST", f"/api/commands/{verb}", {} if body is None else body, **more)

    def state(self):
        return self.get("/api/state").json()

    def await_state(self, holds, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            state = self.state()
            if holds(state):
                return state
            time.sleep(0.05)
        raise AssertionError(f"the state did not come: {state}")


def patched(document, patch):
    """A JSON merge patch, written from the text of RFC 7396."""
    if not isinstance(patch, dict):
        return patch
    document = dict(document) if isinstance(document, dict) else {}
    for name, value in patch.items():
        if value is None:
            document.pop(name, None)
        else:
            document[name] = patched(document.get(name), value)
    return document


class Events:
    """A stream of server-sent events over its own socket."""

    def __init__(self, client, last_id=None):
        self.socket = socket.create_connection(("127.0.0.1", client.port), timeout=30)
        last = f"Last-Event-ID: {last_id}\r\n" if last_id else ""
        self.socket.sendall(f"GET /api/events HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {client.token}\r\n"
                            f"{last}\r\n".encode())
        self.file = self.socket.makefile("rb")
        self.status = int(self.file.readline().split()[1])
        while self.file.readline().strip():
            pass
        self.text = b""
        self.state = None
        self.id = None

    def close(self):
        self.file.close()
        self.socket.close()

    def chunk(self):
        size = int(self.file.readline().strip() or b"0", 16)
        data = self.file.read(size)
        self.file.readline()
        if size == 0:
            raise EOFError("the stream has ended")
        return data

    def next(self):
        """(event, data); states and deltas are also applied to `state`."""
        while True:
            while b"\n\n" not in self.text:
                self.text += self.chunk()
            one, self.text = self.text.split(b"\n\n", 1)
            fields = dict(line.split(": ", 1) for line in one.decode().split("\n") if ": " in line)
            if "event" not in fields:
                return "comment", None
            data = json.loads(fields["data"])
            self.id = fields.get("id", self.id)
            if fields["event"] == "state":
                self.state = data
            elif fields["event"] == "delta":
                self.state = patched(self.state, data)
            return fields["event"], data
