# SPDX-License-Identifier: MIT
"""Measures the figures that meshhood publishes, each part by one command. The results are build/benchmarks/results/*.json;
`report` makes the tables of README.md and docs/benchmarks/*.md from them, and all plots.

    python3 -m bench tables      the paper's Table 1 and Table 2, the phases of its query, the times for all vertices
    python3 -m bench exact       the exact index beside the best breadth-first search, cold and warm
    python3 -m bench before      the exact index beside that of another commit, in one process: --commit
    python3 -m bench batch       all vertices of a mesh in one call, beside breadth-first search
    python3 -m bench arrays      all vertices from the arrays of a mesh, beside other libraries; --radii, --threads: a part
    python3 -m bench curvature   principal curvatures of all vertices, beside libigl, MeshLab and CGAL
    python3 -m bench growth      the same as the mesh grows to 10 million vertices
    python3 -m bench pictures    the paper's Figure 4
    python3 -m bench accuracy    the paper's answer and the ball against the exact one
    python3 -m bench scaling     cost as mesh and radius grow
    python3 -m bench peers       other libraries on the same queries
    python3 -m bench tasks       the programs of examples/tasks beside those of other tools
    python3 -m bench reading     files of a million triangles, beside other libraries
    python3 -m bench report      the tables and plots, from the results

`make reproduce` and `make peers` install what is needed and run them. Figures from a busy machine are marked.
"""
import argparse
import time

from . import meshes


def tables(options):
    from . import paper_tables

    paper_tables.tables(options.meshes or meshes.OF_PAPER, options.queries or 2000)
    paper_tables.all_vertices(["head_skin"] if not options.meshes else options.meshes[:1])


def exact(options):
    from . import exact_index

    exact_index.run(options.meshes, options.queries or 300)


def before(options):
    from . import before as measuring

    measuring.run(options.commit, options.meshes, options.queries or 600)


def batch(options):
    from . import batch as measuring

    measuring.run(options.meshes)


def arrays(options):
    from .arrays import contest

    contest.run(options.meshes, options.radii, options.threads)


def curvature(options):
    from . import curvature as measuring

    measuring.run(options.meshes)


def growth(options):
    from . import curvature as measuring

    measuring.run_growth(options.largest)


def pictures(options):
    from . import pictures as drawing

    drawing.run(options.meshes)


def accuracy(options):
    from . import accuracy as measuring

    measuring.run(options.meshes or measuring.MESHES, options.queries or 500)


def scaling(options):
    from . import scaling as measuring

    measuring.run(options.largest, options.queries or 500)


def peers(options):
    from .peers import contest

    contest.run(options.meshes, options.block_seconds)


def reading(options):
    from . import reading as measuring

    measuring.run(options.threads)


def tasks(options):
    from . import tasks as measuring

    measuring.run(options.meshes)


def report(_):
    from . import report as writing

    writing.write()


PARTS = {part.__name__: part for part in (tables, exact, before, batch, arrays, curvature, growth, pictures, accuracy,
                                       scaling, peers, tasks, reading, report)}


def main():
    parser = argparse.ArgumentParser(prog="python3 -m bench", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="+", choices=PARTS, metavar="PART", help=", ".join(PARTS))
    parser.add_argument("--meshes", nargs="+", choices=[*meshes.MESHES, *meshes.SHEETS, *meshes.ODD], metavar="NAME",
                        help=", ".join(meshes.MESHES))
    parser.add_argument("--radii", nargs="+", type=int, metavar="EDGES", help="in mean edges, for `arrays`")
    parser.add_argument("--threads", nargs="+", type=int, choices=(1, 2), metavar="COUNT", help="1 or 2, for `arrays` and `reading`")
    parser.add_argument("--queries", type=int, help="a mesh and radius")
    parser.add_argument("--commit", default="HEAD~1", help="the commit to compare with, for `before`")
    parser.add_argument("--largest", type=int, default=10_000_000,
                        help="vertices of the largest mesh of `scaling` and `growth`")
    parser.add_argument("--block-seconds", type=float, default=0.3, help="approximate time of a library and block")
    options = parser.parse_args()
    for part in options.parts:
        begin = time.monotonic()
        PARTS[part](options)
        print(f"{part}: {(time.monotonic() - begin) / 60:.1f} minutes", flush=True)


if __name__ == "__main__":
    main()
