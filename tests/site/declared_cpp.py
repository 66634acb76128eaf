# SPDX-License-Identifier: MIT
"""The public names of the C++ headers, as the compiler reads them: the answer that the reference is compared with."""

import json
import subprocess
import tempfile
from collections import Counter
from pathlib import Path

# What our adapter names of geometry-central, for machines without it. The other libraries are Debian packages.
GEOMETRY_CENTRAL = """#pragma once
namespace geometrycentral {
struct Vector3 { double x, y, z; };
namespace surface { class SurfaceMesh; template <typename T> class VertexData; }
}
"""
IO_HEADERS = ("index_io", "mesh_io", "weld")
DECLARED = {
    "FunctionDecl", "FunctionTemplateDecl", "CXXMethodDecl", "CXXConstructorDecl", "CXXConversionDecl", "FieldDecl",
    "VarDecl", "TypeAliasDecl", "ConceptDecl",
}  # fmt: skip


def public_headers(root):
    return [*sorted((root / "include/meshhood").glob("*.h")), *(root / f"io/{name}.h" for name in IO_HEADERS)]


def namespaces(compiler, root, includes):
    """The syntax trees of `namespace meshhood { ... }` in all public headers."""
    with tempfile.TemporaryDirectory() as folder:
        for name in ("surface/surface_mesh.h", "utilities/vector3.h"):
            stub = Path(folder) / "geometrycentral" / name
            stub.parent.mkdir(parents=True, exist_ok=True)
            stub.write_text(GEOMETRY_CENTRAL if "surface" in name else "", encoding="utf-8")
        source = Path(folder) / "all.cpp"
        source.write_text("".join(f'#include "{header}"\n' for header in public_headers(root)), encoding="utf-8")
        folders = [option for include in includes for option in ("-I", include)]
        command = [
            compiler, "-std=c++20", "-fsyntax-only", "-w", *folders, "-idirafter", folder,
            "-Xclang", "-ast-dump=json", "-Xclang", "-ast-dump-filter=meshhood", source,
        ]  # fmt: skip
        # The bodies of the adapters do not compile with what stands in for a library. Their declarations do.
        text = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    decoder, place, seen = json.JSONDecoder(), text.find("{"), set()
    while place >= 0:
        node, place = decoder.raw_decode(text, place)
        if node["kind"] == "NamespaceDecl" and node.get("name") == "meshhood" and node["id"] not in seen:
            seen.add(node["id"])
            yield node
        place = text.find("{", place)


def is_special(node):
    """Whether every class has such a member, to copy, move and destroy it. The reference leaves it out."""
    name, of_type = node.get("name", ""), node.get("type", {}).get("qualType", "")
    is_move = node["kind"] == "CXXConstructorDecl" and "&&" in of_type and of_type.count(",") == 0
    return name == "operator=" or is_move or node.get("explicitlyDeleted", False)


def members(node):
    """What a class declares publicly."""
    access = "private" if node["tagUsed"] == "class" else "public"
    for child in node.get("inner", []):
        if child["kind"] == "AccessSpecDecl":
            access = child["access"]
        elif access == "public":
            yield child


def names(node, scope):
    """The qualified names that a declaration introduces; a name is repeated for each of its overloads."""
    kind, inner, own = node["kind"], node.get("inner", []), node.get("name", "")
    of_class = scope.rpartition("::")[2]
    # A constructor that is a template of a class that is one is called Name<T>.
    name = f"{scope}::{of_class if own.startswith(f'{of_class}<') else own}"
    if kind == "NamespaceDecl":
        if own != "detail":
            inside = scope if node.get("isInline") else name
            yield from (found for child in inner for found in names(child, inside))
    elif kind == "ClassTemplateDecl":
        yield from (found for child in inner if child["kind"] == "CXXRecordDecl" for found in names(child, scope))
    elif kind == "CXXRecordDecl" and node.get("completeDefinition") and not node.get("isImplicit"):
        yield name
        yield from (found for child in members(node) for found in names(child, name))
    elif kind == "EnumDecl":
        yield name
        yield from (f"{name}::{child['name']}" for child in inner if child["kind"] == "EnumConstantDecl")
    elif kind in DECLARED and not (node.get("isImplicit") or node.get("previousDecl") or is_special(node)):
        yield name


def declared_names(compiler, root, includes):
    return Counter(
        name
        for namespace in namespaces(compiler, root, includes)
        for child in namespace.get("inner", [])
        for name in names(child, "meshhood")
    )
