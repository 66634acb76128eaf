#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the reference of the C++ headers for the C++ domain of Sphinx, from the XML of Doxygen.

    cpp_reference.py XML OUTPUT

XML      the folder that tools/site/Doxyfile writes
OUTPUT   a folder, which gets a section for each header: index.inc for meshhood/index.h, with its entries in their order
"""

import re
import sys
import textwrap
from pathlib import Path
from xml.etree import ElementTree

INTERNAL = ("std", "meshhood::detail")
DIRECTIVES = {"function": "function", "variable": "var", "typedef": "type", "enum": "enum-class"}
INDENT = "   "
NAME = re.compile(r"^[A-Za-z_]\w*(?:::\w+)*$")
MARKUP = re.compile(r"[\\*|`]|_\b(?!\w)")
JOINT = "\0"  # becomes the escaped blank that lets markup begin and end within a word


def flat(element):
    """The text of an element without its markup, on one line."""
    return " ".join("".join(element.itertext()).split()) if element is not None else ""


def inline(element):
    """The content of a paragraph up to its first block, as reStructuredText."""
    parts = [escaped(element.text)]
    for child in element:
        if child.tag == "computeroutput":
            parts.append(JOINT + code(flat(child)) + JOINT)
        elif child.tag not in BLOCKS:
            parts.append(marked(child))
        parts.append(escaped(child.tail))
    return "".join(parts)


def marked(child):
    text = inline(child).strip()
    return f"{JOINT}*{text}*{JOINT}" if child.tag == "emphasis" and text else text


def code(text):
    """A name as a link to its entry, other code as it is."""
    return f":cpp:any:`{text}`" if NAME.match(text) else f"``{text}``"


def escaped(text):
    return MARKUP.sub(r"\\\g<0>", text or "")


def code_block(element):
    lines = "\n".join(text_of(line) for line in element.iter("codeline"))
    return ".. code-block:: cpp\n\n" + textwrap.indent(lines, INDENT)


def text_of(line):
    """A line of code, whose spaces are elements."""
    result = line.text or ""
    for child in line:
        result += (" " if child.tag == "sp" else "") + text_of(child) + (child.tail or "")
    return result


def verbatim(element):
    return ".. code-block:: cpp\n\n" + textwrap.indent(textwrap.dedent(element.text or "").strip("\n"), INDENT)


def items(element):
    entries = (textwrap.indent("\n\n".join(blocks(item)), "  ").lstrip() for item in element.findall("listitem"))
    return "\n".join(f"- {entry}" for entry in entries)


BLOCKS = {"programlisting": code_block, "verbatim": verbatim, "itemizedlist": items}


def blocks(element):
    """The paragraphs, lists and code of a description."""
    for paragraph in element.findall("para"):
        text = " ".join(inline(paragraph).split()).replace(JOINT, "\\ ")
        found = [BLOCKS[child.tag](child) for child in paragraph if child.tag in BLOCKS]
        if text:
            yield text
        yield from found


def description(node):
    parts = [part for tag in ("briefdescription", "detaileddescription") for part in blocks(node.find(tag))]
    return "\n\n".join(parts)


def template_of(node):
    parameters = node.find("templateparamlist")
    if parameters is None:
        return ""
    each = [f"{flat(p.find('type'))} {flat(p.find('declname'))}".strip() for p in parameters.findall("param")]
    condition = flat(node.find("requiresclause"))
    return f"template<{', '.join(each)}> " + (f"requires {condition} " if condition else "")


def signature(member):
    name, kind = flat(member.find("name")), member.get("kind")
    if kind == "enum":
        return name
    of_type = flat(member.find("type"))
    if kind == "typedef":
        return f"{template_of(member)}{name} = {of_type}"
    arguments = flat(member.find("argsstring"))
    value = flat(member.find("initializer")) if kind == "variable" and member.get("static") != "yes" else ""
    words = "".join(f"{word} " for word in ("static", "explicit") if member.get(word) == "yes" and kind == "function")
    return f"{template_of(member)}{words}{of_type} {name}{arguments} {value}".replace("  ", " ").strip()


def entry(directive, what, text, children=()):
    body = [text, *children]
    inner = "\n\n".join(part for part in body if part)
    return f".. cpp:{directive}:: {what}\n\n" + textwrap.indent(inner, INDENT) + "\n"


def enumerator(value):
    return entry("enumerator", flat(value.find("name")), description(value))


def member_entry(member):
    directive, text = DIRECTIVES[member.get("kind")], description(member)
    return entry(directive, signature(member), text, [enumerator(value) for value in member.findall("enumvalue")])


def is_shown(member):
    """Whether a member is public and has something to say: not what every class has, to copy, move and destroy it."""
    name, arguments = flat(member.find("name")), flat(member.find("argsstring"))
    is_special = name.startswith("~") or name == "operator=" or arguments.startswith(f"({name} &&)")
    is_known = member.get("kind") in DIRECTIVES and member.get("prot") == "public"
    return is_known and not is_special and not arguments.endswith("=delete")


class Headers:
    """All compounds of the XML, by header."""

    def __init__(self, folder):
        self.compounds = {}
        for file in sorted(folder.glob("*.xml")):
            if file.name not in ("index.xml", "Doxyfile.xml"):
                for compound in ElementTree.parse(file).getroot().findall("compounddef"):
                    self.compounds[compound.get("id")] = compound

    def of_kind(self, *kinds):
        return [compound for compound in self.compounds.values() if compound.get("kind") in kinds]

    def names(self):
        return sorted(flat(compound.find("compoundname")) for compound in self.of_kind("file"))

    def class_entry(self, compound):
        """A class with its public members, nested classes included, in the order of the source."""
        name = flat(compound.find("compoundname")).rpartition("::")[2]
        parts = [(line_of(m), member_entry(m)) for m in compound.iter("memberdef") if is_shown(m)]
        for inner in compound.findall("innerclass"):
            if inner.get("prot") == "public":
                nested = self.compounds[inner.get("refid")]
                parts.append((line_of(nested), self.class_entry(nested)))
        bases = ", ".join(f"public {flat(base)}" for base in compound.findall("basecompoundref"))
        what = f"{template_of(compound)}{name}" + (f" : {bases}" if bases else "")
        children = [text for _, text in sorted(parts, key=lambda part: part[0])]
        return entry(compound.get("kind"), what, description(compound), children)

    def entries(self, header):
        """Of a header: line, namespace and text of each entry."""
        for namespace in self.of_kind("namespace"):
            name = flat(namespace.find("compoundname"))
            if name.startswith(INTERNAL):
                continue
            for member in namespace.iter("memberdef"):
                if is_shown(member) and is_in(member, header):
                    yield line_of(member), name, member_entry(member)
        for compound in self.of_kind("class", "struct", "concept"):
            namespace, _, name = flat(compound.find("compoundname")).rpartition("::")
            is_nested = any(namespace == flat(other.find("compoundname")) for other in self.of_kind("class", "struct"))
            if is_nested or namespace.startswith(INTERNAL) or not is_in(compound, header):
                continue
            if compound.get("kind") == "concept":
                text = entry("concept", template_of(compound) + name, description(compound))
            else:
                text = self.class_entry(compound)
            yield line_of(compound), namespace, text


def line_of(node):
    return int(node.find("location").get("line"))


def is_in(node, header):
    return Path(node.find("location").get("file")).name == header


def write(headers, header, file):
    """A section in Markdown: the comment of the header, then its entries, each in its namespace."""
    of_file = next(c for c in headers.of_kind("file") if flat(c.find("compoundname")) == header)
    parts = [description(of_file)]
    for _, namespace, text in sorted(headers.entries(header), key=lambda entry: entry[0]):
        parts += [f".. cpp:namespace:: {namespace}", text]
    text = "\n\n".join(part for part in parts if part) + "\n\n.. cpp:namespace:: 0\n"
    folder = "io/" if "io/" in of_file.find("location").get("file") else ""
    file.write_text(f"## meshhood/{folder}{header}\n\n````{{eval-rst}}\n{text}````\n", encoding="utf-8")


def main():
    headers, output = Headers(Path(sys.argv[1])), Path(sys.argv[2])
    output.mkdir(parents=True, exist_ok=True)
    for header in headers.names():
        write(headers, header, output / Path(header).with_suffix(".inc").name)


if __name__ == "__main__":
    main()
