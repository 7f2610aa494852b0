"""Runs `tarn` (argv[1]) in an empty folder and reads what it writes: PNG, the head of EXR, .npy, JSON."""
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

TARN = os.path.abspath(sys.argv.pop(1))


class Case(unittest.TestCase):
    """Each test has an empty folder of its own, in which the program runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def files(self):
        return sorted(os.listdir(self.folder))

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def run_tarn(self, *arguments, **environment):
        return subprocess.run([TARN, *arguments], cwd=self.folder, env={**os.environ, **environment},
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, check=False)

    def succeed(self, *arguments, **environment):
        """The standard output of a run that must end with exit code 0 and say nothing on stderr."""
        run = self.run_tarn(*arguments, **environment)
        self.assertEqual((run.returncode, run.stderr), (0, ""), run.args)
        return run.stdout

    def refuse(self, arguments, *words, **environment):
        """Exit code 2, one line on stderr that holds each of `words`, and a folder as it was."""
        before = {name: self.read(name) for name in self.files() if os.path.isfile(self.path(name))}
        run = self.run_tarn(*arguments, **environment)
        self.assertEqual(run.returncode, 2, (run.args, run.stdout, run.stderr))
        self.assertRegex(run.stderr, r"\Atarn: [^\n]+\n\Z", run.args)
        for word in words:
            self.assertIn(word, run.stderr, run.args)
        self.assertEqual({name: self.read(name) for name in self.files() if os.path.isfile(self.path(name))}, before,
                         run.args)


def read_npy(data):
    """(shape, bytes) of an .npy file of uint8 in C order."""
    assert data[:8] == b"\x93NUMPY\x01\x00", data[:8]
    length = struct.unpack("<H", data[8:10])[0]
    head = eval(data[10:10 + length], {"__builtins__": {}})  # a Python literal, by the format's definition
    assert (10 + length) % 64 == 0
    assert head["descr"] == "|u1" and head["fortran_order"] is False, head
    return head["shape"], data[10 + length:]


def read_png(data):
    """(width, height, channels, rows as bytearrays) of an 8-bit PNG without interlacing."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:8]
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + body)
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and interlace == 0
            channels = {2: 3, 6: 4}[colour]
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, stride, rows = zlib.decompress(packed), width * channels, []
    above = bytearray(stride)
    for y in range(height):
        kind = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            up = above[i]
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda value: abs(guess - value))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, paeth)[kind]) % 256
        rows.append(row)
        above = row
    return width, height, channels, rows


def exr_attributes(data):
    """The header of an OpenEXR file: name -> value bytes."""
    assert data[:4] == b"\x76\x2f\x31\x01", data[:4]
    attributes, at = {}, 8
    while data[at] != 0:
        name_end = data.index(0, at)
        kind_end = data.index(0, name_end + 1)
        size = struct.unpack("<I", data[kind_end + 1:kind_end + 5])[0]
        attributes[data[at:name_end].decode()] = data[kind_end + 5:kind_end + 5 + size]
        at = kind_end + 5 + size
    return attributes
