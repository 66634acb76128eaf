#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The harness on a small shape, and whether the pages of the benchmarks have places for its tables.

usage: tests/repo/bench_test.py FOLDER    FOLDER has the programs: build/release/bench; beside it lies meshhood
"""
import array
import math
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from bench import accuracy, batch, exact_index, machine, paper_tables, places, programs, report  # noqa: E402: from the checkout
from bench import results, scaling, timing  # noqa: E402
from bench.sections import SECTIONS  # noqa: E402

MESH = "scroll:3000"
METHODS = ("bfs", "bfs-reordered", "ball", "ids", "count", "ranges", "paper", "paper,f=1", "paper,levels=4,discard=1")


class Programs(unittest.TestCase):
    def test_race_compares_every_method_with_the_first(self):
        race = programs.race(MESH, METHODS, radii=(3, 20), queries=60, builds=2)
        self.assertEqual(race["vertices"], 3000)
        self.assertEqual([len(build["seconds"]) for build in race["builds"]], [2, 2])
        rows = programs.by_radius(race["rows"])
        self.assertEqual(list(rows), [3, 20])
        for row in rows.values():
            self.assertEqual(tuple(row), METHODS)
            for method in ("bfs", "ids"):
                self.assertEqual((row[method]["extra"], row[method]["missing"]), (0, 0))
            for method in METHODS[-3:]:
                self.assertEqual(row[method]["missing"], 0)
                self.assertLessEqual(row[method]["extra"], row["ball"]["extra"])
            for method in METHODS:
                lower, upper = row[method]["quartiles"]
                self.assertTrue(0 < lower <= row[method]["microseconds"] <= upper)
            self.assertNotIn("extra", row["ranges"])
        self.assertGreater(rows[20]["ball"]["extra"], 0, "a scroll whose ball is exact tests nothing")

    def test_all_vertices_times_batches_beside_breadth_first_search(self):
        found = programs.run(places.PROGRAMS / "all_vertices", "--json", MESH, 3, 20)
        self.assertEqual(found["vertices"], 3000)
        self.assertEqual([row["radius_edges"] for row in found["rows"]], [3, 20])
        for row in found["rows"]:
            self.assertGreater(row["found"], 1)
            self.assertLessEqual({"bfs", "count", "ids", "one_thread", "two_threads"}, row.keys())
            for method in row.keys() & batch.METHODS:
                self.assertEqual(len(row[method]), 3 if method.startswith(("one_thread", "two_")) else 5)
                self.assertTrue(all(time > 0 for time in row[method]))

    def test_kept_rows_times_each_line_of_its_input(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "mesh.mhi"
            found = programs.run(places.PROGRAMS / "all_vertices", "--json", "--index", file, MESH, 3)
            with batch.RowTimer([places.PROGRAMS / "kept_rows", file]) as timer:
                times = [timer.microseconds(row) for row in found["rows"] * 2]
        self.assertEqual(len(times), 2)
        self.assertTrue(all(time > 0 for time in times))

    def test_race_refuses_unknown_methods(self):
        for method in ("nope", "paper,x=3"):
            done = subprocess.run([places.PROGRAMS / "race", MESH, "--method", method], capture_output=True, text=True)
            self.assertEqual(done.returncode, 1)
            self.assertIn(method, done.stderr)

    def test_phases_are_shares_of_a_whole(self):
        for row in programs.run(places.PROGRAMS / "phases", MESH, 50, 3, 20):
            shares = [row[phase] for phase in ("climb_up", "breadth_first", "range_search")]
            self.assertTrue(all(share > 0 for share in shares))
            self.assertAlmostEqual(sum(shares), 100, delta=0.1)


class NativePeers(unittest.TestCase):
    PROGRAM = "native_peers"

    def answers(self, kind, mesh, radius, vertices):
        program = places.PROGRAMS / self.PROGRAM
        if not program.exists():
            self.skipTest(f"no {self.PROGRAM} (libnanoflann-dev, libeigen3-dev)")
        with tempfile.TemporaryDirectory() as folder:
            queries, answers = Path(folder, "queries"), Path(folder, "answers")
            queries.write_bytes(array.array("I", vertices).tobytes())
            subprocess.run([program, kind, mesh, "2"], input=f"{radius} {queries} {answers}\n", text=True, check=True,
                           capture_output=True)
            return array.array("I", answers.read_bytes())

    def test_curvature_of_a_sphere_is_that_of_its_radius(self):
        vertices = range(0, 3000, 7)
        expected = 1 / math.sqrt(3000 * math.sqrt(0.75) / (4 * math.pi))  # its mean edge is 1
        by_index = self.answers("curvature", "sphere:3000", 5, vertices)
        self.assertEqual(by_index, self.answers("curvature-bfs", "sphere:3000", 5, vertices))
        self.assertEqual(len(by_index), 3 * len(vertices))
        for at in range(0, len(by_index), 3):
            for value in array.array("f", by_index[at + 1:at + 3].tobytes()):
                self.assertAlmostEqual(value / expected, 1, delta=0.05)

    def test_a_ball_takes_more_than_breadth_first_search(self):
        self.assertGreater(len(self.answers("nanoflann", MESH, 4, range(50))),
                           len(self.answers("bfs", MESH, 4, range(50))))


class Parts(unittest.TestCase):
    """Each part that needs only our programs, from the measurement to the page."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for owner, name, value in ((places, "RESULTS", Path(folder.name)), (places, "SCRATCH", Path(folder.name)),
                                   (machine, "WAITED", 0.1)):
            patched = mock.patch.object(owner, name, value)
            patched.start()
            self.addCleanup(patched.stop)

    def table(self, name):
        """The table of the results, as it gets into a page."""
        page = report.filled(f"before\n<!-- from the benchmarks: {name} -->\nwhat was there\n<!-- to here -->\nafter\n")
        self.assertRegex(page, r"(?s)^before\n<!-- .*\n\n\| .*\n\*Measured on .*\n<!-- to here -->\nafter\n$")
        self.assertNotIn("what was there", page)
        return page

    def test_tables(self):
        paper_tables.tables(["tiny"], 50)
        self.assertIn("| tiny | 3,000 |", self.table("paper_tables.space"))
        self.assertIn("| tiny | 10 |", self.table("paper_tables.queries"))

    def test_exact(self):
        exact_index.run(["tiny"], 50)
        self.assertIn("| tiny | 5 |", self.table("exact_index.speed"))

    def test_batch(self):
        batch.run(["tiny"])
        self.assertIn("| tiny | 3,000 | 5 |", self.table("batch.rows"))
        self.assertIn("tiny: count", self.table("batch.speed"))

    def test_accuracy(self):
        accuracy.run(["tiny"], 50)
        self.assertIn("| tiny | 20 |", self.table("accuracy.extra"))

    def test_scaling(self):
        scaling.run(10_000, 50)
        self.assertIn("| sphere | 10,000 |", self.table("scaling.over_size"))
        self.assertIn("k^", self.table("scaling.over_radius"))

    def test_a_table_without_results_stays(self):
        for file in report.documents():
            text = file.read_text(encoding="utf-8")
            self.assertEqual(report.filled(text), text, file.name)


