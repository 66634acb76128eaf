# SPDX-License-Identifier: MIT
"""Filters for ParaView 5.11 and later: Tools > Manage Plugins > Load New, or `LoadPlugin` in a script. They stand in
the menu Filters > meshhood, and in `paraview.simple` as MeshhoodNeighborhood, MeshhoodThickness, MeshhoodCurvature and
MeshhoodSmooth.

Their input is a vtkPolyData of polygons; its vertices and lines have no effect. Their output is the input with further
point arrays, whose names say metric, radius and unit. Lengths are in the unit of the points, which the names call
`unit`. A fault of the input or of a property gives one message, and an empty output.
"""

from __future__ import annotations

import hashlib
import re
import sys
import warnings
import weakref
from typing import Any

import numpy as np
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

paraview_plugin_name = "meshhood"

_METRICS = ("straight", "path", "surface")
_UNITS = ("edge", "mesh")
_METHODS = ("ray", "sphere")
_ADVICE = (  # calls of Python in warnings of the package, and the filters that do the same
    (r"pass F=F\[:, ::-1\]", "apply the filter Surface Normals with Flip Normals, without Splitting"),
    (r"V, F, ids = meshhood\.weld\(V, F\)", "apply the filter Clean"),
    (r"V, F, ids = meshhood\.weld\(V, F, eps=(.*)\)", r"apply the filter Clean with an Absolute Tolerance of \1"),
)


def _choice(name: str, entries: tuple[str, ...], text: str) -> str:
    """The XML of a property whose value is the number of an entry."""
    values = "".join(f'<Entry value="{value}" text="{entry}"/>' for value, entry in enumerate(entries))
    return f"""
      <IntVectorProperty name="{name}" command="Set{name}" number_of_elements="1" default_values="0">
        <EnumerationDomain name="enum">{values}</EnumerationDomain><Documentation>{text}</Documentation>
      </IntVectorProperty>"""


def _switch(name: str, default: int, text: str) -> str:
    return f"""
      <IntVectorProperty name="{name}" command="Set{name}" number_of_elements="1" default_values="{default}">
        <BooleanDomain name="bool"/><Documentation>{text}</Documentation>
      </IntVectorProperty>"""


def _radius(name: str, text: str) -> str:
    """The XML of a radius, its unit and its metric."""
    units = ("mean edge lengths", "units of the points")
    return (
        f"""
      <DoubleVectorProperty name="{name}" command="SetRadius" number_of_elements="1" default_values="5">
        <DoubleRangeDomain name="range" min="0"/><Documentation>{text}</Documentation>
      </DoubleVectorProperty>"""
        + _choice("Unit", units, f"What {name} counts. The mean edge length is in the field data of the output.")
        + _choice(
            "Metric",
            ("straight lines", "paths along edges", "paths along the surface"),
            "How distances are measured. By straight lines, what is found is connected inside the ball of the radius.",
        )
        + _switch(
            "RadiusInNames",
            1,
            "Say metric and radius in the names of the arrays. Without that, the colors of a view stay when the radius "
            "changes.",
        )
    )


_START = (
    _choice(
        "Start",
        ("point", "vertex id"),
        "Where the neighborhood is: at the vertex nearest to a point on the surface, or at a vertex by its id.",
    )
    + """
      <DoubleVectorProperty name="Point" command="SetPoint" number_of_elements="3" default_values="0 0 0">
        <BoundsDomain name="range" mode="normal" default_mode="mid">
          <RequiredProperties><Property function="Input" name="Input"/></RequiredProperties>
        </BoundsDomain>
        <Documentation>Stands for the nearest corner of the face nearest to it. The key P picks it.</Documentation>
      </DoubleVectorProperty>
      <PropertyGroup label="Point" panel_widget="InteractiveHandle">
        <Property function="WorldPosition" name="Point"/>
        <Hints><PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Start" value="0"/></Hints>
      </PropertyGroup>
      <IdTypeVectorProperty name="VertexId" command="SetVertexId" number_of_elements="1" default_values="0">
        <Documentation>The id of the vertex, as the Spreadsheet View shows it.</Documentation>
        <Hints><PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Start" value="1"/></Hints>
      </IdTypeVectorProperty>"""
)

