"""Many event streams in one thread: counts what they receive, and drops it."""
import selectors
import socket
import time


class Stream:
    """`buffer`: the kernel's receive buffer, in bytes, for a viewer that hardly reads."""

    def __init__(self, client, buffer=None):
        self.socket = socket.socket()
        if buffer is not None:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        self.socket.settimeout(60)
        self.socket.connect(("127.0.0.1", client.port))
        self.socket.sendall(f"GET /api/events HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {client.token}\r\n"
                            "\r\n".encode())
        self.bytes = 0
        self.events = 0

    def close(self):
        self.socket.close()


def read_all(streams, seconds):
    """Reads all streams for this time."""
    end = time.monotonic() + seconds
    with selectors.DefaultSelector() as selector:
        for stream in streams:
            selector.register(stream.socket, selectors.EVENT_READ, stream)
        while (left := end - time.monotonic()) > 0:
            for key, _ in selector.select(left):
                data = key.data.socket.recv(65536)
                if not data:
                    raise EOFError("a stream that is read has ended")
                key.data.bytes += len(data)
                key.data.events += data.count(b"event: ")
