#!/usr/bin/env python3
"""Reads raw recordings of insd (`.insdraw`), with Python's standard library alone.

    import insdraw
    for record in insdraw.read("recordings/"):        # a file, or a folder of a series
        if record["kind"] == "bytes" and record["port_name"] == "gnss":
            ...record["data"]...

As a program it prints an object of JSON for each record: `insdraw.py FILE_OR_FOLDER`; bytes stand in hexadecimal digits.

The format is told in docs/recording.md. A block that is damaged is left out and told in a record of the kind "damaged", as is what a file
lacks at its end; nothing that is read was in a block whose checksum is wrong.
"""

import json
import pathlib
import struct
import sys
import zlib

MAGIC = b"\x89INSDRAW"
VERSION = 1
BLOCK = b"\xb1ins"
LONGEST_BODY = 1 << 20
LONGEST_RECORDS = 4 << 20

KINDS = {
    0: "bytes", 1: "pulse", 2: "open", 3: "absent", 4: "lost", 5: "silent", 6: "speaking",
    7: "overrun", 8: "ended", 9: "can", 10: "bus", 11: "tick", 12: "order", 13: "later", 15: "gap",
}
NO_PORT = 0xFFFF


class Fault(Exception):
    """What is wrong with a file."""


def lz4_block(source, length):
    """Unpacks one block of LZ4 that has so many bytes."""
    out = bytearray()
    at = 0

    def more(count):
        nonlocal at
        while True:
            byte = source[at]
            at += 1
            count += byte
            if byte != 255:
                return count

    while at < len(source):
        token = source[at]
        at += 1
        literals = token >> 4
        if literals == 15:
            literals = more(literals)
        if at + literals > len(source):
            raise Fault("literals beyond the end")
        out += source[at : at + literals]
        at += literals
        if at == len(source):
            break
        offset = struct.unpack_from("<H", source, at)[0]
        at += 2
        if not 0 < offset <= len(out):
            raise Fault("a match before the beginning")
        match = token & 15
        if match == 15:
            match = more(match)
        match += 4
        if len(out) + match > length:
            raise Fault("longer than told")
        # a match may reach into what it makes
        start = len(out) - offset
        while match > 0:
            piece = out[start : start + match]
            out += piece
            match -= len(piece)
            start += len(piece)
    if len(out) != length:
        raise Fault("another length than told")
    return bytes(out)


class Fields:
    """The fields of records, one after the other."""

    def __init__(self, data):
        self.data = data
        self.at = 0

    def byte(self):
        self.at += 1
        return self.data[self.at - 1]

    def number(self):
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value & (1 << 64) - 1

    def signed(self):
        value = self.number()
        return -(value + 1 >> 1) if value & 1 else value >> 1

    def text(self):
        length = self.number()
        if self.at + length > len(self.data):
            raise Fault("a text beyond the end")
        self.at += length
        return self.data[self.at - length : self.at]

    def words(self):
        return self.text().decode("utf-8", "replace")


def wrapped(value):
    """A sum of signed numbers of 64 bits."""
    return (value + (1 << 63)) % (1 << 64) - (1 << 63)


def payload(kind, fields):
    """What a record of a kind holds."""
    name = KINDS[kind]
    if name == "bytes":
        return {"data": fields.text()}
    if name == "pulse":
        return {"edge_ns": fields.signed(), "sequence": fields.number()}
    if name == "open":
        return {"what": fields.words()}
    if name in ("absent", "lost"):
        return {"reason": fields.words()}
    if name == "silent":
        return {"silent_ns": fields.signed()}
    if name == "overrun":
        return {"dropped": fields.number()}
    if name == "can":
        number = fields.number()
        return {"id": number >> 1, "extended": bool(number & 1), "data": fields.text()}
    if name == "bus":
        return {"event": fields.number(), "figure": fields.number()}
    if name == "order":
        return order(fields)
    if name == "later":
        return later(fields)
    return {}


def order(fields):
    what = fields.number()
    if what == 0:
        return {"order": what, "alert": fields.number(), "silence": bool(fields.number())}
    if what == 2:
        return {"order": what, "age_ns": fields.signed(), "data": fields.text()}
    if what in (1, 3, 4, 5):
        return {"order": what, "text": fields.words()}
    if what == 6:
        return {"order": what, "allowed": bool(fields.number())}
    raise Fault(f"order {what} is not known")


def later(fields):
    what = fields.number()
    if what == 0:
        host, obeyed = fields.words(), bool(fields.number())
        return {"later": what, "host": host, "obeyed": obeyed, "data": fields.text()}
    if what == 1:
        return {
            "later": what, "host": fields.words(), "reason": fields.number(),
            "count": fields.number(),
        }
    if what == 2:
        return {"later": what, "storage": fields.number()}
    raise Fault(f"what came later as {what} is not known")


