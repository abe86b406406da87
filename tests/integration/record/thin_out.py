"""Copies an LCM log without every N-th of its messages of steps: thin_out.py FROM TO N."""
import struct
import sys

HEADER = struct.Struct(">IqqII")  # sync word, event number, time, lengths of channel and data


def events(file):
    while len(header := file.read(HEADER.size)) == HEADER.size:
        _, _, _, channel_bytes, data_bytes = HEADER.unpack(header)
        yield header, file.read(channel_bytes), file.read(data_bytes)


def main(source, target, every):
    steps = 0
    with open(source, "rb") as log, open(target, "wb") as thin:
        for header, channel, data in events(log):
            steps += channel.endswith(b"_STEPS")
            if not (channel.endswith(b"_STEPS") and steps % every == 0):
                thin.write(header + channel + data)


main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