_ARRAY = """
      <StringVectorProperty name="Array" command="SetInputArrayToProcess" number_of_elements="5"
        element_types="0 0 0 0 2">
        <ArrayListDomain name="array_list" attribute_type="Scalars" input_domain_name="point_arrays">
          <RequiredProperties><Property function="Input" name="Input"/></RequiredProperties>
        </ArrayListDomain>
        <Documentation>The point array that is smoothed, each of its components by itself.</Documentation>
      </StringVectorProperty>"""


def _filter(label: str, text: str, properties: str, input_domain: str = "") -> Any:
    """Makes a class a filter of ParaView. `text`: what the filter does, for its help."""

    def decorate(algorithm: Any) -> Any:
        algorithm._label = label
        algorithm = smproperty.xml(properties)(algorithm)
        if input_domain:
            algorithm = smdomain.xml(input_domain)(algorithm)
        algorithm = smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)(algorithm)
        algorithm = smproperty.input(name="Input", port_index=0)(algorithm)
        algorithm = smproperty.xml(f"<Documentation short_help='{label}'>{text}</Documentation>")(algorithm)
        algorithm = smhint.xml('<ShowInMenu category="meshhood"/>')(algorithm)
        return smproxy.filter(label=label)(algorithm)

    return decorate


def _setter(name: str) -> Any:
    """The method by which ParaView sets a property."""

    def set_value(self: Any, *values: Any) -> None:
        value = values if len(values) > 1 else values[0]
        if getattr(self, name) != value:
            setattr(self, name, value)
            self.Modified()

    return set_value


class _Filter(VTKPythonAlgorithmBase):
    """What the filters have in common: their properties, the index of the input, messages."""

    _label: str
    _radius, _unit, _metric, _is_named = 5.0, 0, 0, 1
    SetRadius, SetUnit, SetMetric = map(_setter, ("_radius", "_unit", "_metric"))
    SetRadiusInNames = _setter("_is_named")

    def __init__(self) -> None:
        super().__init__(inputType="vtkPolyData", outputType="vtkPolyData")
        self._index: Any = None

    def RequestData(self, request: Any, inInfo: Any, outInfo: Any) -> int:
        mesh, output = vtkPolyData.GetData(inInfo[0], 0), vtkPolyData.GetData(outInfo, 0)
        output.ShallowCopy(mesh)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", UserWarning)
            try:
                self._index = _index_of(mesh, self._progress)
                self._add_arrays(mesh, output)
                _add(output.GetFieldData(), "mean_edge_length [unit]", [self._index.mean_edge_length])
            except (ImportError, MemoryError, TypeError, ValueError) as error:
                output.Initialize()
                vtkOutputWindow.GetInstance().DisplayErrorText(f"{self._label}: {error}\n")
        for warning in caught:
            text = str(warning.message)
            for call, here in _ADVICE:
                text = re.sub(call, here, text)
            vtkOutputWindow.GetInstance().DisplayWarningText(f"{self._label}: {text}\n")
        return 1

    def _progress(self, done: int, total: int) -> None:
        self.UpdateProgress(done / max(total, 1))

    def _add_arrays(self, mesh: Any, output: Any) -> None:
        raise NotImplementedError

    @property
    def _unit_and_metric(self) -> dict[str, str]:
        """Unit and metric as the arguments of `MeshIndex` of these names."""
        return {"unit": _UNITS[self._unit], "metric": _METRICS[self._metric]}

    def _named(self, quantity: str, unit: str = "", metric: bool = True, letter: str = "r") -> str:
        """The name of an array: `quantity`, the metric unless straight, the radius, and the unit of the values."""
        words = [quantity]
        if self._is_named:
            words += [_METRICS[self._metric]] if metric and self._metric else []
            words += [f"{letter}={self._radius:g}"] if self._unit else [f"{letter}={self._radius:g} edges"]
        return " ".join([*words, f"[{unit}]"] if unit else words)


