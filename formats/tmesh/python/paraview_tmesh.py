"""Makes ParaView open `.tmesh` documents, expanded: Tools, Manage Plugins, Load New, this file. The file `tmesh.py` stays
beside it. In Python with VTK alone `TmeshReader` is an ordinary source."""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import tmesh  # noqa: E402

try:
    from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smhint, smproperty, smproxy
    IN_PARAVIEW = True
except ImportError:
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
    IN_PARAVIEW = False


class TmeshSource(VTKPythonAlgorithmBase):
    """A document as an unstructured grid."""

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType='vtkUnstructuredGrid')
        self.path, self.boundary = None, True

    def SetFileName(self, path):
        if path != self.path:
            self.path = path
            self.Modified()

    def SetBoundary(self, boundary):
        if bool(boundary) != self.boundary:
            self.boundary = bool(boundary)
            self.Modified()

    def RequestData(self, request, inputs, outputs):
        from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
        mesh = tmesh.expand(tmesh.read(self.path))
        vtkUnstructuredGrid.GetData(outputs, 0).ShallowCopy(tmesh.to_vtk(mesh, self.boundary))
        return 1


if IN_PARAVIEW:
    @smproxy.reader(name='TmeshReader', label='tmesh document', extensions='tmesh', file_description='tmesh documents')
    class TmeshReader(TmeshSource):
        @smproperty.stringvector(name='FileName')
        @smdomain.filelist()
        @smhint.filechooser(extensions='tmesh', file_description='tmesh documents')
        def SetFileName(self, path):
            super().SetFileName(path)

        @smproperty.xml("""
            <IntVectorProperty name="Boundary" command="SetBoundary" number_of_elements="1" default_values="1">
              <BooleanDomain name="bool"/>
              <Documentation>Add the triangles of the surface to the tetrahedra.</Documentation>
            </IntVectorProperty>""")
        def SetBoundary(self, boundary):
            super().SetBoundary(boundary)
else:
    TmeshReader = TmeshSource