class Watching(unittest.TestCase):
    def test_our_own_load_is_not_counted_as_that_of_others(self):
        usage = machine.Usage()
        begin = time.process_time()
        while time.process_time() < begin + 0.5:
            pass
        now = machine.Usage()
        self.assertGreaterEqual(now.own - usage.own, 0.4)
        self.assertGreaterEqual(now.all - usage.all, 0.4, "the machine has worked at least as much, but for a few ticks")

    def test_a_load_at_either_time_makes_a_machine_busy(self):
        for before, beside, busy in ((0, 0, False), (0.4, 0.4, False), (1, 0, True), (0, 1, True)):
            watched = {"processors": 2, "load_before": before, "load_beside": beside}
            self.assertEqual(machine.is_busy(watched), busy)


class Figures(unittest.TestCase):
    def test_summary_is_median_and_quartiles(self):
        self.assertEqual(timing.summary([5, 1, 2, 4, 3]), {"median": 3, "quartiles": [2, 4], "runs": 5})
        self.assertEqual(timing.summary([7]), {"median": 7, "quartiles": [7, 7], "runs": 1})

    def test_exponent_of_a_power(self):
        sizes = [10, 100, 1000]
        self.assertAlmostEqual(timing.fitted_exponent(sizes, [3 * size**0.5 for size in sizes]), 0.5)


class Documents(unittest.TestCase):
    def test_every_section_has_a_place_with_its_table_and_machine(self):
        found = [place for file in report.documents() for place in report.PLACE.finditer(file.read_text(encoding="utf-8"))]
        self.assertEqual({place["source"] for place in found}, set(SECTIONS))
        for place in found:
            self.assertTrue(callable(getattr(SECTIONS[place["source"]], place["table"])))
            self.assertRegex(place["text"], r"(?s)^\n\| .*\n\*Measured on .*\*\n\n$", place["source"])

    def test_a_page_has_one_picture_at_most_and_no_raw_results(self):
        pages = list(places.PAGES.glob("*.md"))
        self.assertGreater(len(pages), 10)
        shown = [re.findall(r"!\[[^]]*\]\(([^)]*)\)", page.read_text(encoding="utf-8")) for page in pages]
        self.assertLessEqual(max(map(len, shown)), 1)
        others = {file.name for file in places.PAGES.iterdir() if file.suffix != ".md"}
        self.assertEqual(others, {name for names in shown for name in names})

    def test_the_readme_has_numbers_of_the_page(self):
        speed, rows = (tables(file) for file in (places.README, places.PAGES / "batch.md"))
        header, *speed = next(table for table in speed if table[0][0] == "radius in mean edges")
        measured = {(row["mesh"], row["radius"]): row for row in (dict(zip(rows[0][0], cells)) for cells in rows[0][1:])}
        for radius, *cells in speed:
            for at, cell in enumerate(cells):
                mesh = header[1 + at - at % 2].partition(":")[0]
                self.assertEqual(cell, measured[mesh, radius][("× count", "× ids")[at % 2]], (mesh, radius))


def tables(file):
    """The tables of a document, each as lists of cells, without the line below the header."""
    found = re.findall(r"(?m)(?:^\|.*\n)+", file.read_text(encoding="utf-8"))
    return [[[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines() if "---" not in line] for table in found]


if __name__ == "__main__":
    places.PROGRAMS = Path(sys.argv.pop(1))
    places.MESHHOOD = places.PROGRAMS.parent / "meshhood"
    unittest.main(verbosity=2)
