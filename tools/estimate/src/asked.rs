//! What is asked of surfaces that will be remeshed.

/// What is asked of a surface that will be remeshed.
pub struct Asked {
    /// Of each triangle, the length of edges at it, model units; infinite for none.
    pub length: Vec<f64>,
    /// The angle by which edges turn along a curve, radians.
    pub turn: f64,
    /// Whether that was asked for.
    pub turn_is_asked: bool,
    /// By how much lengths of edges grow over a distance, relative to it.
    pub growth: f64,
    /// Cosine of the angle between the normals at a feature edge.
    pub feature: f64,
    /// How far the surface may move, model units.
    pub deviation: f64,
    /// What is less than this off a plane may be noise, model units.
    pub noise: f64,
    /// Within this of a plane, triangles are in one plane, model units.
    pub flat: f64,
    /// Within this of a plane, triangles that hardly fold off it are in one plane, too, model units.
    pub folds: f64,
}

impl Asked {
    /// Whether a length is asked for, anywhere.
    pub fn has_lengths(&self) -> bool {
        self.length.iter().any(|length| length.is_finite())
    }
}