@_filter(
    "Meshhood Neighborhood",
    "The part of the mesh that is connected with a vertex within a radius: 0 or 1 for each vertex, and the distances.",
    _START
    + _radius("Radius", "The radius of the neighborhood. A vertex at exactly this distance is inside.")
    + _choice(
        "Output",
        ("whole mesh with arrays", "faces of the neighborhood"),
        "The whole mesh, or the faces whose corners are all in the neighborhood, with the arrays of both.",
    ),
)
class MeshhoodNeighborhood(_Filter):
    """Adds `neighborhood`, 1 for its vertices and 0 for others, and `distance`, NaN for others. The field data has
    `start_vertex`."""

    _start, _point, _vertex, _output = 0, (0.0, 0.0, 0.0), 0, 0
    SetStart, SetPoint, SetVertexId, SetOutput = map(_setter, ("_start", "_point", "_vertex", "_output"))

    def _add_arrays(self, mesh: Any, output: Any) -> None:
        start = self._vertex if self._start else _corner_at(self._index, self._point)
        ids, distances = self._index.neighborhood(start, self._radius, return_distance=True, **self._unit_and_metric)
        inside, lengths = np.zeros(len(self._index), np.uint8), np.full(len(self._index), np.nan)
        inside[ids], lengths[ids] = 1, distances
        _add(output.GetPointData(), self._named("distance", "unit"), lengths)
        _add(output.GetPointData(), self._named("neighborhood"), inside)
        if self._output:
            _keep_faces(output, self._index.submesh(ids).faces)
        _add(output.GetFieldData(), "start_vertex", [start])


@_filter(
    "Meshhood Thickness",
    "The thickness of the wall at each vertex. Faces are oriented counterclockwise, seen from outside.",
    _choice(
        "Method",
        _METHODS,
        "The way against the normal to the surface, or the diameter of the largest ball that touches the surface there "
        "from inside.",
    ),
)
class MeshhoodThickness(_Filter):
    """Adds `thickness`: inf where nothing is met, NaN for a vertex without a normal."""

    _method = 0
    SetMethod = _setter("_method")

    def _add_arrays(self, mesh: Any, output: Any) -> None:
        method = _METHODS[self._method]
        found = self._index.thickness(method=method, progress=self._progress)
        _add(output.GetPointData(), f"thickness {method} [unit]", found)


@_filter(
    "Meshhood Curvature",
    "Curvature at the scale of a radius, by quadrics that are fitted to neighborhoods; area and volume in the ball. "
    "Curvature is positive where the surface is convex, with faces counterclockwise, seen from outside.",
    _radius("Radius", "The radius of the neighborhoods. A larger one smooths noise and details.")
    + _switch(
        "AreaAndVolume",
        0,
        "Also the area of the surface in the ball that is connected with its center, and the volume of the part of the "
        "ball behind it. The ball is that of the radius, whatever the metric.",
    ),
)
class MeshhoodCurvature(_Filter):
    """Adds `mean_curvature`, `gaussian_curvature`, `k1`, `k2`, their directions `d1`, `d2`, `curvedness`, `shape_index`
    and `curvature_state`, 0 where the fit is unique; on demand `area` and `volume`. See `meshhood.Curvature` and
    `meshhood.Invariants`."""

    _invariants = 0
    SetAreaAndVolume = _setter("_invariants")

    def _add_arrays(self, mesh: Any, output: Any) -> None:
        points = output.GetPointData()
        if self._invariants:
            found = self._index.invariants(self._radius, unit=_UNITS[self._unit], progress=self._progress)
            _add(points, self._named("area", "unit^2", metric=False), found.area)
            _add(points, self._named("volume", "unit^3", metric=False), found.volume)
        shape = self._index.curvature(self._radius, progress=self._progress, **self._unit_and_metric)
        _add(points, self._named("curvature_state"), shape.state)
        _add(points, self._named("shape_index"), shape.shape_index)
        _add(points, self._named("d2"), shape.d2)
        _add(points, self._named("d1"), shape.d1)
        for name in ("curvedness", "k2", "k1"):
            _add(points, self._named(name, "1/unit"), getattr(shape, name))
        _add(points, self._named("gaussian_curvature", "1/unit^2"), shape.gaussian)
        _add(points, self._named("mean_curvature", "1/unit"), shape.mean)


