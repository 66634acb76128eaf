# SPDX-License-Identifier: MIT
"""trueform, the only other library with the same question. Licensed for noncommercial use only."""
from .tool import Tool, mean_of_rows


class Neighborhoods(Tool):
    name = "trueform neighborhoods"
    package = module = "trueform"
    questions = ("ids", "mean")
    remark = "mean: of the ids, by NumPy"

    def build(self):
        import trueform

        membership = trueform.cell_membership(self.F, n_ids=len(self.V))
        return trueform.vertex_link_faces(self.F, membership)

    def ids(self, links, scale):
        import trueform

        found = trueform.neighborhoods(links, self.V, scale.radius, inclusive=True)
        return found.offsets, found.data

    def mean(self, links, scale):
        return mean_of_rows(self.signal, *self.ids(links, scale))


class Rings(Neighborhoods):
    name = "trueform k_rings"
    answers = "k rings"
    remark = ""
    questions = ("ids",)

    def ids(self, links, scale):
        import trueform

        found = trueform.k_rings(links, scale.edges, inclusive=True)
        return found.offsets, found.data


class Curvature(Tool):
    name = "trueform principal_curvatures"
    package = module = "trueform"
    answers = "k rings"
    questions = ("curvature",)

    def curvature(self, built, scale):
        import trueform

        return trueform.principal_curvatures((self.F, self.V), k=scale.edges, directions=True)
