# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the unseen authors
"""A strict reader of the part of USD ASCII that scene.usda uses. Whatever it does not know is an error."""

import dataclasses
import re

TOKEN = re.compile(r'\s*(?:("(?:[^"\\\n]|\\.)*")|(-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)(?![\w.])|([A-Za-z_][\w:]*)'
                   r'|([][(){}=,]))')
NUMBERS = {"int": 1, "float": 1, "double3": 3, "point3f": 3, "float3": 3, "color3f": 3}
PRIMS = {"Xform", "Mesh", "Points", "BasisCurves"}


@dataclasses.dataclass
class Attribute:
    type: str
    value: object
    interpolation: str | None = None


@dataclasses.dataclass
class Prim:
    type: str
    name: str
    attributes: dict = dataclasses.field(default_factory=dict)
    children: dict = dataclasses.field(default_factory=dict)


class Reader:
    """Tokens of the text as (kind, text), kind 0…3: string, number, name, mark."""

    def __init__(self, text):
        header, body = text.split("\n", 1)
        assert header == "#usda 1.0", header
        body = body.rstrip()
        self.tokens, at = [], 0
        while at < len(body):
            match = TOKEN.match(body, at)
            assert match, f"not USD: {body[at:at + 60]!r}"
            self.tokens.append((match.lastindex - 1, match.group(match.lastindex)))
            at = match.end()
        self.at = 0

    def peek(self):
        return self.tokens[self.at][1] if self.at < len(self.tokens) else None

    def take(self, kind, text=None):
        found_kind, found = self.tokens[self.at]
        assert found_kind == kind and text in (None, found), f"{found!r}, expected {text or kind}"
        self.at += 1
        return found

    def marks(self, text):
        return self.take(3, text)

    def string(self):
        return re.sub(r"\\(.)", r"\1", self.take(0)[1:-1])

    def number(self, whole):
        text = self.take(1)
        return int(text) if whole else float(text)

    def sequence(self, start, item, end):
        """start item, item, … end"""
        self.marks(start)
        items = []
        while self.peek() != end:
            if items:
                self.marks(",")
            items.append(item())
        self.marks(end)
        return items

    def value(self, type_name):
        if type_name.endswith("[]"):
            return self.sequence("[", lambda: self.value(type_name[:-2]), "]")
        if type_name in ("token", "string"):
            return self.string()
        if type_name == "bool":
            return bool(("0", "1").index(self.take(1)))
        size = NUMBERS[type_name]
        if size == 1:
            return self.number(type_name == "int")
        items = self.sequence("(", lambda: self.number(False), ")")
        assert len(items) == size, items
        return tuple(items)

    def type_name(self):
        name = self.take(2)
        if self.peek() == "[":
            self.marks("[")
            self.marks("]")
            return name + "[]"
        return name

    def attribute(self, prim):
        while self.peek() in ("custom", "uniform"):
            self.take(2)
        type_name = self.type_name()
        name = self.take(2)
        self.marks("=")
        assert name not in prim.attributes, name
        prim.attributes[name] = attribute = Attribute(type_name, self.value(type_name))
        if self.peek() == "(":
            self.marks("(")
            self.take(2, "interpolation")
            self.marks("=")
            attribute.interpolation = self.string()
            self.marks(")")

    def prim(self):
        self.take(2, "def")
        prim = Prim(self.take(2), self.string())
        assert prim.type in PRIMS, prim.type
        assert re.fullmatch(r"[A-Za-z_]\w*", prim.name), prim.name
        self.marks("{")
        while self.peek() != "}":
            if self.peek() == "def":
                child = self.prim()
                assert child.name not in prim.children, child.name
                prim.children[child.name] = child
            else:
                self.attribute(prim)
        self.marks("}")
        return prim

    def stage(self):
        """The layer's metadata and its one root prim."""
        metadata = {}
        self.marks("(")
        while self.peek() != ")":
            name = self.take(2)
            self.marks("=")
            metadata[name] = self.number(False) if self.tokens[self.at][0] == 1 else self.string()
        self.marks(")")
        root = self.prim()
        assert self.peek() is None, self.peek()
        return metadata, root


def read(path):
    return Reader(path.read_text("utf-8")).stage()
