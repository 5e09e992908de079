//! What is beside a facet.

/// What is beside a facet. Lengths are in model units.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// Number of its triangles.
    pub triangles: u32,
    /// Length of its outline.
    pub border: f64,
    /// Length of the part beside which the surface goes on smoothly.
    pub smooth: f64,
    /// Length of the part of it beside which it goes on with a facet of half its mean width at least, across the edge, or turns as
    /// one curve does for the width of both, or is bent by less than a degree and does not rise far, unless a curve begins there.
    pub like: f64,
    /// The first of the facets beyond that part.
    pub first: Option<u32>,
    /// Whether there are others.
    pub more: bool,
}

impl Beside {
    /// Takes what is beside another facet, which is one with this one, for beside this one, too.
    pub fn add(&mut self, other: &Self) {
        self.triangles += other.triangles;
        self.border += other.border;
        self.smooth += other.smooth;
        self.like += other.like;
    }
}
