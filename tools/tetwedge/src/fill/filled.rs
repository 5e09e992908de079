//! A filled template.

use improve::Improved;
use tmesh::Template;

/// No counterpart.
pub const NONE: u32 = u32::MAX;

/// A filled template.
pub struct Filled {
    /// The template; vertex and triangle pairs of its hub walls still have the old numbers of the
    /// other template.
    pub template: Template,
    /// New id of each old vertex, or [`NONE`].
    pub vertices: Vec<u32>,
    /// New index of each old triangle that had to be preserved, else [`NONE`].
    pub triangles: Vec<u32>,
    /// Triangles on faces that other templates list as hub walls, increasing.
    pub shared: Vec<u32>,
    /// Tetrahedra in cells that are to be empty, left out.
    pub dropped: usize,
    /// Vertices of the mesher's that the elements do not need, taken out.
    pub removed: usize,
    /// What was improved, unless elements are to stay as the mesher left them.
    pub improved: Option<Improved>,
    /// Whether vertices of the surface were moved along the shape behind it.
    pub has_slid: bool,
}

impl Filled {
    /// What templates need that share faces with this one: what [`super::finish`] leaves as it is.
    pub fn shared_surface(&self) -> Self {
        let template = Template {
            vertices: self.template.vertices.clone(),
            triangles: self.template.triangles.clone(),
            ..Template::default()
        };
        Self {
            template,
            vertices: self.vertices.clone(),
            triangles: Vec::new(),
            shared: self.shared.clone(),
            dropped: 0,
            removed: 0,
            improved: None,
            has_slid: false,
        }
    }
}