@_filter(
    "Meshhood Smooth",
    "A point array smoothed over the surface by a Gaussian, not across gaps and folds. NaN marks a missing value.",
    _ARRAY
    + _radius("FWHM", "The full width at half maximum of the Gaussian, a distance. It must be larger than 0.")
    + _switch("WeighByArea", 1, "Weigh each vertex by its area, so that dense vertices count no more."),
    '<InputArrayDomain name="point_arrays" attribute_type="point"/>',
)
class MeshhoodSmooth(_Filter):
    """Adds the smoothed array, with the width or `smooth` in its name."""

    _weighted = 1
    SetWeighByArea = _setter("_weighted")

    def _add_arrays(self, mesh: Any, output: Any) -> None:
        chosen = self.GetInputArrayInformation(0)
        name = chosen.Get(vtkDataObject.FIELD_NAME()) if chosen.Has(vtkDataObject.FIELD_NAME()) else None
        array = mesh.GetPointData().GetArray(name) if name else None
        if array is None:
            raise ValueError(f"Array: {name!r}, expected a point array of numbers")
        weights = "area" if self._weighted else None
        smooth = self._index.smooth(
            vtk_to_numpy(array), self._radius, weights=weights, nan="omit", progress=self._progress, **self._unit_and_metric
        )
        plain = name if self._is_named else f"{name} smooth"  # the input keeps its array
        _add(output.GetPointData(), self._named(plain, letter="fwhm"), smooth)


# The indices that a filter holds, by digests of points and polygons: all filters of a mesh share an index, and the next
# radius needs no other. VTK's times of change do not tell meshes apart, since an edit in place may leave them.
_indices: weakref.WeakValueDictionary[tuple[Any, ...], Any] = weakref.WeakValueDictionary()


def _index_of(mesh: Any, progress: Any) -> Any:
    if mesh.GetNumberOfStrips():
        strips = f"{mesh.GetNumberOfStrips()} triangle strips"
        raise ValueError(f"Input: has {strips}, expected polygons: apply the filter Triangulate first")
    if mesh.GetNumberOfPolys() == 0:
        raise ValueError("Input: has no polygons")
    polygons = mesh.GetPolys()
    arrays = mesh.GetPoints().GetData(), polygons.GetOffsetsArray(), polygons.GetConnectivityArray()
    points, *faces = (np.ascontiguousarray(vtk_to_numpy(array)) for array in arrays)
    key = tuple((array.dtype.str, hashlib.blake2b(array).digest()) for array in (points, *faces))
    index = _indices.get(key)
    if index is None:
        index = _indices[key] = _package().MeshIndex(points, tuple(faces), progress=progress)
    return index


def _package() -> Any:
    try:
        import meshhood
    except ImportError as error:
        raise ImportError(
            f"needs the Python package meshhood ({error}). Install it for Python {sys.version_info[0]}."
            f"{sys.version_info[1]}, and start ParaView with its folder in PYTHONPATH: integrations/paraview/README.md"
        ) from None
    return meshhood


def _corner_at(index: Any, point: tuple[float, float, float]) -> int:
    """The corner nearest to the point of the surface that is nearest to `point`."""
    face, _, nearest, _ = index.closest_point(point)
    faces = index.faces
    corners = faces[1][faces[0][face] : faces[0][face + 1]] if isinstance(faces, tuple) else faces[face]
    return int(corners[np.argmin(np.linalg.norm(index.positions[corners] - nearest, axis=1))])


def _add(data: Any, name: str, values: Any) -> None:
    """Adds an array, which becomes the active one that ParaView shows first."""
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    data.AddArray(array)
    if array.GetNumberOfComponents() == 1 and hasattr(data, "SetActiveScalars"):
        data.SetActiveScalars(name)


def _keep_faces(mesh: Any, faces: Any) -> None:
    """Only these faces and their corners, with their arrays. The cells of `mesh` are its vertices, lines and faces."""
    whole = vtkPolyData()
    whole.ShallowCopy(mesh)
    cells = vtkIdList()
    for cell in faces + mesh.GetNumberOfVerts() + mesh.GetNumberOfLines():
        cells.InsertNextId(int(cell))
    points = vtkPoints()
    points.SetDataType(whole.GetPoints().GetDataType())
    mesh.Initialize()
    mesh.SetPoints(points)
    mesh.AllocateCopy(whole)
    mesh.GetPointData().CopyAllocate(whole.GetPointData())
    mesh.GetCellData().CopyAllocate(whole.GetCellData())
    mesh.CopyCells(whole, cells)
    mesh.GetFieldData().ShallowCopy(whole.GetFieldData())
