//! What goes into a file, where its format leaves a choice.

/// What goes into a file, where the format leaves a choice.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WriteOptions {
    /// Add the surface triangles to the cells of a file that has tetrahedra, with all cell arrays.
    /// A mesh without tetrahedra is always written as triangles.
    pub boundary: bool,
    /// Which triangles an STL file gets.
    pub surface: Surface,
    /// Write numbers as text, where a format has both forms.
    pub ascii: bool,
    /// Compress the arrays of a VTU file.
    pub compress: bool,
    /// The condition to write for each wall of a sector that is a mirror plane, by position in
    /// [`crate::MeshStream::wall_names`]; none beyond the end. For formats with
    /// [`crate::Entry::conditions`].
    pub parities: Vec<Option<Parity>>,
}

/// Which triangles a surface format gets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surface {
    /// Those with material on exactly one side, turned so that normals point out of it: a closed
    /// surface. Of a wedge, its walls are part of it.
    #[default]
    Boundary,
    /// All of them, interfaces between regions included, as they are stored.
    All,
}

/// How displacements behave under the reflection at a mirror plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// They are those of the image: nothing moves out of the plane.
    Symmetric,
    /// They are opposite to those of the image: nothing moves within the plane.
    Antisymmetric,
}
