# SPDX-License-Identifier: MIT
"""The plots, drawn from the results alone. Those that a page shows go to docs/benchmarks, with few colors."""
import io

import matplotlib

matplotlib.use("agg")
matplotlib.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "savefig.dpi": 110,
                            "lines.markersize": 3.5, "legend.fontsize": 8})

from matplotlib import pyplot  # noqa: E402: the backend comes first
from PIL import Image  # noqa: E402

from . import accuracy, places, programs, results, scaling  # noqa: E402
from .timing import fitted_exponent  # noqa: E402

SHOWN = ("table2", "accuracy", "query_over_size")  # by a page

STYLES = {
    "bfs": ("breadth-first search", "tab:red", "o"),
    "ball": ("scan for the ball", "tab:blue", "v"),
    "paper": ("the paper's index", "goldenrod", "s"),
    "exact": ("exact index", "tab:green", "^"),
    "ids": ("exact index, ids", "tab:green", "^"),
    "count": ("exact index, count", "tab:olive", "D"),
    "ranges": ("exact index, ranges", "tab:cyan", "x"),
}


def draw_all():
    """Draws the plots for which there are results. Returns their names."""
    plots = {"paper_tables": table2, "accuracy": accuracy_plots, "scaling": scaling_plots}
    return [name for source, plot in plots.items() if results.load(source) for name in plot(results.load(source))]


def panels(count, height=3.2):
    figure, axes = pyplot.subplots(1, count, figsize=(3.4 * count, height), squeeze=False, layout="constrained")
    return figure, axes[0]


def common_legend(figure, axis):
    """Above all panels, so that it hides no line."""
    handles, labels = axis.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=len(labels))


def legend_below(axis):
    """For a panel with labels of its own."""
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2))


def save(figure, name):
    folder = places.PAGES if name in SHOWN else places.RESULTS
    with io.BytesIO() as drawn:
        figure.savefig(drawn)
        Image.open(drawn).convert("RGB").quantize(32).save(folder / f"{name}.png", optimize=True)
    pyplot.close(figure)
    return name


def line(axis, xs, ys, method, suffix=""):
    label, color, marker = STYLES[method]
    axis.plot(xs, ys, label=label + suffix, color=color, marker=marker)


def logarithmic(axis, x, y, title):
    axis.set(xscale="log", yscale="log", xlabel=x, ylabel=y, title=title)


def table2(data):
    """As the paper's Table 2: time above, vertices found below, over the radius."""
    tables = data["meshes"]
    figure, axes = pyplot.subplots(2, len(tables), figsize=(3.2 * len(tables), 5.2), squeeze=False, layout="constrained")
    for (name, table), (above, below) in zip(tables.items(), axes.T):
        rows = programs.by_radius(table["table2"])
        for method in ("bfs", "ball", "paper", "exact"):
            line(above, list(rows), [row[method]["microseconds"] for row in rows.values()], method)
            line(below, list(rows), [row[method]["count"] for row in rows.values()], method)
        logarithmic(above, "", "µs a query", name)
        logarithmic(below, "radius / mean edge length", "vertices found", "")
    common_legend(figure, axes[0][0])
    return [save(figure, "table2")]


def accuracy_plots(data):
    tables = {name: programs.by_radius(race["rows"]) for name, race in data["meshes"].items()}
    return [extra_over_radius(tables), of_option(tables, accuracy.FACTORS, accuracy.factor_method, "f", "factor"),
            of_option(tables, accuracy.LEVELS, level_name, "levels computed", "levels")]


def level_name(levels):
    """Five levels are the default, and run as `f = 10`."""
    return accuracy.factor_method(10) if levels == 5 else accuracy.level_method(levels)


def extra_over_radius(tables):
    """Extra vertices, as a share of the exact answer."""
    figure, axes = panels(len(tables))
    for axis, (name, rows) in zip(axes, tables.items()):
        radii = list(rows)
        for method, row in (("ball", "ball"), ("paper", accuracy.factor_method(10))):
            line(axis, radii, [100 * rows[radius][row]["extra"] / rows[radius]["bfs"]["count"] for radius in radii], method)
        axis.set_yscale("symlog", linthresh=0.1)
        axis.set(xscale="log", xlabel="radius / mean edge length", ylabel="extra vertices, % of the exact", title=name)
    common_legend(figure, axes[0])
    return save(figure, "accuracy")


def of_option(tables, values, method_of, what, plot):
    """Error above and time below, over the radius, for each value of an option of the paper's index."""
    figure, axes = pyplot.subplots(2, len(tables), figsize=(3.4 * len(tables), 5.2), squeeze=False, layout="constrained")
    colors = pyplot.cm.viridis([i / max(1, len(values) - 1) * 0.9 for i in range(len(values))])
    for (name, rows), (above, below) in zip(tables.items(), axes.T):
        radii = list(rows)
        for value, color in zip(values, colors):
            method = method_of(value)
            style = {"color": color, "marker": "o", "label": f"{what} = {value}"}
            above.plot(radii, [100 * row[method]["extra"] / row["bfs"]["count"] for row in rows.values()], **style)
            below.plot(radii, [row[method]["microseconds"] for row in rows.values()], **style)
        above.set_yscale("symlog", linthresh=0.1)
        above.set(xscale="log", ylabel="extra vertices, % of the exact", title=name)
        logarithmic(below, "radius / mean edge length", "µs a query", "")
    common_legend(figure, axes[0][0])
    return save(figure, plot)


def scaling_plots(data):
    return [build_over_size(data), query_over_size(data), query_over_radius(data)]


def build_over_size(data):
    figure, axes = panels(len(data["by_size"]), height=3.5)
    for axis, (shape, races) in zip(axes, data["by_size"].items()):
        sizes = [race["vertices"] for race in races]
        for method in ("exact", "paper"):
            seconds = [scaling.build_seconds(race, method) for race in races]
            line(axis, sizes, seconds, method, exponent_label(sizes, seconds))
        logarithmic(axis, "vertices", "s to build, one thread", shape)
        legend_below(axis)
    return save(figure, "build_over_size")


def query_over_size(data):
    figure, axes = panels(len(data["by_size"]))
    for axis, (shape, races) in zip(axes, data["by_size"].items()):
        sizes = [race["vertices"] for race in races]
        for method in scaling.METHODS:
            line(axis, sizes, [scaling.microseconds(race, method, data["radius_edges"]) for race in races], method)
        logarithmic(axis, "vertices of the mesh", f"µs a query of {data['radius_edges']} edges", shape)
    common_legend(figure, axes[0])
    return save(figure, "query_over_size")


def query_over_radius(data):
    figure, axes = panels(len(data["by_radius"]), height=4.2)
    for axis, (shape, race) in zip(axes, data["by_radius"].items()):
        for method in scaling.METHODS:
            found, costs = scaling.cost_by_found(race, method)
            line(axis, found, costs, method, exponent_label(*scaling.large(found, costs)))
        logarithmic(axis, "vertices found", "µs a query", shape)
        legend_below(axis)
    return save(figure, "query_over_radius")


def exponent_label(sizes, costs):
    return f", ^{fitted_exponent(sizes, costs):.2f}" if len(sizes) > 1 else ""