def records_of(data, count):
    """The records of a block; raises a fault if they do not fill it."""
    fields = Fields(data)
    monotonic = offset = 0
    found = []
    while fields.at < len(data):
        first = fields.byte()
        kind = first & 15
        if kind not in KINDS or first & 0xE0:
            raise Fault(f"a record of the kind {first:#x}")
        if KINDS[kind] == "gap":
            found.append({"kind": "gap", "missing": fields.number()})
            continue
        port = fields.number()
        monotonic = wrapped(monotonic + fields.signed())
        if first & 16:
            offset = wrapped(offset + fields.signed())
        record = {
            "kind": KINDS[kind], "port": None if port == NO_PORT else port,
            "monotonic_ns": monotonic, "system_ns": wrapped(monotonic + offset),
        }
        record.update(payload(kind, fields))
        found.append(record)
    if len(found) != count:
        raise Fault("another number of records than told")
    return found


def header_of(data):
    """The header of a file, None where it is damaged, and where its blocks begin."""
    if len(data) < 20 or data[:8] != MAGIC:
        raise Fault("not a raw recording")
    version, _, length, sum_ = struct.unpack_from("<HHII", data, 8)
    if version > VERSION:
        raise Fault(f"version {version}, and this program reads up to {VERSION}")
    body = data[20 : 20 + length]
    if length > LONGEST_BODY or zlib.crc32(data[8:16] + body) != sum_:
        found = data.find(BLOCK)
        return None, len(data) if found < 0 else found
    number, run, monotonic, system, own = struct.unpack_from("<IIqqH", body)
    return {
        "number": number, "run": run, "monotonic_ns": monotonic, "system_ns": system,
        "program": body[26 : 26 + own].decode("utf-8", "replace"),
        "config": body[26 + own :].decode("utf-8", "replace"),
    }, 20 + length


def port_names(config):
    """Names of the ports in a configuration, in their order; none where Python has no reader of TOML (before 3.11)."""
    try:
        import tomllib
    except ImportError:
        return []
    try:
        ports = tomllib.loads(config).get("port", [])
    except tomllib.TOMLDecodeError:
        return []
    if not isinstance(ports, list):
        return []
    return [port.get("name") if isinstance(port, dict) else None for port in ports]


def block_at(data, at):
    """The records of the block at a place and its end, or None where no good head stands."""
    head = data[at : at + 32]
    if len(head) < 32 or head[:4] != BLOCK:
        return None
    if zlib.crc32(head[:28]) != struct.unpack_from("<I", head, 28)[0]:
        return None
    length, whole, count, _, sum_ = struct.unpack_from("<IIIQI", head, 4)
    body = data[at + 32 : at + 32 + length]
    end = at + 32 + length
    if len(body) < length:
        return [{"kind": "damaged", "what": f"cut short at byte {at}"}], len(data)
    try:
        if zlib.crc32(body) != sum_ or whole > LONGEST_RECORDS:
            raise Fault("a wrong checksum")
        plain = body if length == whole else lz4_block(body, whole)
        return records_of(plain, count), end
    except (Fault, IndexError, struct.error) as fault:
        return [{"kind": "damaged", "what": f"block at byte {at}: {fault}"}], end


def read_file(path):
    """The records of one file, one after the other."""
    data = pathlib.Path(path).read_bytes()
    header, at = header_of(data)
    names = port_names(header["config"]) if header else []
    if header is None:
        yield {"kind": "damaged", "what": "damaged header"}
    while at < len(data):
        found = block_at(data, at)
        if found is None:
            on = data.find(BLOCK, at + 1)
            on = len(data) if on < 0 else on
            yield {"kind": "damaged", "what": f"{on - at} bytes at byte {at}"}
            at = on
            continue
        records, at = found
        for record in records:
            port = record.get("port")
            if port is not None:
                record["port_name"] = names[port] if port < len(names) else None
            yield record


def read(path):
    """The records of a file, or of all files of a folder in the order of their numbers."""
    path = pathlib.Path(path)
    files = sorted(path.glob("*.insdraw")) if path.is_dir() else [path]
    for file in files:
        yield from read_file(file)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: insdraw.py FILE_OR_FOLDER")
    try:
        for record in read(sys.argv[1]):
            print(json.dumps(record, default=bytes.hex))
    except Fault as fault:
        sys.exit(f"{sys.argv[1]}: {fault}")
    except BrokenPipeError:
        sys.stderr.close()


if __name__ == "__main__":
    main()
