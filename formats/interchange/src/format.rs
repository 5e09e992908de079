//! The formats known, by name, extension and content.

use std::path::Path;

/// A format the tools can read or write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// The document itself.
    Tmesh,
    /// Stereolithography, binary or ASCII, one or several solids.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY.
    Ply,
    /// Object File Format.
    Off,
    /// TetGen piecewise linear complex.
    Poly,
    /// TetGen surface mesh.
    Smesh,
    /// Legacy VTK.
    Vtk,
    /// VTK XML unstructured grid.
    Vtu,
    /// VTK XML unstructured grid in pieces, one per instance.
    Pvtu,
    /// Gmsh, version 4.1.
    Msh,
    /// Gmsh, version 2.2.
    Msh2,
    /// Medit.
    Medit,
    /// Abaqus and CalculiX input.
    Inp,
    /// TetGen mesh: files for nodes, elements and faces.
    Node,
    /// A readable listing of a document.
    Text,
}

impl Format {
    /// All formats, in the order they are listed to users.
    pub const ALL: [Self; 16] = [
        Self::Tmesh,
        Self::Stl,
        Self::Obj,
        Self::Ply,
        Self::Off,
        Self::Poly,
        Self::Smesh,
        Self::Vtk,
        Self::Vtu,
        Self::Pvtu,
        Self::Msh,
        Self::Msh2,
        Self::Medit,
        Self::Inp,
        Self::Node,
        Self::Text,
    ];

    /// The name used with `--from` and `--to`, which is also the usual extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tmesh => "tmesh",
            Self::Stl => "stl",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Off => "off",
            Self::Poly => "poly",
            Self::Smesh => "smesh",
            Self::Vtk => "vtk",
            Self::Vtu => "vtu",
            Self::Pvtu => "pvtu",
            Self::Msh => "msh",
            Self::Msh2 => "msh2",
            Self::Medit => "mesh",
            Self::Inp => "inp",
            Self::Node => "node",
            Self::Text => "txt",
        }
    }

    /// The format with this name, in any case.
    pub fn from_name(name: &str) -> Option<Self> {
        // Every file of a TetGen mesh stands for all of them.
        if ["ele", "face"].iter().any(|n| n.eq_ignore_ascii_case(name)) {
            return Some(Self::Node);
        }
        Self::ALL
            .into_iter()
            .find(|f| f.name().eq_ignore_ascii_case(name))
    }

    /// The format a path's extension stands for.
    pub fn from_path(path: &Path) -> Option<Self> {
        Self::from_name(path.extension()?.to_str()?)
    }

    /// Whether its bytes are not text.
    pub fn is_binary(self) -> bool {
        matches!(
            self,
            Self::Tmesh | Self::Stl | Self::Vtk | Self::Vtu | Self::Msh | Self::Msh2
        )
    }
}
