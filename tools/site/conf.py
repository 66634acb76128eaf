# SPDX-License-Identifier: MIT
"""The configuration of Sphinx. tools/build_site runs it on a copy of docs/ in build/site-sources/docs."""

import hashlib
import os
import re
import sys
from pathlib import Path

import pyvista

sys.path.insert(0, str(Path(__file__).parent))
from docstrings import process_docstring

WORK = Path(os.environ["MESHHOOD_SITE_SOURCES"])

project = "meshhood"
author = "The meshhood authors"
copyright = author
version = release = ".".join(re.findall(r"define MESHHOOD_VERSION_\w+ (\d+)", (WORK / "version.h").read_text()))

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx_copybutton",
    "sphinx_design",
    "sphinx_gallery.gen_gallery",
]
root_doc = "index"
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
# The pages are also read where Sphinx does not build them, so that they use few directives.
myst_enable_extensions = ["colon_fence", "fieldlist", "html_image"]
myst_heading_anchors = 4

default_role = "py:obj"
smartquotes = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"

cpp_index_common_prefix = ["meshhood::"]

# Pictures without a window.
pyvista.OFF_SCREEN = True
pyvista.BUILDING_GALLERY = True
pyvista.global_theme.background = "white"
pyvista.global_theme.font.color = "black"
pyvista.global_theme.window_size = [960, 640]
pyvista.global_theme.anti_aliasing = "ssaa"
pyvista.global_theme.smooth_shading = True
pyvista.global_theme.lighting_params.ambient = 0.3

sphinx_gallery_conf = {
    "examples_dirs": [str(WORK / "examples/gallery")],
    "gallery_dirs": ["gallery"],
    "filename_pattern": "/",
    "ignore_pattern": "made_meshes",
    "copyfile_regex": r"made_meshes\.py",
    "image_scrapers": (pyvista.Scraper(), "matplotlib"),
    "abort_on_example_error": True,
    "download_all_examples": False,
    "show_memory": False,
    "show_signature": False,
    "remove_config_comments": True,
    "within_subsection_order": "gallery_order.Order",
    "write_computation_times": False,
    "thumbnail_size": (800, 560),
}

html_theme = "pydata_sphinx_theme"
html_title = "meshhood"
html_static_path = [str(Path(__file__).parent / "static"), str(WORK / "static")]
html_css_files = ["site.css"]
html_js_files = [("site.js", {"defer": "defer"})]
toc_object_entries_show_parents = "hide"
html_copy_source = False
html_show_sourcelink = False
html_sidebars = {"index": []}
html_theme_options = {
    "navbar_align": "left",
    "header_links_before_dropdown": 6,
    "show_prev_next": False,
    "show_toc_level": 2,
    "secondary_sidebar_items": {"**": ["page-toc"], "index": []},
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}


# Pages of the site that lie outside docs, and those of other programs.
ROOT_PAGES = ("README", "CHANGELOG", "CONTRIBUTING", "RELEASE", "SECURITY")
INTEGRATION = re.compile(r"integrations/(\w+)/README\.md$")
NAME_OF_FILE = re.compile(r"\[[\w/]+\.md\](?=\()")
LINK = re.compile(r"(?<=\]\()(?![a-z]+:|#)([^)\s]+)|(?<= src=\")([^\"]+)")


def link_within_site(app, docname, source):
    """Leads links from and to the pages of the root, and to other pages outside docs, to where the site has them. Those
    that show the name of a file show the title of the page."""

    def moved(match):
        target = match[0]
        if docname.upper() in ROOT_PAGES:
            target = target.removeprefix("docs/") if target.startswith("docs/") else f"../{target}"
        if target.endswith("examples/gallery/README.rst"):
            return "/gallery/index.rst"
        if integration := INTEGRATION.search(target):
            return f"/{integration[1]}.md"
        page, separator, place = target.rpartition("/")[2].partition("#")
        stem = page.removesuffix(".md")
        return f"/{stem.lower()}.md{separator}{place}" if stem in ROOT_PAGES else target

    source[0] = LINK.sub(moved, NAME_OF_FILE.sub("[]", source[0]))


def list_benchmarks(app, docname, source):
    """benchmarks.md names its pages in a table, for readers without Sphinx, which needs a toctree."""
    if docname == "benchmarks":
        source[0] += "\n```{toctree}\n:hidden:\n:glob:\n\nbenchmarks/*\n```\n"


def link_meshes(app, docname, source):
    """An example that is downloaded needs the module of the meshes beside it."""
    if docname.startswith("gallery/") and "from made_meshes import" in source[0]:
        source[0] += "\nThe meshes are those of :download:`made_meshes.py`, which belongs beside the program.\n"


def write_empty_heads_as_cells(app, page, template, context, doctree):
    """A head without text names no column: a screen reader shall not announce it as one."""
    if "body" in context:
        context["body"] = re.sub(r'<th class="head[^"]*">(?:<p></p>)?</th>', "<td></td>", context["body"])


def setup(app):
    # Pages are written again when the way in which they are written changes.
    tools = b"".join(file.read_bytes() for file in sorted(Path(__file__).parent.glob("*.py")))
    app.add_config_value("site_tools", hashlib.sha256(tools).hexdigest(), "env")
    app.connect("source-read", link_within_site)
    app.connect("source-read", list_benchmarks)
    app.connect("source-read", link_meshes)
    app.connect("autodoc-process-docstring", process_docstring)
    app.connect("html-page-context", write_empty_heads_as_cells)
