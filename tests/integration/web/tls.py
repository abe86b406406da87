#!/usr/bin/env python3
"""HTTPS with certificate files; without them the server does not listen beyond this host.

Usage: tls.py ROOT PROGRAMS
"""
import http.client
import json
import ssl
import subprocess
import sys

sys.dont_write_bytecode = True
from client import expect  # noqa: E402
from machine import Machine, own_network  # noqa: E402


def make_certificate(directory, name):
    """Self-signed, for this host. Returns its file and its key's."""
    certificate, key = directory / f"{name}.crt", directory / f"{name}.key"
    subprocess.run(["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes",
                    "-days", "2", "-subj", "/CN=mill", "-addext", "subjectAltName=IP:127.0.0.1,DNS:mill.example",
                    "-keyout", key, "-out", certificate], check=True, capture_output=True)
    return str(certificate), str(key)


def ends(machine, code, words, *options):
    """The server ends by itself with this code, and says why."""
    end = subprocess.run([machine.programs / "lockstep-web", "--port", "0", *options], env=machine.env,
                         capture_output=True, text=True, timeout=60)
    text = end.stdout + end.stderr
    expect(end.returncode == code and words in text, f"{options}: {end.returncode}, {text}")


def check_refusals(machine, certificate, key):
    for address in ("0.0.0.0", "::"):
        ends(machine, 2, "other hosts are served with TLS only", "--address", address)
    ends(machine, 2, "--key", "--certificate", certificate)
    ends(machine, 2, "none.crt", "--certificate", str(machine.work / "none.crt"), "--key", key)
    ends(machine, 1, "HTTPS cannot be served", "--certificate", certificate, "--key",
         make_certificate(machine.work, "other")[1])
    ends(machine, 1, "HTTPS cannot be served", "--certificate", key, "--key", key)


def request(machine, trusted, method, path, body=None, headers=None):
    context = ssl.create_default_context(cafile=trusted)
    connection = http.client.HTTPSConnection("127.0.0.1", machine.port, timeout=30, context=context)
    try:
        connection.request(method, path, body, headers or {})
        answer = connection.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read()
    finally:
        connection.close()


def check_served(machine, certificate):
    token = machine.tokens["operate"]
    status, headers, page = request(machine, certificate, "GET", "/")
    expect(status == 200 and b"<html" in page, (status, headers))
    status, headers, body = request(machine, certificate, "POST", "/api/session", json.dumps({"token": token}),
                                    {"Content-Type": "application/json", "Origin": f"https://127.0.0.1:{machine.port}"})
    expect(status == 200 and "; Secure" in headers["Set-Cookie"], (status, headers, body))
    cookie = headers["Set-Cookie"].split(";")[0]
    status, _, body = request(machine, certificate, "GET", "/api/state", None, {"Cookie": cookie})
    expect(status == 200 and json.loads(body)["machine"] == machine.name, body)
    status, _, body = request(machine, certificate, "POST", "/api/commands/stop", None,
                              {"Authorization": f"Bearer {token}", "Origin": f"http://127.0.0.1:{machine.port}"})
    expect(status == 403 and json.loads(body)["code"] == "foreign-origin", "another scheme is another origin")
    status, _, body = request(machine, certificate, "GET", "/api/state", None,
                              {"Host": "mill.example", "Authorization": f"Bearer {token}"})
    expect(status == 200, f"a name that was allowed: {status} {body}")


def check_refused_connections(machine):
    other, _ = make_certificate(machine.work, "other")
    try:
        request(machine, other, "GET", "/")
        expect(False, "another certificate is trusted")
    except ssl.SSLCertVerificationError:
        pass
    plain = http.client.HTTPConnection("127.0.0.1", machine.port, timeout=30)
    try:
        plain.request("GET", "/api/state")
        expect(plain.getresponse().status >= 400, "the state is given without TLS")
    except (ConnectionError, http.client.HTTPException):
        pass
    finally:
        plain.close()


def main():
    own_network()
    with Machine(*sys.argv[1:]) as machine:
        certificate, key = make_certificate(machine.work, "mill")
        check_refusals(machine, certificate, key)
        machine.serve("--address", "0.0.0.0", "--certificate", certificate, "--key", key, "--host-name", "mill.example",
                      "--host-name", "127.0.0.1")
        check_served(machine, certificate)
        check_refused_connections(machine)
        check_served(machine, certificate)
        machine.end_server()


if __name__ == "__main__":
    main()
